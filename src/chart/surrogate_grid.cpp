#include "chart/surrogate_grid.hpp"

#include <algorithm>
#include <cmath>

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

/// |f - chord| <= step^2/8 max|f''|, |T_k''| <= k^2 (k^2 - 1)/3; of the sums weights(k, r) T_k.
std::vector<double> bends_of(const std::vector<double>& weights, std::size_t rows, double step) {
  std::vector<double> result(rows, 0.0);
  for (std::size_t k = 2; k < weights.size() / rows; ++k) {
    const auto square = static_cast<double>(k * k), factor = square * (square - 1.0) / 24.0 * step * step;
    for (std::size_t r = 0; r < rows; ++r) result[r] += std::abs(weights[k * rows + r]) * factor;
  }
  return result;
}

/// Weights of one term; not a power of two, whose multiples share few places in the cache.
std::size_t weights_of(std::size_t rows, std::size_t functions) { return rows * functions + 8; }

constexpr std::size_t kPanelColumns = 4 * GridPiece::kTileColumns;

/// Pieces of about the same width, of whole tiles.
std::size_t width_of_pieces(std::size_t columns) {
  const std::size_t pieces = (columns + GridPiece::kMostColumns - 1) / GridPiece::kMostColumns;
  const std::size_t width = (columns + pieces - 1) / pieces;
  return (width + GridPiece::kTileColumns - 1) / GridPiece::kTileColumns * GridPiece::kTileColumns;
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
    if (!columns.empty() && !rows.empty()) boxes_.push_back({box, columns, rows, {}, {}});
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

void SurrogateGrid::cut_into_panels(Box& box) const {
  const std::vector<double> error = box.box.error;
  for (std::size_t c = box.columns.first; c < box.columns.last; c += kPanelColumns) {
    box.panels.push_back(panel(box, {c, std::min(c + kPanelColumns, box.columns.last)}));
    for (std::size_t f = 0; f < error.size(); ++f)
      box.box.error[f] = std::max(box.box.error[f], error[f] + box.panels.back().functions.error[f]);
  }
}

/// The polynomials reach back to the column before, see bend.
SurrogateGrid::Panel SurrogateGrid::panel(const Box& box, const Range& columns) const {
  const bool is_first = columns.first == box.columns.first;
  std::vector<double> t;
  for (std::size_t i = columns.first - (is_first ? 0 : 1); i < columns.last; ++i)
    t.push_back(local(box.box, 0, x_[i]));
  const auto [low, high] = std::minmax(t.front(), t.back());
  Panel result{panel_of(box.box, low, high), columns, {}, {}, {}, 0.0};
  const double middle = 0.5 * (result.functions.low + result.functions.high),
               half = 0.5 * (result.functions.high - result.functions.low);
  for (double& place : t) place = (place - middle) / half;
  for (std::size_t i = 1; i < t.size(); ++i) result.step = std::max(result.step, std::abs(t[i] - t[i - 1]));
  if (!is_first) t.erase(t.begin());
  Eigen::MatrixXd values;
  chebyshev::polynomials(t, static_cast<int>(result.terms()) - 1, values);
  result.basis.assign(values.data(), values.data() + values.size());
  return result;
}

/// weights(k, r) = sum_l c(k, l) T_l(t_r): the function along row r as a sum of T_k.
void SurrogateGrid::contract(Box& box, const Range& rows) const {
  const std::size_t functions = box.box.coefficients.size(), stride = weights_of(rows.size(), functions);
  std::vector<double> t;
  for (std::size_t j = rows.first; j < rows.last; ++j) t.push_back(local(box.box, 1, y_[j]));
  Eigen::MatrixXd polynomials;
  chebyshev::polynomials(t, static_cast<int>(box.box.coefficients[0].cols()) - 1, polynomials);
  box.weighted = rows;
  std::vector<double> weights;
  for (auto& panel : box.panels) {
    panel.weights.resize(panel.terms() * stride);
    weights.resize(panel.terms() * rows.size());
    for (std::size_t f = 0; f < functions; ++f) {
      const auto& c = panel.functions.coefficients[f];
      detail::evaluate({.basis = polynomials.data(),
                        .basis_stride = rows.size(),
                        .weights = c.data(),
                        .weights_stride = panel.terms(),
                        .rows = panel.terms(),
                        .columns = rows.size(),
                        .terms = static_cast<std::size_t>(c.cols()),
                        .values = weights.data(),
                        .stride = rows.size()});
      for (std::size_t k = 0; k < panel.terms(); ++k) {
        for (std::size_t r = 0; r < rows.size(); ++r)
          panel.weights[k * stride + r * functions + f] = weights[k * rows.size() + r];
      }
      if (f == 0) panel.bends = bends_of(weights, rows.size(), panel.step);
    }
  }
}

std::vector<GridPiece> SurrogateGrid::pieces(std::size_t first_row, std::size_t rows) {
  std::vector<GridPiece> result;
  for (std::size_t b = 0; b < boxes_.size(); ++b) {
    auto& box = boxes_[b];
    const Range here{std::max(box.rows.first, first_row), std::min(box.rows.last, first_row + rows)};
    if (box.rows.last <= first_row) box.panels = {};  // its rows are over
    if (here.empty()) continue;
    if (box.panels.empty()) cut_into_panels(box);
    contract(box, here);
    const std::size_t width = width_of_pieces(box.columns.size());
    for (std::size_t row = here.first; row < here.last; row += GridPiece::kMostRows) {
      for (std::size_t c = box.columns.first; c < box.columns.last; c += width)
        result.push_back({b, row, std::min(GridPiece::kMostRows, here.last - row), c,
                          std::min(width, box.columns.last - c)});
    }
  }
  return result;
}

void SurrogateGrid::evaluate(const GridPiece& piece, double* values, std::size_t stride) const {
  const Box& box = boxes_[piece.box];
  const std::size_t functions = box.box.coefficients.size(), last = piece.first_column + piece.columns;
  for (std::size_t column = piece.first_column; column < last;) {
    const Panel& panel = box.panels[(column - box.columns.first) / kPanelColumns];
    const std::size_t end = std::min(last, panel.columns.last);
    detail::evaluate({.basis = panel.basis.data() + (column - panel.columns.first),
                      .basis_stride = panel.columns.size(),
                      .weights = panel.weights.data() + (piece.first_row - box.weighted.first) * functions,
                      .weights_stride = weights_of(box.weighted.size(), functions),
                      .rows = piece.rows * functions,
                      .columns = end - column,
                      .terms = panel.terms(),
                      .values = values + (column - piece.first_column),
                      .stride = stride});
    column = end;
  }
}

double SurrogateGrid::bend(const GridPiece& piece, std::size_t r) const {
  const Box& box = boxes_[piece.box];
  const auto panel = [&](std::size_t column) { return (column - box.columns.first) / kPanelColumns; };
  double result = 0.0;
  for (std::size_t i = panel(piece.first_column); i <= panel(piece.first_column + piece.columns - 1); ++i)
    result = std::max(result, box.panels[i].bends[piece.first_row + r - box.weighted.first]);
  return result;
}

}  // namespace strutt
