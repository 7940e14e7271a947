#include "strutt/chart/tongue_curves.hpp"

#include <algorithm>
#include <array>

#include "chart/curve_tracer.hpp"
#include "strutt/base/error.hpp"
#include "strutt/base/parallel.hpp"

namespace strutt {
namespace {

void validate(const CurveOptions& options) {
  require(options.tolerance >= 1e-13 && options.tolerance <= 1e-2, "tolerance", options.tolerance,
          "1e-13 to 1e-2");
  require(options.chord >= 1e-6 && options.chord <= 0.1, "chord", options.chord, "1e-6 to 0.1");
  require(options.count >= 0 && options.count <= kLargestTongue + 1, "count", options.count, "0 to 1001");
  require(options.slices >= 1, "slices", options.slices, "1 or more");
  require(options.resolution >= 1e-12 && options.resolution <= 1e-2, "resolution", options.resolution,
          "1e-12 to 1e-2");
  require(options.max_evaluations >= 1, "max_evaluations", static_cast<double>(options.max_evaluations),
          "1 or more");
  require(options.system_steps >= 2, "system_steps", options.system_steps, "2 or more");
}

void require_scale(const TongueLine& line, bool logarithmic) {
  require(!logarithmic || line.from * line.to > 0.0, line.parameter + ": FROM", line.from,
          "of the sign of TO = " + to_text(line.to) + " for its logarithm");
}

/// The scene at both ends of `over`, each checked on the line.
std::array<Scene, 2> ends_of(const Scene& scene, const TongueLine& along, const TongueLine& over) {
  if (along.parameter == over.parameter) throw InvalidInput("both parameters are '" + over.parameter + "'");
  require(over.from < over.to, over.parameter + ": TO", over.to, "above FROM = " + to_text(over.from));
  std::array<Scene, 2> ends{scene, scene};
  parameter(ends[0], over.parameter) = over.from;
  parameter(ends[1], over.parameter) = over.to;
  for (const Scene& end : ends) require_tongue_line(end, along);
  return ends;
}

}  // namespace

std::string_view to_string(CurvePoint::Kind kind) {
  switch (kind) {
    case CurvePoint::Kind::lower:
      return "lower";
    case CurvePoint::Kind::upper:
      return "upper";
    case CurvePoint::Kind::tip:
      break;
  }
  return "tip";
}

std::vector<TongueCurve> tongue_curves(const Scene& scene, const TongueLine& along, const TongueLine& over,
                                       const CurveOptions& options) {
  validate(options);
  const auto ends = ends_of(scene, along, over);
  require_scale(along, options.log_along);
  require_scale(over, options.log_over);
  const bool indexed = has_tongue_index(ends[0], along);
  if (indexed != has_tongue_index(ends[1], along))
    throw InvalidInput("tongues have an index at one end of '" + over.parameter + "' only");
  std::vector<int> orders{kNoOrder};
  if (indexed) {
    const int count = options.count > 0
                          ? options.count
                          : std::max(tongue_count(ends[0], along), tongue_count(ends[1], along));
    orders.clear();
    for (int n = 0; n < count; ++n) orders.push_back(n);
  } else {
    require(options.count == 0, "count", options.count, "0 where tongues have no index");
  }
  std::vector<std::vector<TongueCurve>> found(orders.size());
  Evaluations evaluations(options.max_evaluations);
  parallel_for(orders.size(), {.threads = options.threads, .cancel = options.cancel},
               [&](std::size_t i, int) {
                 SliceSource source(scene, along, over, orders[i], options, evaluations);
                 found[i] = CurveTracer(source, orders[i], options).curves();
               });
  std::vector<TongueCurve> result;
  for (auto& curves : found) std::ranges::move(curves, std::back_inserter(result));
  return result;
}

}  // namespace strutt
