#include "chart/box_panel.hpp"

#include <algorithm>

#include "base/constants.hpp"
#include "chart/chebyshev.hpp"

namespace strutt {
namespace {

constexpr double kWidest = 1.5;  // of the 2 of the box: a wider panel needs about as many terms

/// Rounding of the coefficients on the panel: that of T_k, k^2 units, and of two products.
double rounding_of(const Eigen::MatrixXd& c) {
  double sum = 0.0;
  for (Eigen::Index k = 0; k < c.rows(); ++k)
    sum += c.row(k).cwiseAbs().sum() * static_cast<double>(4 * (k * k + c.rows() + 4));
  return kUnit * sum;
}

/// How many of the first rows are needed so that the others sum up to less than `allowed`.
Eigen::Index rows_needed(const Eigen::MatrixXd& c, double allowed) {
  Eigen::Index rows = c.rows();
  double sum = 0.0;
  while (rows > 1) {
    sum += c.row(rows - 1).cwiseAbs().sum();
    if (!(sum <= allowed)) break;
    --rows;
  }
  return rows;
}

}  // namespace

BoxPanel panel_of(const SurrogateBox& box, double low, double high) {
  const BoxPanel whole{-1.0, 1.0, box.coefficients, std::vector<double>(box.coefficients.size(), 0.0)};
  const Eigen::Index terms = box.coefficients[0].rows();
  if (terms < 2 || !(low < high) || high - low > kWidest) return whole;
  const Eigen::MatrixXd restriction = chebyshev::restriction(static_cast<int>(terms) - 1, low, high);
  BoxPanel panel{low, high, {}, {}};
  Eigen::Index rows = 1;
  for (std::size_t f = 0; f < box.coefficients.size(); ++f) {
    const auto& c = box.coefficients[f];
    const double allowed = (kPanelGrowth - 1.0) * box.error[f] - rounding_of(c);
    if (!(allowed > 0.0)) return whole;
    panel.coefficients.push_back(restriction * c);
    rows = std::max(rows, rows_needed(panel.coefficients[f], allowed));
  }
  if (4 * rows > 3 * terms) return whole;
  for (std::size_t f = 0; f < box.coefficients.size(); ++f) {
    auto& c = panel.coefficients[f];
    panel.error.push_back(c.bottomRows(terms - rows).cwiseAbs().sum() + rounding_of(box.coefficients[f]));
    c.conservativeResize(rows, c.cols());
  }
  return panel;
}

}  // namespace strutt
