#include "strutt/chart/tongues.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

#include "chart/edge_function.hpp"
#include "chart/require_line.hpp"
#include "chart/surrogate_scope.hpp"
#include "chart/system_tongues.hpp"
#include "chart/tongues_of_order.hpp"
#include "strutt/base/error.hpp"
#include "strutt/base/floating_point.hpp"

namespace strutt {
namespace {

/// Both ends of the line and its middle.
std::array<double, 3> samples_of(const TongueLine& line) {
  return {line.from, std::midpoint(line.from, line.to), line.to};
}

bool has_square_wave(const Scene& scene, const TongueLine& line) {
  LineEquation equation(scene, line);
  return std::ranges::any_of(samples_of(line), [&](double p) { return is_square(equation.at(p).variation); });
}

}  // namespace

std::string_view to_string(Mechanism mechanism) {
  switch (mechanism) {
    case Mechanism::plus_one:
      return "+1";
    case Mechanism::minus_one:
      return "-1";
    case Mechanism::complex_pair:
      break;
  }
  return "complex";
}

bool has_tongue_index(const Scene& scene, const TongueLine& line) {
  require_line(scene, line);
  if (!scene.linear) return true;
  Scene changed = scene;
  return std::ranges::all_of(samples_of(line), [&](double p) {
    parameter(changed, line.parameter) = p;
    return LineEquation::hill_equation_of(changed).has_value();
  });
}

Method tongue_method(const Scene& scene, const TongueLine& line) {
  if (!has_tongue_index(scene, line)) return Method::propagator;
  if (has_square_wave(scene, line)) return Method::exact;
  return is_damped(scene, line) ? Method::propagator : Method::fourier;
}

void require_tongue_line(const Scene& scene, const TongueLine& line) {
  if (!has_tongue_index(scene, line)) return;
  LineEquation equation(scene, line);
  for (const double end : {line.from, line.to}) tongue_edges(equation.at(end).variation, 0, 0);
}

int tongue_count(const Scene& scene, const TongueLine& line) {
  if (!has_tongue_index(scene, line)) throw InvalidInput("tongues of a system have no index, and no count");
  LineEquation equation(scene, line);
  // every coefficient is monotone on the line: the sums are largest with the larger of both ends
  const LinePoint low = equation.at(line.from), high = equation.at(line.to);
  const double amplitudes =
      change_between({.variation = low.variation}, {}) + change_between({.variation = high.variation}, {});
  const double most = std::max(low.mean, high.mean) + amplitudes;
  const double count = most < 0.0 ? 1.0 : std::floor(2.0 * std::sqrt(most) * (1.0 + 1e-12)) + 1.0;
  require(count <= kLargestTongue + 1, "number of tongues on the line", count,
          "at most 1001; --count takes the first of them");
  return static_cast<int>(count);
}

std::vector<TongueEdge> tongues(const Scene& scene, const TongueLine& line, const TongueOptions& options) {
  const DefaultFloatingPoint environment;
  require(options.tolerance >= 1e-13 && options.tolerance <= 1e-2, "tolerance", options.tolerance,
          "1e-13 to 1e-2");
  require(options.count >= 0 && options.count <= kLargestTongue + 1, "count", options.count, "0 to 1001");
  MonodromyEngine engine;
  if (!has_tongue_index(scene, line)) {
    require(options.count == 0, "count", options.count, "0 where tongues have no index");
    return system_tongues(engine, scene, line, options);
  }
  const int count = options.count > 0 ? options.count : tongue_count(scene, line);
  TonguesOfOrder of(engine, scene, line, options);
  std::vector<TongueEdge> result;
  for (int order = 0; order < count; ++order) {
    KnownTongue tongue(order, options.cancel);
    std::ranges::move(of.edges(tongue), std::back_inserter(result));
  }
  return result;
}

}  // namespace strutt
