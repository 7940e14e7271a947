#include "chart/surrogate_cells.hpp"

#include <algorithm>
#include <limits>
#include <utility>

#include "chart/cell_engine.hpp"
#include "chart/surrogate_box.hpp"

namespace strutt {
namespace {

constexpr double kShareBeforeTrace = 0.5;

bool contains(const std::vector<Layer>& layers, Layer layer) {
  return std::find(layers.begin(), layers.end(), layer) != layers.end();
}

/// A property of the equation at each cell; NaN where there is none.
ProductTable table_of(HillModel& model, const ChartRequest& request, double PointEquation::*property) {
  const auto value = [&](double x, double y) {
    const auto point = model.at(x, y);
    return point ? (*point).*property : std::numeric_limits<double>::quiet_NaN();
  };
  return *ProductTable::of(value, request.x, request.y);
}

}  // namespace

bool wants_trace_only(const ChartRequest& request) {
  return std::all_of(request.layers.begin(), request.layers.end(),
                     [](Layer layer) { return layer == Layer::discriminant || layer == Layer::outcome; });
}

SurrogateOptions surrogate_options(const ChartRequest& request) {
  const double share = wants_trace_only(request) ? kShareBeforeTrace : 1.0;
  return {.tolerance = std::max(share * request.tolerance, 1e-13),
          .threads = request.threads,
          .cancel = request.cancel};
}

SurrogateCells::SurrogateCells(const Scene& scene, const ChartRequest& request)
    : request_(request),
      with_verdict_(contains(request.layers, Layer::verdict)),
      with_winding_(contains(request.layers, Layer::winding)),
      parallel_{.threads = request.threads, .cancel = request.cancel},
      surrogate_(scene, request.x, request.y, surrogate_options(request)) {
  workers_.resize(static_cast<std::size_t>(thread_count(parallel_)));
  if (surrogate_.kind() == SurrogateKind::period) {
    for (auto& worker : workers_) worker.matrix = std::make_unique<MatrixCell>(scene, request);
    reciprocal_ = ReciprocalCells::of(scene, request);
  } else {
    prepare_factors(scene);
  }
  const auto grid_of = [&](const auto& boxes) { return SurrogateGrid(boxes, request.x, request.y); };
  if (surrogate_.kind() != SurrogateKind::period)
    traces_ = grid_of(trace_boxes(surrogate_.boxes(), request.tolerance, trace_scale()));
  grid_ = wants_trace_only(request) ? std::exchange(traces_, {}) : grid_of(surrogate_.boxes());
}

void SurrogateCells::prepare_factors(const Scene& scene) {
  for (auto& worker : workers_) {
    worker.model = std::make_unique<HillModel>(scene, request_.x, request_.y, surrogate_.even_phase());
  }
  half_damping_ = table_of(*workers_[0].model, request_, &PointEquation::half_damping);
  kappa_square_ = table_of(*workers_[0].model, request_, &PointEquation::kappa_square);
}

TraceScale SurrogateCells::trace_scale() const {
  return {.least_kappa = canonical_kappa(kappa_square_.smallest()),
          .largest_kappa = canonical_kappa(kappa_square_.largest()),
          .damped = half_damping_.largest() > 0.0,
          .shifted = *surrogate_.even_phase() != 0.0};
}

bool SurrogateCells::fill(ChartStrip& strip, ChartSummary& summary, std::vector<std::size_t>& rest) {
  const auto pieces = grid_.pieces(strip.first_row, strip.rows);
  traces_.pieces(strip.first_row, strip.rows);  // the same
  std::vector<Count> counts(pieces.size());
  const bool complete = parallel_for(pieces.size(), parallel_, [&](std::size_t k, int slot) {
    counts[k] = fill_piece(pieces[k], strip, workers_[static_cast<std::size_t>(slot)]);
  });
  Count all;
  for (const auto& count : counts) all += count;
  summary.cells += all.cells;
  summary.interpolated += all.cells;
  summary.methods[static_cast<std::size_t>(Method::surrogate)] += all.cells;
  summary.outcomes[static_cast<std::size_t>(Outcome::converged)] += all.cells;
  summary.largest_error = std::max(summary.largest_error, all.largest_error);
  rest.clear();
  if (all.cells < strip.rows * strip.columns) rest = rest_of(strip, pieces, counts);
  return complete;
}

/// The places of the strip that no piece has filled.
std::vector<std::size_t> SurrogateCells::rest_of(const ChartStrip& strip,
                                                 const std::vector<GridPiece>& pieces,
                                                 const std::vector<Count>& counts) {
  std::vector<char> done(strip.rows * strip.columns, 0);
  for (std::size_t k = 0; k < pieces.size(); ++k) {
    for (std::size_t r = 0; r < pieces[k].rows; ++r)
      std::fill_n(&done[pieces[k].offset(r, strip)], pieces[k].columns, 1);
    for (const std::size_t place : counts[k].open) done[place] = 0;
  }
  std::vector<std::size_t> rest;
  for (std::size_t place = 0; place < done.size(); ++place) {
    if (done[place] == 0) rest.push_back(place);
  }
  return rest;
}

SurrogateCells::Count& SurrogateCells::Count::operator+=(const Count& other) {
  cells += other.cells;
  largest_error = std::max(largest_error, other.largest_error);
  if (!other.open.empty()) open.insert(open.end(), other.open.begin(), other.open.end());
  return *this;
}

SurrogateCells::Count SurrogateCells::fill_piece(const GridPiece& piece, ChartStrip& strip, Worker& worker) {
  if (worker.matrix) return fill_matrices(piece, strip, worker);
  if (grid_.box(piece).coefficients.size() == 1) return fill_traces(piece, strip, worker);
  return fill_factors(piece, strip, worker);
}

/// trace M = exp(-h) D, which is all that is asked for.
SurrogateCells::Count SurrogateCells::fill_traces(const GridPiece& piece, ChartStrip& strip, Worker& worker) {
  const std::size_t offset = piece.offset(0, strip);
  for (std::size_t l = 0; l < request_.layers.size(); ++l) {
    double* const values = strip.values[l].data() + offset;
    if (request_.layers[l] == Layer::discriminant) {
      grid_.evaluate(piece, values, strip.columns);
      if (half_damping_.largest() > 0.0) damp(piece, values, strip.columns, worker);
    } else {
      for (std::size_t r = 0; r < piece.rows; ++r)
        std::fill_n(values + r * strip.columns, piece.columns, static_cast<double>(Outcome::converged));
    }
  }
  return {.cells = piece.rows * piece.columns, .largest_error = grid_.box(piece).error[0] + 8.0 * 0x1p-53};
}

void SurrogateCells::damp(const GridPiece& piece, double* values, std::size_t stride, Worker& worker) const {
  for (std::size_t r = 0; r < piece.rows; ++r) {
    worker.columns.set(half_damping_, kappa_square_, piece.first_row + r, piece.first_column, piece.columns);
    worker.columns.give(worker.cells, piece.first_column);
    for (std::size_t c = 0; c < piece.columns; ++c) values[r * stride + c] *= worker.cells.damping.decay[c];
  }
}

SurrogateCells::Count SurrogateCells::fill_matrices(const GridPiece& piece, ChartStrip& strip,
                                                    Worker& worker) {
  const SurrogateBox& box = grid_.box(piece);
  const Eigen::MatrixXd error = error_matrix(box);
  Eigen::MatrixXd value = error;  // of the same shape
  worker.factors.resize(box.coefficients.size() * GridPiece::kMostColumns);
  Count count;
  for (std::size_t cell = 0; cell < piece.rows * piece.columns; ++cell) {
    const std::size_t r = cell / piece.columns, c = cell % piece.columns;
    const std::size_t place = piece.offset(r, strip) + c;
    if (c == 0) {
      grid_.evaluate({piece.box, piece.first_row + r, 1, piece.first_column, piece.columns},
                     worker.factors.data(), GridPiece::kMostColumns);
    }
    for (Eigen::Index i = 0, f = 0; i < value.rows(); ++i) {
      for (Eigen::Index j = 0; j < value.cols(); ++j, ++f)
        value(i, j) = worker.factors[static_cast<std::size_t>(f) * GridPiece::kMostColumns + c];
    }
    const std::size_t column = piece.first_column + c, row = piece.first_row + r;
    const auto found = reciprocal_ ? reciprocal_->assess(column, row, box, value)
                                   : worker.matrix->assess(request_.x.value(column), request_.y.value(row),
                                                           box, value, error);
    const bool open = with_verdict_ && found.verdict == Verdict::unresolved;
    if (found.outcome != Outcome::converged || open) {
      count.open.push_back(place);
      continue;
    }
    for (std::size_t l = 0; l < request_.layers.size(); ++l)
      strip.values[l][place] = layer_value(found, request_.layers[l]);
    count += {1, found.error};
  }
  return count;
}

}  // namespace strutt
