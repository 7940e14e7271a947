#include "chart/trace_boxes.hpp"

#include <cmath>

#include "base/constants.hpp"
#include "chart/box_panel.hpp"
#include "chart/chebyshev.hpp"

namespace strutt {
namespace {

constexpr double kBetweenPoints =
    1.5;                             // bounds there against those at twice as many points as the degree needs
constexpr double kShareOfCut = 0.6;  // of what the factors leave of the tolerance

/// T_k(t_i), i, k = 0 ... at the n + 1 Chebyshev points.
Eigen::MatrixXd at_points(int n, Eigen::Index terms) {
  std::vector<double> t;
  for (int j = 0; j <= n; ++j) t.push_back(chebyshev::point(j, n));
  Eigen::MatrixXd result;
  chebyshev::polynomials(t, static_cast<int>(terms) - 1, result);
  return result;
}

/// Drops the last rows and columns while what they add up to stays below `allowed`; returns the sum.
double cut(Eigen::MatrixXd& c, double allowed) {
  double sum = 0.0;
  for (bool dropped = true; dropped;) {
    dropped = false;
    const double row = c.bottomRows(1).cwiseAbs().sum();
    if (c.rows() > 1 && sum + row <= allowed) {
      sum += row;
      c.conservativeResize(c.rows() - 1, c.cols());
      dropped = true;
    }
    const double column = c.rightCols(1).cwiseAbs().sum();
    if (c.cols() > 1 && sum + column <= allowed) {
      sum += column;
      c.conservativeResize(c.rows(), c.cols() - 1);
      dropped = true;
    }
  }
  return sum;
}

/// What the largest number of M is at least, from the factors: a; in the state scaled by a cell's kappa, b;
/// and g, which damping changes.
Eigen::ArrayXXd size_of(const std::vector<Eigen::ArrayXXd>& f, double square, double kappa,
                        const TraceScale& scale) {
  Eigen::ArrayXXd size = (square * (f[0] * f[3] + f[1] * f[2])).abs().max(1.0);
  if (scale.shifted) return size;
  size = size.max(2.0 * square * scale.least_kappa / kappa * (f[1] * f[3]).abs());
  if (scale.damped) return size;
  return size.max(2.0 * square * kappa / scale.largest_kappa * (f[0] * f[2]).abs());
}

/// The box with D alone, or as it was.
SurrogateBox with_trace(const SurrogateBox& box, double tolerance, const TraceScale& scale) {
  if (!box.interpolated || std::abs(box.exponent) > 100) return box;
  const double square = std::ldexp(1.0, static_cast<int>(2 * box.exponent));
  const auto& c = box.coefficients;
  const int nx = static_cast<int>(2 * (c[0].rows() - 1)) + 2,
            ny = static_cast<int>(2 * (c[0].cols() - 1)) + 2;
  const Eigen::MatrixXd in_x = at_points(nx, c[0].rows()), in_y = at_points(ny, c[0].cols());
  std::vector<Eigen::ArrayXXd> f;
  for (const auto& factor : c) f.emplace_back((in_x * factor * in_y.transpose()).array());
  const Eigen::MatrixXd values = (2.0 * square * (f[0] * f[3] + f[1] * f[2])).matrix();
  Eigen::MatrixXd trace = chebyshev::transform(nx) * values * chebyshev::transform(ny).transpose();
  // rounding of transform and sum, and of the place in the box through the slope
  double rounding = 8.0 * kUnit * std::sqrt(nx + ny) * values.cwiseAbs().maxCoeff();
  for (Eigen::Index i = 0; i < trace.rows(); ++i) {
    for (Eigen::Index j = 0; j < trace.cols(); ++j)
      rounding += kUnit * std::abs(trace(i, j)) * static_cast<double>(8 + i + j + 4 * (i * i + j * j));
  }
  // those of the factors, point by point, relative to what M is there at least
  Eigen::ArrayXXd of_factors = Eigen::ArrayXXd::Zero(values.rows(), values.cols());
  for (const auto& [a, b] : {std::pair<std::size_t, std::size_t>{0, 3}, {1, 2}})
    of_factors += f[a].abs() * box.error[b] + f[b].abs() * box.error[a] + box.error[a] * box.error[b];
  const Eigen::ArrayXXd size = size_of(f, square, box.kappa, scale);
  const auto error_with = [&](double dropped) {
    return kBetweenPoints * ((2.0 * square * of_factors + rounding + dropped) / size).maxCoeff();
  };
  const double left = tolerance / kPanelGrowth - error_with(0.0);
  if (!(left >= 0.0)) return box;
  const double error = error_with(cut(trace, kShareOfCut * left));
  SurrogateBox result = box;
  result.coefficients = {trace};
  result.error = {error};
  result.exponent = 0;
  return result;
}

}  // namespace

std::vector<SurrogateBox> trace_boxes(const std::vector<SurrogateBox>& boxes, double tolerance,
                                      const TraceScale& scale) {
  std::vector<SurrogateBox> result;
  for (const auto& box : boxes) result.push_back(with_trace(box, tolerance, scale));
  return result;
}

double trace_bound(double error, const SurrogateBox& factors, const TraceScale& scale) {
  std::vector<Eigen::ArrayXXd> largest;
  for (const auto& c : factors.coefficients)
    largest.push_back(Eigen::ArrayXXd::Constant(1, 1, c.cwiseAbs().sum()));
  const double square = std::ldexp(1.0, static_cast<int>(2 * factors.exponent));
  return error * size_of(largest, square, factors.kappa, scale)(0, 0);
}

}  // namespace strutt
