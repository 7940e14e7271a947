#include "chart/surrogate_cells.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "chart/cell_engine.hpp"
#include "chart/surrogate_box.hpp"
#include "chart/trace_boxes.hpp"
#include "floquet/half_period_factors.hpp"
#include "floquet/turned_angle.hpp"

namespace strutt {
namespace {

using std::numbers::pi;

constexpr double kShareBeforeTrace = 0.2;

bool contains(const std::vector<Layer>& layers, Layer layer) {
  return std::find(layers.begin(), layers.end(), layer) != layers.end();
}

bool only_trace(const ChartRequest& request) {
  return std::all_of(request.layers.begin(), request.layers.end(),
                     [](Layer layer) { return layer == Layer::discriminant || layer == Layer::outcome; });
}

/// A discriminant alone is interpolated once more, which takes its share of the error.
SurrogateOptions options_of(const ChartRequest& request) {
  const double share = only_trace(request) ? kShareBeforeTrace : 1.0;
  return {.tolerance = std::max(share * request.tolerance, 1e-13),
          .threads = request.threads,
          .cancel = request.cancel};
}

/// A property of the equation at each cell; NaN where there is none.
ProductTable table_of(HillModel& model, const ChartRequest& request, double PointEquation::*property) {
  const auto value = [&](double x, double y) {
    const auto point = model.at(x, y);
    return point ? (*point).*property : std::numeric_limits<double>::quiet_NaN();
  };
  return *ProductTable::of(value, request.x, request.y);
}

/// Whether D stays in the range of plain_cells.
bool is_plain(const SurrogateBox& box) {
  double size = 0.0;
  for (const auto& c : box.coefficients) size = std::max(size, c.cwiseAbs().sum());
  const auto exponent = static_cast<double>(box.exponent);
  return std::abs(exponent) < 500.0 &&
         2.0 * (std::log(2.0 * size) + exponent * std::numbers::ln2) < kMostPlainLog;
}

/// The results for a layer; none for the outcome, which is the same for all.
const double* layer_of(const CellRow& cells, Layer layer) {
  switch (layer) {
    case Layer::verdict:
      return cells.verdict;
    case Layer::growth:
      return cells.growth;
    case Layer::winding:
      return cells.winding;
    case Layer::discriminant:
      return cells.trace;
    case Layer::margin:
      return cells.margin;
    case Layer::outcome:
      break;
  }
  return nullptr;
}

}  // namespace

SurrogateCells::SurrogateCells(const Scene& scene, const ChartRequest& request)
    : request_(request),
      with_verdict_(contains(request.layers, Layer::verdict)),
      parallel_{.threads = request.threads, .cancel = request.cancel},
      surrogate_(scene, request.x, request.y, options_of(request)),
      boxes_(only_trace(request) && surrogate_.kind() == SurrogateKind::half_period
                 ? trace_boxes(surrogate_.boxes(), request.tolerance)
                 : surrogate_.boxes()),
      grid_(boxes_, request.x, request.y) {
  workers_.resize(static_cast<std::size_t>(thread_count(parallel_)));
  if (surrogate_.kind() == SurrogateKind::period) {
    for (auto& worker : workers_) worker.matrix = std::make_unique<MatrixCell>(scene, request);
    return;
  }
  for (auto& worker : workers_) {
    worker.model = std::make_unique<HillModel>(scene, request.x, request.y, surrogate_.even_phase());
  }
  half_damping_ = table_of(*workers_[0].model, request, &PointEquation::half_damping);
  kappa_square_ = table_of(*workers_[0].model, request, &PointEquation::kappa_square);
}

bool SurrogateCells::fill(ChartStrip& strip, ChartSummary& summary, std::vector<std::size_t>& rest) {
  const auto pieces = grid_.pieces(strip.first_row, strip.rows);
  std::vector<Count> counts(pieces.size());
  done_.assign(strip.rows * strip.columns, 0);
  const bool complete = parallel_for(pieces.size(), parallel_, [&](std::size_t k, int slot) {
    counts[k] = fill_piece(pieces[k], strip, workers_[static_cast<std::size_t>(slot)]);
  });
  for (const auto& count : counts) {
    summary.cells += count.cells;
    summary.interpolated += count.cells;
    summary.unresolved += count.unresolved;
    summary.outcomes[static_cast<std::size_t>(Outcome::converged)] += count.cells;
    summary.largest_error = std::max(summary.largest_error, count.largest_error);
  }
  rest.clear();
  std::size_t filled = 0;
  for (const auto& count : counts) filled += count.cells;
  if (filled == done_.size()) return complete;
  for (std::size_t cell = 0; cell < done_.size(); ++cell) {
    if (done_[cell] == 0) rest.push_back(cell);
  }
  return complete;
}

SurrogateCells::Count SurrogateCells::fill_piece(const GridPiece& piece, ChartStrip& strip, Worker& worker) {
  grid_.evaluate(piece, worker.factors);
  if (worker.matrix) return fill_matrices(piece, strip, worker);
  if (grid_.box(piece).coefficients.size() == 1) return fill_traces(piece, strip, worker);
  compute_cells(piece, worker);
  return write(piece, worker.cells, strip);
}

/// trace M = exp(-h) D, which is all that is asked for.
SurrogateCells::Count SurrogateCells::fill_traces(const GridPiece& piece, ChartStrip& strip, Worker& worker) {
  const std::size_t offset = (piece.row - strip.first_row) * strip.columns + piece.first_column;
  double* const traces = worker.factors.values.data();
  if (half_damping_.largest() > 0.0) {
    worker.columns.set(half_damping_, kappa_square_, piece.row, piece.first_column, piece.columns);
    worker.columns.give(worker.cells);
    for (std::size_t c = 0; c < piece.columns; ++c) traces[c] *= worker.cells.damping.decay[c];
  }
  for (std::size_t l = 0; l < request_.layers.size(); ++l) {
    double* const values = strip.values[l].data() + offset;
    if (request_.layers[l] == Layer::discriminant) {
      std::copy_n(traces, piece.columns, values);
    } else {
      std::fill_n(values, piece.columns, static_cast<double>(Outcome::converged));
    }
  }
  std::fill_n(done_.begin() + static_cast<std::ptrdiff_t>(offset), piece.columns, 1);
  return {.cells = piece.columns, .largest_error = grid_.box(piece).error[0] + 8.0 * 0x1p-53};
}

SurrogateCells::Count SurrogateCells::fill_matrices(const GridPiece& piece, ChartStrip& strip,
                                                    Worker& worker) {
  const SurrogateBox& box = grid_.box(piece);
  const std::size_t offset = (piece.row - strip.first_row) * strip.columns + piece.first_column;
  const double y = request_.y.value(piece.row);
  const Eigen::MatrixXd error = error_matrix(box);
  Eigen::MatrixXd value = error;  // of the same shape
  Count count;
  for (std::size_t c = 0; c < piece.columns; ++c) {
    for (Eigen::Index i = 0, f = 0; i < value.rows(); ++i) {
      for (Eigen::Index j = 0; j < value.cols(); ++j, ++f)
        value(i, j) = worker.factors.values[static_cast<std::size_t>(f) * FactorRow::stride + c];
    }
    const auto cell = worker.matrix->assess(request_.x.value(piece.first_column + c), y, box, value, error);
    // with more than two states the engine, too, leaves open what structure alone keeps at the edge
    const bool open = with_verdict_ && value.rows() == 2 && cell.verdict == Verdict::unresolved;
    if (cell.outcome != Outcome::converged || open) continue;
    for (std::size_t l = 0; l < request_.layers.size(); ++l)
      strip.values[l][offset + c] = layer_value(cell, request_.layers[l]);
    done_[offset + c] = 1;
    ++count.cells;
    count.unresolved += with_verdict_ && cell.verdict == Verdict::unresolved ? 1 : 0;
    count.largest_error = std::max(count.largest_error, cell.error);
  }
  return count;
}

void SurrogateCells::compute_cells(const GridPiece& piece, Worker& worker) const {
  const SurrogateBox& box = grid_.box(piece);
  CellRow& cells = worker.cells;
  cells.count = piece.columns;
  for (std::size_t f = 0; f < 4; ++f) cells.factors[f] = worker.factors.values.data() + f * FactorRow::stride;
  std::copy_n(box.error.begin(), 4, cells.factor_error.begin());
  cells.exponent = box.exponent;
  cells.box_kappa = box.kappa;
  cells.shifted = *surrogate_.even_phase() != 0.0;
  cells.with_growth = contains(request_.layers, Layer::growth);
  cells.with_winding = contains(request_.layers, Layer::winding);
  worker.columns.set(half_damping_, kappa_square_, piece.row, piece.first_column, piece.columns);
  worker.columns.give(cells);
  if (cells.with_winding) count_turns(piece, worker);
  cells.quarter_turns = worker.quarter_turns.data();
  if (is_plain(box) && half_damping_.largest() < kMostPlainLog) {
    plain_cells(cells);
  } else {
    cells_in_log_form(cells);
  }
}

/// The quadrant of (u2', u2) at one cell, whole turns counted.
double SurrogateCells::quadrant_at(const GridPiece& piece, std::size_t c, Worker& worker) const {
  const auto point = worker.model->at(request_.x.value(piece.first_column + c), request_.y.value(piece.row));
  if (!point) return std::numeric_limits<double>::quiet_NaN();
  const double u2 = worker.cells.factors[1][c], du2 = worker.cells.factors[3][c];
  return std::floor(lifted_angle(point->equation.coefficient, pi, u2, du2, grid_.box(piece).kappa) /
                    (0.5 * pi));
}

/// The quadrants along a piece: counted at both ends, between them followed from cell to cell by the signs of
/// u2 and u2'. Where these leave a choice, or the ends do not agree, every cell is counted.
void SurrogateCells::count_turns(const GridPiece& piece, Worker& worker) const {
  auto& turns = worker.quarter_turns;
  turns.resize(FactorRow::stride);
  const auto pattern = [&](std::size_t c) {
    return sign_quadrant(worker.cells.factors[1][c], worker.cells.factors[3][c]);
  };
  const std::size_t last = piece.columns - 1;
  bool certain = true;
  double now = quadrant_at(piece, 0, worker);
  int before = pattern(0);
  turns[0] = now + 0.5;
  for (std::size_t c = 1; c <= last; ++c) {
    const int here = pattern(c), step = (here - before + 5) % 4 - 1;  // -1, 0, 1 or 2
    certain = certain && step != 2;
    now += step;
    before = here;
    turns[c] = now + 0.5;
  }
  if (certain && (last == 0 || now == quadrant_at(piece, last, worker))) return;
  for (std::size_t c = 0; c <= last; ++c) turns[c] = quadrant_at(piece, c, worker) + 0.5;
}

/// Copies what holds into the strip.
SurrogateCells::Count SurrogateCells::write(const GridPiece& piece, const CellRow& cells, ChartStrip& strip) {
  const std::size_t offset = (piece.row - strip.first_row) * strip.columns + piece.first_column;
  constexpr double unresolved = static_cast<double>(Verdict::unresolved);
  Count count;
  for (std::size_t c = 0; c < cells.count; ++c) {
    const bool holds =
        cells.error[c] <= request_.tolerance && !(with_verdict_ && cells.verdict[c] == unresolved);
    done_[offset + c] = holds ? 1 : 0;
    count.cells += holds ? 1 : 0;
    count.largest_error = std::max(count.largest_error, holds ? cells.error[c] : 0.0);
  }
  for (std::size_t l = 0; l < request_.layers.size(); ++l) {
    double* const values = strip.values[l].data() + offset;
    const double* const source = layer_of(cells, request_.layers[l]);
    if (source == nullptr) {
      std::fill_n(values, cells.count, static_cast<double>(Outcome::converged));
    } else {
      std::copy_n(source, cells.count, values);  // cells that do not hold are written again, point by point
    }
  }
  return count;
}

}  // namespace strutt
