#include "chart/surrogate_grid.hpp"

#include <algorithm>

#include "chart/chebyshev.hpp"
#include "chart/tensor_kernel.hpp"

namespace strutt {
namespace {

/// Place across the box, in [-1, 1].
double local(const SurrogateBox& box, std::size_t axis, double coordinate) {
  const double middle = 0.5 * (box.low[axis] + box.high[axis]), half = 0.5 * (box.high[axis] - box.low[axis]);
  return (coordinate - middle) / half;
}

std::vector<double> coordinates_of(const Axis& axis, double low, double high) {
  std::vector<double> result;
  for (std::size_t i = 0; i < axis.points; ++i) {
    result.push_back(std::clamp(Surrogate::coordinate(axis, axis.value(i)), low, high));
  }
  return result;
}

/// weights[k] = sum_l c(k, l) T_l, the function along a row as a sum of T_k. Small terms first.
void contract(const Eigen::MatrixXd& c, const std::vector<double>& polynomials, double* weights) {
  std::fill_n(weights, c.rows(), 0.0);
  for (Eigen::Index l = c.cols(); l-- > 0;) {
    const double* const column = c.data() + l * c.rows();
    const double factor = polynomials[static_cast<std::size_t>(l)];
    for (Eigen::Index k = 0; k < c.rows(); ++k) weights[k] += column[k] * factor;
  }
}

}  // namespace

SurrogateGrid::SurrogateGrid(const std::vector<SurrogateBox>& boxes, const Axis& x, const Axis& y) {
  if (boxes.empty()) return;  // cancelled
  SurrogateBox whole = boxes.front();
  for (const auto& box : boxes) {
    for (std::size_t axis = 0; axis < 2; ++axis) {
      whole.low[axis] = std::min(whole.low[axis], box.low[axis]);
      whole.high[axis] = std::max(whole.high[axis], box.high[axis]);
    }
  }
  x_ = coordinates_of(x, whole.low[0], whole.high[0]);
  y_ = coordinates_of(y, whole.low[1], whole.high[1]);
  for (const auto& box : boxes) {
    if (!box.interpolated) continue;
    const Range columns = indices_in(x_, box.low[0], box.high[0], box.high[0] == whole.high[0]);
    const Range rows = indices_in(y_, box.low[1], box.high[1], box.high[1] == whole.high[1]);
    if (!columns.empty() && !rows.empty()) boxes_.push_back({&box, columns, rows, {}});
  }
}

SurrogateGrid::Range SurrogateGrid::indices_in(const std::vector<double>& coordinates, double low,
                                               double high, bool with_high) {
  const auto above = [&](double c) { return with_high ? c > high : c >= high; };
  const auto below = [&](double c) { return c < low; };
  const bool ascending = coordinates.front() <= coordinates.back();
  const auto first = std::partition_point(coordinates.begin(), coordinates.end(),
                                          [&](double c) { return ascending ? below(c) : above(c); });
  const auto last = std::partition_point(first, coordinates.end(),
                                         [&](double c) { return ascending ? !above(c) : !below(c); });
  return {static_cast<std::size_t>(first - coordinates.begin()),
          static_cast<std::size_t>(last - coordinates.begin())};
}

std::size_t SurrogateGrid::padded(const Range& columns) {
  constexpr std::size_t block = detail::kTensorColumns;
  return (columns.last - columns.first + block - 1) / block * block;
}

void SurrogateGrid::tabulate(Box& box) const {
  const std::size_t count = box.columns.last - box.columns.first, stride = padded(box.columns);
  const std::size_t terms = static_cast<std::size_t>(box.box->coefficients[0].rows());
  std::vector<double> t;
  for (std::size_t i = box.columns.first; i < box.columns.last; ++i) t.push_back(local(*box.box, 0, x_[i]));
  Eigen::MatrixXd columns;
  chebyshev::polynomials(t, static_cast<int>(terms) - 1, columns);
  box.basis.assign(terms * stride, 0.0);
  for (std::size_t k = 0; k < terms; ++k) {
    for (std::size_t c = 0; c < count; ++c)
      box.basis[k * stride + c] = columns(static_cast<Eigen::Index>(c), static_cast<Eigen::Index>(k));
  }
}

std::vector<GridPiece> SurrogateGrid::pieces(std::size_t first_row, std::size_t rows) {
  std::vector<GridPiece> result;
  for (std::size_t b = 0; b < boxes_.size(); ++b) {
    auto& box = boxes_[b];
    const std::size_t first = std::max(box.rows.first, first_row),
                      last = std::min(box.rows.last, first_row + rows);
    if (box.rows.last <= first_row) box.basis = {};  // its rows are over
    if (first >= last) continue;
    if (box.basis.empty()) tabulate(box);
    for (std::size_t row = first; row < last; ++row) {
      for (std::size_t c = box.columns.first; c < box.columns.last; c += FactorRow::stride)
        result.push_back({b, row, c, std::min(FactorRow::stride, box.columns.last - c)});
    }
  }
  return result;
}

void SurrogateGrid::contract_row(const GridPiece& piece, FactorRow& result) const {
  if (result.box == piece.box && result.row == piece.row) return;
  const SurrogateBox& box = *boxes_[piece.box].box;
  const auto terms = static_cast<std::size_t>(box.coefficients[0].rows());
  const double t = local(box, 1, y_[piece.row]);
  const auto degree = static_cast<std::size_t>(box.coefficients[0].cols()) - 1;
  auto& polynomials = result.polynomials;
  polynomials.assign(degree + 2, 1.0);
  polynomials[1] = t;
  for (std::size_t k = 2; k <= degree; ++k)
    polynomials[k] = 2.0 * t * polynomials[k - 1] - polynomials[k - 2];
  result.weights.resize(box.coefficients.size() * terms);
  for (std::size_t f = 0; f < box.coefficients.size(); ++f)
    contract(box.coefficients[f], polynomials, &result.weights[f * terms]);
  result.box = piece.box;
  result.row = piece.row;
}

void SurrogateGrid::evaluate(const GridPiece& piece, FactorRow& result) const {
  contract_row(piece, result);
  const Box& box = boxes_[piece.box];
  const std::size_t functions = box.box->coefficients.size();
  result.values.resize(functions * FactorRow::stride);
  detail::evaluate({.basis = box.basis.data() + (piece.first_column - box.columns.first),
                    .basis_stride = padded(box.columns),
                    .weights = result.weights.data(),
                    .functions = functions,
                    .terms = static_cast<std::size_t>(box.box->coefficients[0].rows()),
                    .values = result.values.data(),
                    .stride = FactorRow::stride,
                    .columns = padded({0, piece.columns})});
}

}  // namespace strutt
