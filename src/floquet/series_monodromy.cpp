#include <algorithm>

#include "floquet/assembly.hpp"
#include "floquet/propagators.hpp"
#include "floquet/undamped_hill.hpp"

namespace strutt {
namespace {

/// The propagators of the pieces of one equation.
Propagators<Eigen::Matrix2d> collected(std::span<SeriesPropagation> pieces) {
  Propagators<Eigen::Matrix2d> result;
  for (auto& piece : pieces) {
    if (piece.cost.steps == 0) result.outcome = Outcome::step_limit;
    result.cost += piece.cost;
    result.factors.push_back(std::move(piece.matrix));
  }
  return result;
}

/// One attempt at the equations that `wanted` names.
void attempt(SeriesPropagators& tables, const std::vector<UndampedHill>& equations,
             const std::vector<std::size_t>& wanted, double local_tolerance,
             std::vector<HillMonodromy>& results) {
  std::vector<SeriesJob> jobs;
  for (const std::size_t i : wanted) {
    const auto& y = equations[i];
    for (const auto& piece : y.pieces) {
      jobs.push_back({y.w.piece(0.5 * (piece.from + piece.to)), piece, y.kappa, y.coefficient_error});
    }
  }
  auto found = tables.propagate(jobs, local_tolerance);
  std::size_t begin = 0;
  for (const std::size_t i : wanted) {
    const auto& pieces = equations[i].pieces;
    auto made = equations[i].assembled(collected({found.data() + begin, pieces.size()}), pieces);
    made.cost += results[i].cost;
    results[i] = std::move(made);
    begin += pieces.size();
  }
}

}  // namespace

std::vector<HillMonodromy> series_monodromies(SeriesPropagators& tables,
                                              std::span<const HillEquation* const> equations,
                                              const MonodromyOptions& options) {
  std::vector<UndampedHill> undamped;
  undamped.reserve(equations.size());
  for (const auto* equation : equations) undamped.emplace_back(*equation);
  std::vector<HillMonodromy> results(equations.size());
  std::vector<std::size_t> wanted(equations.size());
  for (std::size_t i = 0; i < wanted.size(); ++i) wanted[i] = i;
  const ToleranceLadder ladder = series_ladder(options);
  double local = ladder.first;
  const auto cancelled = [&] { return options.cancel != nullptr && options.cancel->load(); };
  while (!wanted.empty() && !cancelled()) {
    attempt(tables, undamped, wanted, local, results);
    const bool last = local <= ladder.lowest;
    std::erase_if(wanted, [&](std::size_t i) {
      results[i].sharpest = last;
      return last || results[i].outcome != Outcome::converged || results[i].error <= options.tolerance;
    });
    local = std::max(kLadderStep * local, ladder.lowest);
  }
  for (const std::size_t i : wanted) results[i].outcome = Outcome::cancelled;
  for (auto& result : results) {
    settle(result, options.tolerance);
    result.method = Method::propagator;
  }
  return results;
}

}  // namespace strutt
