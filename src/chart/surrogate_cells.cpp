#include "chart/surrogate_cells.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "chart/cell_engine.hpp"
#include "chart/factor_error.hpp"
#include "chart/surrogate_box.hpp"
#include "floquet/half_period_factors.hpp"
#include "floquet/turned_angle.hpp"

namespace strutt {
namespace {

using std::numbers::pi;

bool contains(const std::vector<Layer>& layers, Layer layer) {
  return std::find(layers.begin(), layers.end(), layer) != layers.end();
}

SurrogateOptions options_of(const ChartRequest& request) {
  return {.tolerance = request.tolerance,
          .threads = request.threads,
          .winding = contains(request.layers, Layer::winding),
          .cancel = request.cancel};
}

/// A property of the equation at each cell; NaN where there is none.
ProductTable table_of(HalfPeriodModel& model, const ChartRequest& request,
                      double CentredEquation::*property) {
  const auto value = [&](double x, double y) {
    const auto point = model.at(x, y);
    return point ? (*point).*property : std::numeric_limits<double>::quiet_NaN();
  };
  return *ProductTable::of(value, request.x, request.y);
}

/// trace M = exp(-h) 2 (u1 u2' + u1' u2) 2^(2 exponent).
double trace_of(const HalfPeriodFactors& f, double half_damping) {
  const double half_trace = f.value[0] * f.value[3] + f.value[1] * f.value[2];
  const double shift = std::floor(-half_damping / std::numbers::ln2);
  const double decay = half_damping == 0.0 ? 1.0 : std::exp(-half_damping - shift * std::numbers::ln2);
  const double exponent = std::clamp(2.0 * static_cast<double>(f.exponent) + shift, -5000.0, 5000.0);
  return std::ldexp(2.0 * decay * half_trace, static_cast<int>(exponent));
}

}  // namespace

SurrogateCells::SurrogateCells(const Scene& scene, const ChartRequest& request)
    : request_(request),
      with_verdict_(contains(request.layers, Layer::verdict)),
      parallel_{.threads = request.threads, .cancel = request.cancel},
      surrogate_(scene, request.x, request.y, options_of(request)),
      grid_(surrogate_.boxes(), request.x, request.y) {
  workers_.resize(static_cast<std::size_t>(thread_count(parallel_)));
  for (auto& worker : workers_) {
    worker.model = std::make_unique<HalfPeriodModel>(scene, request.x, request.y, surrogate_.even_phase());
  }
  half_damping_ = table_of(*workers_[0].model, request, &CentredEquation::half_damping);
  kappa_square_ = table_of(*workers_[0].model, request, &CentredEquation::kappa_square);
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
    summary.outcomes[static_cast<std::size_t>(Outcome::converged)] += count.cells;
    summary.largest_error = std::max(summary.largest_error, count.largest_error);
  }
  rest.clear();
  for (std::size_t cell = 0; cell < done_.size(); ++cell) {
    if (done_[cell] == 0) rest.push_back(cell);
  }
  return complete;
}

SurrogateCells::Count SurrogateCells::fill_piece(const GridPiece& piece, ChartStrip& strip, Worker& worker) {
  grid_.evaluate(piece, worker.factors);
  const SurrogateBox& box = grid_.box(piece);
  const double* const values = worker.factors.values.data();
  const std::size_t offset = (piece.row - strip.first_row) * strip.columns + piece.first_column;
  const bool shifted = surrogate_.even_phase() != 0.0;
  Count count;
  for (std::size_t c = 0; c < piece.columns; ++c) {
    const std::size_t column = piece.first_column + c;
    const double h = half_damping_(column, piece.row);
    const double kappa = std::max(1.0, std::sqrt(kappa_square_(column, piece.row)));
    HalfPeriodFactors factors{{}, box.error, box.exponent};
    for (std::size_t f = 0; f < 4; ++f) factors.value[f] = values[f * FactorRow::stride + c];
    const auto scaled = at_kappa(factors.value, factors.error, kappa / box.kappa);
    const double error = monodromy_error(scaled.value, scaled.error, {box.exponent, h, kappa, shifted});
    if (!(error <= request_.tolerance)) continue;
    const auto gap = discriminant_gap(factors);
    const Margin margin = hill_margin(gap, h);
    const Verdict verdict = verdict_of(margin);
    if (with_verdict_ && verdict == Verdict::unresolved) continue;
    for (std::size_t l = 0; l < request_.layers.size(); ++l) {
      double& value = strip.values[l][offset + c];
      switch (request_.layers[l]) {
        case Layer::verdict:
          value = static_cast<double>(verdict);
          break;
        case Layer::growth:
          value = hill_growth(gap, h);
          break;
        case Layer::winding:
          value = winding_number(
              factors, gap, quadrant(factors, quarter_turns(piece, c, factors.value, box.kappa, worker)));
          break;
        case Layer::discriminant:
          value = written_trace(trace_of(factors, h));
          break;
        case Layer::margin:
          value = margin.value;
          break;
        case Layer::outcome:
          value = static_cast<double>(Outcome::converged);
      }
    }
    done_[offset + c] = 1;
    ++count.cells;
    count.largest_error = std::max(count.largest_error, error);
  }
  return count;
}

double SurrogateCells::quarter_turns(const GridPiece& piece, std::size_t c,
                                     const std::array<double, 4>& factors, double kappa,
                                     Worker& worker) const {
  if (grid_.box(piece).quarter_turns.size() > 0) return worker.factors.values[4 * FactorRow::stride + c];
  const auto point = worker.model->at(request_.x.value(piece.first_column + c), request_.y.value(piece.row));
  if (!point) return std::numeric_limits<double>::quiet_NaN();
  return lifted_angle(point->equation.coefficient, pi, factors[1], factors[3], kappa) / (0.5 * pi);
}

}  // namespace strutt
