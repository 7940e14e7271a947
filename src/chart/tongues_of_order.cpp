#include "chart/tongues_of_order.hpp"

#include <algorithm>
#include <array>
#include <numeric>

#include "chart/damped_tongue.hpp"
#include "chart/tongue_on_line.hpp"

namespace strutt {

bool is_damped(const Scene& scene, const TongueLine& line) {
  LineEquation equation(scene, line);
  const std::array<double, 3> places{line.from, std::midpoint(line.from, line.to), line.to};
  return std::ranges::any_of(places, [&](double p) { return equation.half_damping(p) > 0.0; });
}

TonguesOfOrder::TonguesOfOrder(MonodromyEngine& engine, const Scene& scene, const TongueLine& line,
                               const TongueOptions& options, Evaluations* evaluations)
    : line_(line),
      options_(options),
      equation_(scene, line_),
      changes_(change_between(equation_.at(line.from), equation_.at(line.to)) != 0.0),
      extended_(scene, line.parameter, options.cancel) {
  if (is_damped(scene, line)) verdicts_.emplace(engine, scene, line.parameter, false, evaluations);
}

std::vector<TongueEdge> TonguesOfOrder::edges(KnownTongue& known) {
  if (!changes_) return {};
  TongueOnLine tongue(equation_, known, line_, options_);
  if (!verdicts_) return tongue.edges();
  return DampedTongue(equation_, tongue, *verdicts_, extended_, line_, options_).edges();
}

}  // namespace strutt
