// From half-period factors to layers.
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

#include "chart/surrogate_cells.hpp"
#include "floquet/half_period_factors.hpp"
#include "floquet/turned_angle.hpp"

namespace strutt {
namespace {

using std::numbers::pi;

// As many cells at a time as stay in the nearest cache: two rows of four factors are the rows of a product
// that keeps its sums in registers.
constexpr std::size_t kTileRows = 2, kTileColumns = GridPiece::kTileColumns;

/// Whether D stays in the range of plain_cells.
bool is_plain(const SurrogateBox& box) {
  double size = 0.0;
  for (const auto& c : box.coefficients) size = std::max(size, c.cwiseAbs().sum());
  const auto exponent = static_cast<double>(box.exponent);
  return std::abs(exponent) < 500.0 &&
         2.0 * (std::log(2.0 * size) + exponent * std::numbers::ln2) < kMostPlainLog;
}

/// Where results for a layer go; nowhere for the outcome, which is the same for all.
double** place_of(CellRow& cells, Layer layer) {
  switch (layer) {
    case Layer::verdict:
      return &cells.verdict;
    case Layer::growth:
      return &cells.growth;
    case Layer::winding:
      return &cells.winding;
    case Layer::discriminant:
      return &cells.trace;
    case Layer::margin:
      return &cells.margin;
    case Layer::outcome:
      break;
  }
  return nullptr;
}

void leave_out_results(CellRow& cells) {
  cells.error = cells.verdict = cells.margin = cells.growth = cells.winding = cells.trace = nullptr;
}

void compute(CellRow& cells, bool is_plain) {
  if (is_plain) {
    plain_cells(cells);
  } else {
    cells_in_log_form(cells);
  }
}

}  // namespace

/// Turns are counted at the corners of a piece, and followed by the signs of u2 and u2' along its first and
/// last columns and along its rows. The ends tell which way a single doubtful step went (in strong tongues
/// both change sign between two cells); where there are more, or the ends do not agree, they are counted
/// along each row.
SurrogateCells::Count SurrogateCells::fill_factors(const GridPiece& piece, ChartStrip& strip,
                                                   Worker& worker) {
  const auto count = fill_rows(piece, strip, worker, false);
  return count ? *count : *fill_rows(piece, strip, worker, true);
}

std::optional<SurrogateCells::Count> SurrogateCells::fill_rows(const GridPiece& piece, ChartStrip& strip,
                                                               Worker& worker, bool along_rows) {
  const bool plain = is_plain(grid_.box(piece)) && half_damping_.largest() < kMostPlainLog;
  worker.factors.resize(kTileRows * 4 * kTileColumns);
  CellRow& cells = worker.cells;
  Edges edges;
  std::array<Turns, kTileRows> turns;
  Count count;
  for (std::size_t first = 0; first < piece.rows; first += kTileRows) {
    for (std::size_t column = 0; column < piece.columns; column += kTileColumns) {
      const GridPiece tile{piece.box, piece.first_row + first, std::min(kTileRows, piece.rows - first),
                           piece.first_column + column, std::min(kTileColumns, piece.columns - column)};
      grid_.evaluate(tile, worker.factors.data(), kTileColumns);
      for (std::size_t r = 0; r < tile.rows; ++r) {
        prepare(tile, r, worker);
        if (with_winding_ && along_rows) count_turns(tile, r, worker);
        if (with_winding_ && !along_rows) {
          cells.turns = turns[r];
          if (column == 0) start_row(tile, r, piece, edges, worker);
        }
        count += fill_cells(tile, r, strip, worker, plain);
        turns[r] = cells.turns;
        if (with_winding_ && !along_rows && column + tile.columns == piece.columns)
          end_row(tile, r, piece, edges, worker);
        if (!edges.agree) return std::nullopt;
      }
    }
  }
  return count;
}

/// What the kernel wants to know of row r of a tile.
void SurrogateCells::prepare(const GridPiece& tile, std::size_t r, Worker& worker) const {
  const SurrogateBox& box = grid_.box(tile);
  CellRow& cells = worker.cells;
  cells.count = tile.columns;
  for (std::size_t f = 0; f < 4; ++f) cells.factors[f] = worker.factors.data() + (4 * r + f) * kTileColumns;
  std::copy_n(box.error.begin(), 4, cells.factor_error.begin());
  cells.exponent = box.exponent;
  cells.box_kappa = box.kappa;
  cells.shifted = *surrogate_.even_phase() != 0.0;
  cells.damped = half_damping_.largest() > 0.0;
  cells.quarter_turns = nullptr;
  worker.columns.set(half_damping_, kappa_square_, tile.first_row + r, tile.first_column, tile.columns);
  worker.columns.give(cells, tile.first_column);
}

/// Row r of a tile: straight into the strip. Cells that do not hold are written again, point by point.
SurrogateCells::Count SurrogateCells::fill_cells(const GridPiece& tile, std::size_t r, ChartStrip& strip,
                                                 Worker& worker, bool plain) {
  const std::size_t offset = tile.offset(r, strip);
  CellRow& cells = worker.cells;
  leave_out_results(cells);
  for (std::size_t l = 0; l < request_.layers.size(); ++l) {
    double* const values = strip.values[l].data() + offset;
    if (double** const place = place_of(cells, request_.layers[l])) {
      *place = values;
    } else {
      std::fill_n(values, tile.columns, static_cast<double>(Outcome::converged));
    }
  }
  compute(cells, plain);
  if (cells.largest_error <= request_.tolerance && (!with_verdict_ || cells.all_resolved))
    return {tile.columns, cells.largest_error};
  worker.error.resize(kTileColumns);
  double* const verdict = cells.verdict;
  leave_out_results(cells);
  cells.error = worker.error.data();
  cells.verdict = verdict;
  compute(cells, plain);
  Count count;
  for (std::size_t c = 0; c < tile.columns; ++c) {
    const bool open = verdict != nullptr && verdict[c] == static_cast<double>(Verdict::unresolved);
    if (worker.error[c] <= request_.tolerance && !open) {
      count += {1, worker.error[c]};
    } else {
      count.open.push_back(offset + c);
    }
  }
  return count;
}

/// The turns at cell c of row r of a tile, counted.
Turns SurrogateCells::turns_at(const GridPiece& tile, std::size_t r, std::size_t c, Worker& worker) const {
  const auto point =
      worker.model->at(request_.x.value(tile.first_column + c), request_.y.value(tile.first_row + r));
  const double u2 = worker.cells.factors[1][c], du2 = worker.cells.factors[3][c];
  Turns turns{std::numeric_limits<double>::quiet_NaN(), sign_quadrant(u2, du2), 0};
  if (!point) return turns;
  turns.quadrant =
      std::floor(lifted_angle(point->equation.coefficient, pi, u2, du2, grid_.box(tile).kappa) / (0.5 * pi));
  return turns;
}

/// Turns at the first cell of a row: those of the row before, followed. They must be right in the last row.
void SurrogateCells::start_row(const GridPiece& tile, std::size_t r, const GridPiece& piece, Edges& edges,
                               Worker& worker) const {
  const std::size_t row = tile.first_row + r - piece.first_row;
  if (row == 0) {
    edges.left = turns_at(tile, r, 0, worker);
  } else {
    edges.left.follow(worker.cells.factors[1][0], worker.cells.factors[3][0]);
    if (row + 1 == piece.rows)
      edges.agree = edges.agree && edges.left.quadrant == turns_at(tile, r, 0, worker).quadrant;
  }
  worker.cells.turns = {edges.left.quadrant, edges.left.pattern, 0};
}

/// Turns at the last cell of a row: those that come along the row and down the column must be the same.
void SurrogateCells::end_row(const GridPiece& tile, std::size_t r, const GridPiece& piece, Edges& edges,
                             Worker& worker) const {
  const std::size_t row = tile.first_row + r - piece.first_row, c = tile.columns - 1;
  if (row == 0) {
    edges.right = turns_at(tile, r, c, worker);
  } else {
    edges.right.follow(worker.cells.factors[1][c], worker.cells.factors[3][c]);
    if (row + 1 == piece.rows)
      edges.agree = edges.agree && edges.right.quadrant == turns_at(tile, r, c, worker).quadrant;
  }
  const Turns& along = worker.cells.turns;
  edges.agree = edges.agree && std::max({edges.left.doubts, edges.right.doubts, along.doubts}) <= 1 &&
                along.quadrant == edges.right.quadrant;
}

/// At both ends, and on both sides of a step that leaves a choice. If what was followed up to one of these is
/// not what is counted there, at every cell.
void SurrogateCells::count_turns(const GridPiece& tile, std::size_t r, Worker& worker) const {
  worker.quarter_turns.resize(kTileColumns);
  double* const result = worker.quarter_turns.data();
  const std::size_t last = tile.columns - 1;
  Turns now = turns_at(tile, r, 0, worker);
  bool agree = true;
  for (std::size_t c = 0; c <= last; ++c) {
    const Turns before = now;
    if (c > 0) now.follow(worker.cells.factors[1][c], worker.cells.factors[3][c]);
    if (now.doubts > 0) {
      agree = agree && before.quadrant == turns_at(tile, r, c - 1, worker).quadrant;
      now = turns_at(tile, r, c, worker);
    }
    result[c] = now.quadrant + 0.5;
  }
  if (!agree || now.quadrant != turns_at(tile, r, last, worker).quadrant) {
    for (std::size_t c = 0; c <= last; ++c) result[c] = turns_at(tile, r, c, worker).quadrant + 0.5;
  }
  worker.cells.quarter_turns = result;
}

}  // namespace strutt
