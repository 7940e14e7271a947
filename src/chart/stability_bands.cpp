#include "strutt/chart/stability_bands.hpp"

#include <cmath>

#include "chart/require_line.hpp"
#include "chart/unstable_intervals.hpp"
#include "strutt/base/error.hpp"
#include "strutt/base/floating_point.hpp"

namespace strutt {
namespace {

/// The end of the band in `place`, from the edge or, without one, `otherwise`.
void set_end(StabilityBand& band, double StabilityBand::*place, double StabilityBand::*error,
             const std::optional<LineEdge>& edge, double otherwise) {
  band.*place = edge ? edge->position : otherwise;
  if (!edge) return;
  band.*error = edge->error;
  band.method = edge->method;
  if (edge->outcome != Outcome::converged) band.outcome = edge->outcome;
}

void set_from(StabilityBand& band, const std::optional<LineEdge>& edge, double otherwise) {
  set_end(band, &StabilityBand::from, &StabilityBand::from_error, edge, otherwise);
}

void set_to(StabilityBand& band, const std::optional<LineEdge>& edge, double otherwise) {
  set_end(band, &StabilityBand::to, &StabilityBand::to_error, edge, otherwise);
}

/// A line that no edge divides.
StabilityBand whole_line(const Scene& scene, const TongueLine& line) {
  MarginLine margins(scene, line.parameter);
  const Stability s = margins.at(0.5 * line.from + 0.5 * line.to, true);
  StabilityBand band{
      .from = line.from, .to = line.to, .verdict = s.verdict, .tongue = {}, .method = s.method};
  if (s.verdict == Verdict::unstable && !std::isnan(s.winding))
    band.tongue = static_cast<int>(std::lround(2.0 * s.winding));
  if (s.verdict == Verdict::unresolved) band.outcome = Outcome::tolerance_not_reached;
  return band;
}

}  // namespace

std::vector<StabilityBand> stability_bands(const Scene& scene, const TongueLine& line,
                                           const BandOptions& options) {
  const DefaultFloatingPoint environment;
  require(options.tolerance >= 1e-13 && options.tolerance <= 1e-2, "tolerance", options.tolerance,
          "1e-13 to 1e-2");
  require(options.samples >= 2 && options.samples <= 1'000'000, "samples", options.samples, "2 to 1e6");
  require_line(scene, line);
  const auto intervals = unstable_intervals(
      scene, line, {.tolerance = options.tolerance, .samples = options.samples, .cancel = options.cancel});
  if (intervals.empty()) return {whole_line(scene, line)};
  std::vector<StabilityBand> result;
  std::optional<LineEdge> last;  // where stability begins again
  bool stable = true;            // from the beginning of the line or from `last`
  for (const UnstableInterval& interval : intervals) {
    if (stable && interval.begin) {
      StabilityBand band{.tongue = {}};
      set_from(band, last, line.from);
      set_to(band, interval.begin, line.to);
      if (band.from < band.to) result.push_back(band);
    }
    StabilityBand band{.verdict = Verdict::unstable, .tongue = {}};
    if (interval.tongue != kNoTongue) band.tongue = interval.tongue;
    set_from(band, interval.begin, line.from);
    set_to(band, interval.end, line.to);
    result.push_back(band);
    last = interval.end;
    stable = last.has_value();
  }
  if (!stable) return result;
  StabilityBand band{.tongue = {}};
  set_from(band, last, line.from);
  set_to(band, std::nullopt, line.to);
  if (band.from < band.to) result.push_back(band);
  return result;
}

}  // namespace strutt
