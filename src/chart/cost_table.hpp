#pragma once

namespace strutt {

/// What operations cost on one core of a server with AVX-512 of the 2020s, in seconds: measured by
/// plan_benchmark (docs/benchmarks.md). All that Method::automatic knows about time stands here.
struct CostTable {
  // point by point
  double hill_tables = 2e-3;    ///< plans for one tolerance, made once
  double hill_point = 0.65e-6;  ///< equation, bounds, verdict, growth
  double hill_term = 0.045e-9;  ///< a multiply-add of the power series of one lane of a full register
  double hill_winding = 2.1e-6, hill_matrix = 0.2e-6;  ///< more layers
  double exact_point = 0.66e-6;                        ///< closed form of a piecewise-constant coefficient
  double system_point = 3.5e-6;   ///< as hill_point, of two degrees of freedom, of d as d^3
  double system_product = 12e-9;  ///< of a product of 2 x 2 with 2 x 4, of d as d^3
  double multipliers = 4e-6;      ///< eigenvalues of four states, of 2 d as d^3
  double arkode_evaluation = 90e-9, cvode_evaluation = 250e-9;                 ///< of two states
  double system_arkode_evaluation = 210e-9, system_cvode_evaluation = 780e-9;  ///< of four
  // surrogate
  double hill_node = 2.4e-6;           ///< equation and place in the fit, besides its series
  double hill_check = 5.0e-6;          ///< engine at one scattered point, alone in its register
  double axis_point = 1.0e-6;          ///< tables along the axes
  double cell_multiply_add = 0.04e-9;  ///< of the tensor product
  double cell = 1.0e-9;                ///< error and verdict of a cell, besides
  double cell_layer = 0.8e-9;          ///< each layer
  double reciprocal_cell = 0.12e-6;    ///< four states in closed form
  double period_cell = 0.4e-6;         ///< Hill equation over a whole period
  double matrix_cell = 4e-6;           ///< eigenvalues of two degrees of freedom, of d as d^3
};
inline constexpr CostTable kCosts;

inline double cube_of(int degrees_of_freedom) {
  const auto d = static_cast<double>(degrees_of_freedom);
  return d * d * d / 8.0;
}

/// Of a system by Taylor series: its products, and the rest.
inline double seconds_of_system(int degrees_of_freedom, double products) {
  return cube_of(degrees_of_freedom) * (kCosts.system_point + kCosts.system_product * products);
}

/// Evaluations of SUNDIALS for each radian that solutions turn by in half a period from an even phase or in a
/// whole one, at tolerance 1e-9, with those for the error, and the order by which they rise for smaller ones.
struct EvaluationLaw {
  double per_radian, least, order;
};
inline constexpr EvaluationLaw kArkodeLaw{150.0, 300.0, 8.0}, kCvodeLaw{300.0, 300.0, 8.0};

}  // namespace strutt
