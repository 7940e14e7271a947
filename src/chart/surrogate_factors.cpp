// From half-period factors to layers.
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

#include "base/constants.hpp"
#include "chart/surrogate_cells.hpp"
#include "floquet/half_period_factors.hpp"
#include "floquet/turned_angle.hpp"

namespace strutt {
namespace {

using std::numbers::pi;

constexpr std::size_t kTraceRows =
    8;  // of D at a time: the rows of a product that keeps its sums in registers
constexpr std::size_t kFactorColumns = GridPiece::kTileColumns;  // of factors: as many as stay in the cache
constexpr std::size_t kBendColumns = 480;                        // that share a bound of how D bends
constexpr double kLeastGap = 0.01;  // from D to 2, beyond which D tells as much as the factors

/// Whether D stays in the range of plain_cells.
bool is_plain(const SurrogateBox& box) {
  double size = 0.0;
  for (const auto& c : box.coefficients) size += c.cwiseAbs().sum();
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
  const auto bound = plain && !along_rows ? bound_of_trace(piece) : std::nullopt;
  worker.factors.resize(4 * kFactorColumns);
  worker.traces.resize(kTraceRows * GridPiece::kMostColumns);
  Edges edges;
  PieceWork work{piece, strip, worker, edges, along_rows, plain, bound};
  Count count;
  for (std::size_t r = 0; r < piece.rows; ++r) {
    const GridPiece row{piece.box, piece.first_row + r, 1, piece.first_column, piece.columns};
    if (bound && r % kTraceRows == 0) {
      const std::size_t rows = std::min(kTraceRows, piece.rows - r);
      traces_.evaluate({row.box, row.first_row, rows, row.first_column, row.columns}, worker.traces.data(),
                       GridPiece::kMostColumns);
    }
    count += fill_row(row, &worker.traces[r % kTraceRows * GridPiece::kMostColumns], work);
    if (!edges.agree) return std::nullopt;
  }
  return count;
}

std::optional<double> SurrogateCells::bound_of_trace(const GridPiece& piece) const {
  if (traces_.empty() || traces_.box(piece).coefficients.size() != 1) return std::nullopt;
  return trace_bound(traces_.box(piece).error[0], grid_.box(piece), trace_scale());
}

/// In runs.
SurrogateCells::Count SurrogateCells::fill_row(const GridPiece& row, const double* trace,
                                               PieceWork& work) const {
  find_runs(row, trace, work);
  Count count;
  for (const CellRun& run : work.worker.runs.runs()) {
    // cells that D cannot tell after all take their factors too: no more of them than there is room for
    for (std::size_t c = run.first; c < run.last; c += kFactorColumns) {
      const GridPiece cells{row.box, row.first_row, 1, row.first_column + c,
                            std::min(kFactorColumns, run.last - c)};
      count +=
          run.side == TraceSide::near ? fill_by_factors(cells, work) : fill_by_trace(cells, trace + c, work);
    }
  }
  return count;
}

void SurrogateCells::find_runs(const GridPiece& row, const double* trace, PieceWork& work) const {
  TraceRuns& runs = work.worker.runs;
  if (!work.trace_bound) {
    runs.set_near(row.columns);
    return;
  }
  runs.begin(trace, row.columns);
  for (std::size_t column = 0; column < row.columns; column += TraceRuns::kMostAdded) {
    const GridPiece part{row.box, row.first_row, 1, row.first_column + column,
                         std::min(TraceRuns::kMostAdded, row.columns - column)};
    // a bound that is not a number stays one: then D tells nothing
    runs.add(part.columns, std::max(traces_.bend(part, 0) + 2.0 * *work.trace_bound, kLeastGap));
  }
}

SurrogateCells::Count SurrogateCells::fill_by_factors(const GridPiece& cells, PieceWork& work) const {
  auto& [piece, strip, worker, edges, along_rows, plain, bound] = work;
  grid_.evaluate(cells, worker.factors.data(), kFactorColumns);
  prepare(cells, worker);
  const bool followed = with_winding_ && !along_rows;
  if (with_winding_ && along_rows) count_turns(cells, worker);
  if (followed && cells.first_column == piece.first_column) start_row(cells, piece, edges, worker);
  const Count count = fill_cells(cells, strip, worker, plain);
  if (followed && cells.first_column + cells.columns == piece.first_column + piece.columns)
    end_row(cells, piece, edges, worker);
  return count;
}

SurrogateCells::Count SurrogateCells::fill_by_trace(const GridPiece& cells, const double* trace,
                                                    PieceWork& work) const {
  CellRow& row = work.worker.cells;
  prepare(cells, work.worker);
  row.discriminant = trace;
  row.discriminant_error = traces_.box(cells).error[0] + 8.0 * kUnit;
  row.discriminant_bound = *work.trace_bound;
  return fill_cells(cells, work.strip, work.worker, true);
}

/// What the kernel wants to know of some cells of a row.
void SurrogateCells::prepare(const GridPiece& piece, Worker& worker) const {
  const SurrogateBox& box = grid_.box(piece);
  CellRow& cells = worker.cells;
  cells.count = piece.columns;
  cells.discriminant = nullptr;
  for (std::size_t f = 0; f < 4; ++f) cells.factors[f] = worker.factors.data() + f * kFactorColumns;
  std::copy_n(box.error.begin(), 4, cells.factor_error.begin());
  cells.exponent = box.exponent;
  cells.box_kappa = box.kappa;
  cells.shifted = *surrogate_.even_phase() != 0.0;
  cells.damped = half_damping_.largest() > 0.0;
  cells.quarter_turns = nullptr;
  worker.columns.set(half_damping_, kappa_square_, piece.first_row, piece.first_column, piece.columns);
  worker.columns.give(cells, piece.first_column);
}

/// Straight into the strip. Cells that do not hold are written again, point by point.
SurrogateCells::Count SurrogateCells::fill_cells(const GridPiece& piece, ChartStrip& strip, Worker& worker,
                                                 bool plain) const {
  const std::size_t offset = piece.offset(0, strip);
  CellRow& cells = worker.cells;
  leave_out_results(cells);
  for (std::size_t l = 0; l < request_.layers.size(); ++l) {
    double* const values = strip.values[l].data() + offset;
    if (double** const place = place_of(cells, request_.layers[l])) {
      *place = values;
    } else {
      std::fill_n(values, piece.columns, static_cast<double>(Outcome::converged));
    }
  }
  compute(cells, plain);
  if (cells.largest_error <= request_.tolerance && (!with_verdict_ || cells.all_resolved))
    return {piece.columns, cells.largest_error};
  return single_cells(piece, strip, worker, plain);
}

/// With the error of each.
SurrogateCells::Count SurrogateCells::single_cells(const GridPiece& piece, ChartStrip& strip, Worker& worker,
                                                   bool plain) const {
  CellRow& cells = worker.cells;
  double* const verdict = cells.verdict;
  if (cells.discriminant != nullptr) {
    grid_.evaluate(piece, worker.factors.data(), kFactorColumns);
    cells.discriminant = nullptr;
  }
  worker.error.resize(kFactorColumns);
  leave_out_results(cells);
  cells.error = worker.error.data();
  cells.verdict = verdict;
  compute(cells, plain);
  Count count;
  for (std::size_t c = 0; c < piece.columns; ++c) {
    const bool open = verdict != nullptr && verdict[c] == static_cast<double>(Verdict::unresolved);
    if (worker.error[c] <= request_.tolerance && !open) {
      count += {1, worker.error[c]};
    } else {
      count.open.push_back(piece.offset(0, strip) + c);
    }
  }
  return count;
}

/// The turns at cell c of some cells of a row, counted.
Turns SurrogateCells::turns_at(const GridPiece& cells, std::size_t c, Worker& worker) const {
  const auto point =
      worker.model->at(request_.x.value(cells.first_column + c), request_.y.value(cells.first_row));
  const double u2 = worker.cells.factors[1][c], du2 = worker.cells.factors[3][c];
  Turns turns{std::numeric_limits<double>::quiet_NaN(), sign_quadrant(u2, du2), 0};
  if (!point) return turns;
  turns.quadrant =
      std::floor(lifted_angle(point->equation.coefficient, pi, u2, du2, grid_.box(cells).kappa) / (0.5 * pi));
  return turns;
}

/// Turns at the first cell of a row: those of the row before, followed. They must be right in the last row.
void SurrogateCells::start_row(const GridPiece& cells, const GridPiece& piece, Edges& edges,
                               Worker& worker) const {
  const std::size_t row = cells.first_row - piece.first_row;
  if (row == 0) {
    edges.left = turns_at(cells, 0, worker);
  } else {
    edges.left.follow(worker.cells.factors[1][0], worker.cells.factors[3][0]);
    if (row + 1 == piece.rows)
      edges.agree = edges.agree && edges.left.quadrant == turns_at(cells, 0, worker).quadrant;
  }
  worker.cells.turns = {edges.left.quadrant, edges.left.pattern, 0};
}

/// Turns at the last cell of a row: those that come along the row and down the column must be the same.
void SurrogateCells::end_row(const GridPiece& cells, const GridPiece& piece, Edges& edges,
                             Worker& worker) const {
  const std::size_t row = cells.first_row - piece.first_row, c = cells.columns - 1;
  if (row == 0) {
    edges.right = turns_at(cells, c, worker);
  } else {
    edges.right.follow(worker.cells.factors[1][c], worker.cells.factors[3][c]);
    if (row + 1 == piece.rows)
      edges.agree = edges.agree && edges.right.quadrant == turns_at(cells, c, worker).quadrant;
  }
  const Turns& along = worker.cells.turns;
  edges.agree = edges.agree && std::max({edges.left.doubts, edges.right.doubts, along.doubts}) <= 1 &&
                along.quadrant == edges.right.quadrant;
}

/// At both ends, and on both sides of a step that leaves a choice. If what was followed up to one of these is
/// not what is counted there, at every cell.
void SurrogateCells::count_turns(const GridPiece& cells, Worker& worker) const {
  worker.quarter_turns.resize(kFactorColumns);
  double* const result = worker.quarter_turns.data();
  const std::size_t last = cells.columns - 1;
  Turns now = turns_at(cells, 0, worker);
  bool agree = true;
  for (std::size_t c = 0; c <= last; ++c) {
    const Turns before = now;
    if (c > 0) now.follow(worker.cells.factors[1][c], worker.cells.factors[3][c]);
    if (now.doubts > 0) {
      agree = agree && before.quadrant == turns_at(cells, c - 1, worker).quadrant;
      now = turns_at(cells, c, worker);
    }
    result[c] = now.quadrant + 0.5;
  }
  if (!agree || now.quadrant != turns_at(cells, last, worker).quadrant) {
    for (std::size_t c = 0; c <= last; ++c) result[c] = turns_at(cells, c, worker).quadrant + 0.5;
  }
  worker.cells.quarter_turns = result;
}

}  // namespace strutt
