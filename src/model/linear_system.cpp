#include "strutt/model/linear_system.hpp"

#include <Eigen/LU>
#include <cmath>

#include "model/harmonic_orders.hpp"
#include "strutt/base/error.hpp"

namespace strutt {
namespace {

template <typename Test>
bool every_matrix(const PeriodicMatrix& matrix, Test test) {
  if (!test(matrix.mean)) return false;
  for (const auto& h : matrix.harmonics) {
    if (!test(h.cosine) || !test(h.sine)) return false;
  }
  return true;
}

double row_sum_norm(const Eigen::MatrixXd& m) {
  return m.size() == 0 ? 0.0 : m.cwiseAbs().rowwise().sum().maxCoeff();
}

bool all_zero(const Eigen::MatrixXd& m) { return m.size() == 0 || (m.array() == 0.0).all(); }

void check_shape(const PeriodicMatrix& matrix, Eigen::Index size, const char* name) {
  const bool good = every_matrix(matrix, [size](const Eigen::MatrixXd& m) {
    return m.size() == 0 || (m.rows() == size && m.cols() == size);
  });
  if (!good) throw InvalidInput(name, "matrix", "square, of the size of linear.mass");
  if (!every_matrix(matrix, [](const Eigen::MatrixXd& m) { return m.size() == 0 || m.allFinite(); })) {
    throw InvalidInput(name, "matrix", "finite in every entry");
  }
}

}  // namespace

void PeriodicMatrix::evaluate(double theta, Eigen::Ref<Eigen::MatrixXd> result) const {
  result = mean;
  for (const auto& h : harmonics) {
    if (h.cosine.size() > 0) result += std::cos(h.order * theta) * h.cosine;
    if (h.sine.size() > 0) result += std::sin(h.order * theta) * h.sine;
  }
}

bool PeriodicMatrix::is_constant() const {
  for (const auto& h : harmonics) {
    if (!all_zero(h.cosine) || !all_zero(h.sine)) return false;
  }
  return true;
}

bool PeriodicMatrix::is_zero() const { return every_matrix(*this, all_zero); }

bool PeriodicMatrix::is_symmetric() const {
  return every_matrix(*this, [](const Eigen::MatrixXd& m) { return m.size() == 0 || m == m.transpose(); });
}

double PeriodicMatrix::bound() const {
  double sum = row_sum_norm(mean);
  for (const auto& h : harmonics) sum += row_sum_norm(h.cosine) + row_sum_norm(h.sine);
  return sum;
}

std::optional<double> LinearPeriodicSystem::proportional_damping() const {
  if (!has_damping()) return 0.0;
  if (!damping.is_constant()) return std::nullopt;
  Eigen::Index row = 0, column = 0;
  mass.cwiseAbs().maxCoeff(&row, &column);
  const double c = damping.mean(row, column) / mass(row, column);
  if (mass.rows() == 1 || damping.mean == c * mass) return c;  // c * mass may be off by a rounding
  return std::nullopt;
}

void LinearPeriodicSystem::validate() const {
  require(period > 0.0 && std::isfinite(period), "linear.period", period, "a finite number > 0");
  if (mass.rows() == 0 || mass.rows() != mass.cols())
    throw InvalidInput("linear.mass", "matrix", "square, not empty");
  if (!mass.allFinite()) throw InvalidInput("linear.mass", "matrix", "finite in every entry");
  if (!Eigen::FullPivLU<Eigen::MatrixXd>(mass).isInvertible())
    throw InvalidInput("linear.mass", "matrix", "invertible");
  if (stiffness.mean.size() == 0) throw InvalidInput("linear.stiffness", "nothing", "given");
  check_shape(stiffness, mass.rows(), "linear.stiffness");
  check_shape(damping, mass.rows(), "linear.damping");
  require_orders("order in linear.stiffness.harmonics", stiffness.harmonics);
  require_orders("order in linear.damping.harmonics", damping.harmonics);
  if (damping.mean.size() == 0 && !damping.harmonics.empty()) {
    throw InvalidInput("linear.damping.mean", "nothing", "given with harmonics");
  }
}

}  // namespace strutt
