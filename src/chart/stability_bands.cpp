#include "strutt/chart/stability_bands.hpp"

#include <cmath>

#include "chart/unstable_intervals.hpp"
#include "strutt/base/error.hpp"
#include "strutt/base/floating_point.hpp"

namespace strutt {
namespace {

void validate_line(const Scene& scene, const TongueLine& line) {
  require(std::isfinite(line.from) && std::isfinite(line.to), line.parameter, line.to - line.from,
          "a finite range");
  require(line.from < line.to, line.parameter + ": TO", line.to, "above FROM = " + to_text(line.from));
  Scene changed = scene;
  for (const double end : {line.from, line.to}) {
    parameter(changed, line.parameter) = end;
    validate(changed);
    static_cast<void>(linear_model(changed));
  }
}

void set_from(StabilityBand& band, const std::optional<LineEdge>& edge, double otherwise) {
  band.from = edge ? edge->position : otherwise;
  if (!edge) return;
  band.from_error = edge->error;
  band.method = edge->method;
  if (edge->outcome != Outcome::converged) band.outcome = edge->outcome;
}

void set_to(StabilityBand& band, const std::optional<LineEdge>& edge, double otherwise) {
  band.to = edge ? edge->position : otherwise;
  if (!edge) return;
  band.to_error = edge->error;
  band.method = edge->method;
  if (edge->outcome != Outcome::converged) band.outcome = edge->outcome;
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
  validate_line(scene, line);
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
