#include "chart/edge_function.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <utility>

#include "base/constants.hpp"
#include "chart/surrogate_scope.hpp"
#include "floquet/square_wave.hpp"
#include "strutt/base/error.hpp"
#include "strutt/floquet/characteristic_values.hpp"
#include "strutt/floquet/stability.hpp"

namespace strutt {
namespace {

constexpr int kBlock = 32;  // orders computed together

std::optional<double> amplitude_of_one_harmonic(const PeriodicFunction& v) {
  if (v.is_constant()) return 0.0;
  if (v.harmonics().size() != 1 || v.harmonics().front().order != 1) return std::nullopt;
  return std::hypot(v.harmonics().front().cosine, v.harmonics().front().sine);
}

/// Whether both are multiples, not of opposite sign, of one cosine, one sine or one square wave.
bool same_direction(const PeriodicFunction& a, const PeriodicFunction& b) {
  if (is_square(a) || is_square(b)) return a.square_amplitude() * b.square_amplitude() > 0.0;
  const auto first = [](const PeriodicFunction& v) {
    return v.is_constant() ? Harmonic{} : v.harmonics().front();
  };
  const Harmonic x = first(a), y = first(b);
  return x.cosine * y.cosine >= 0.0 && x.sine * y.sine >= 0.0 &&
         ((x.cosine == 0.0 && y.cosine == 0.0) || (x.sine == 0.0 && y.sine == 0.0));
}

double sum_of_amplitudes(const PeriodicFunction& v) {
  if (is_square(v)) return v.deviation();
  double sum = 0.0;
  for (const Harmonic& h : v.harmonics()) sum += std::abs(h.cosine) + std::abs(h.sine);
  return sum;
}

/// Mathieu's: delta = a/4 at q = 2 epsilon, whose rounding moves a by 2 of it at most.
TongueEdges mathieu_edges(const CharacteristicPair& pair, double epsilon) {
  const auto quarter = [&](const CharacteristicValue& x) {
    return CharacteristicValue{0.25 * x.value, 0.25 * x.error + 2.0 * kUnit * epsilon};
  };
  if (!pair.b) return {pair.order, std::nullopt, quarter(pair.a)};
  return {pair.order, quarter(*pair.b), quarter(pair.a)};
}

}  // namespace

double change_between(const LinePoint& a, const LinePoint& b) {
  double sum = std::abs(a.mean + a.damping_shift - (b.mean + b.damping_shift)) +
               std::abs(a.damping_shift - b.damping_shift);
  if (is_square(a.variation) || is_square(b.variation))  // where it jumps does not matter
    return sum + std::abs(a.variation.square_amplitude() - b.variation.square_amplitude());
  const auto left = a.variation.harmonics(), right = b.variation.harmonics();
  for (auto i = left.begin(), j = right.begin(); i != left.end() || j != right.end();) {
    const bool one = j == right.end() || (i != left.end() && i->order < j->order);
    const bool two = i == left.end() || (j != right.end() && j->order < i->order);
    const Harmonic x = two ? Harmonic{} : *i, y = one ? Harmonic{} : *j;
    sum += std::abs(x.cosine - y.cosine) + std::abs(x.sine - y.sine);
    if (!two) ++i;
    if (!one) ++j;
  }
  return sum;
}

LineEquation::LineEquation(const Scene& scene, const TongueLine& line)
    : scene_(scene), value_(&parameter(scene_, line.parameter)) {
  one_variation_ = same_function(at(line.from).variation, at(line.to).variation);
}

TongueEdges LineEquation::mathieu_tongue(double epsilon, int order) {
  const int first = one_variation_ ? order / kBlock * kBlock : order;
  const int last = one_variation_ ? std::min(first + kBlock - 1, kLargestTongue) : order;
  if (mathieu_.empty() || mathieu_epsilon_ != epsilon || mathieu_.front().order != first) {
    mathieu_epsilon_ = epsilon;
    mathieu_.clear();
    for (const auto& pair : characteristic_values(first, last, 2.0 * epsilon))
      mathieu_.push_back(mathieu_edges(pair, epsilon));
  }
  return mathieu_[static_cast<std::size_t>(order - first)];
}

std::optional<HillEquation> LineEquation::hill_equation_of(const Scene& scene) {
  const LinearModel model = linear_model(scene);
  if (const auto* equation = std::get_if<HillEquation>(&model)) return *equation;
  return as_hill_equation(std::get<LinearPeriodicSystem>(model));
}

HillEquation LineEquation::equation(double parameter) {
  *value_ = parameter;
  auto equation = hill_equation_of(scene_);
  if (!equation) throw InvalidInput("[linear] with these values is no equation of second order");
  return *equation;
}

double LineEquation::half_damping(double parameter) {
  return std::numbers::pi * equation(parameter).canonical_damping();
}

LinePoint LineEquation::at(double parameter) {
  const HillEquation hill = equation(parameter);
  const auto& w = hill.coefficient;
  const double half = 0.5 * hill.canonical_damping(), shift = half * half;
  const PeriodicFunction v = w.plus(-w.mean());
  const double relative = hill.coefficient_error;
  const double error =
      relative * (std::abs(w.mean()) + sum_of_amplitudes(v)) + (relative + 8.0 * kUnit) * shift;
  return {.parameter = parameter,
          .mean = w.mean() - shift,
          .variation = v,
          .damping_shift = shift,
          .error = error,
          .relative_error = relative};
}

double LineEquation::growth(double parameter) {
  *value_ = parameter;
  const StabilityParts parts{.verdict = false, .winding = false, .matrix = false};
  return analyse(engine_, linear_model(scene_), {.tolerance = 1e-13}, parts).growth;
}

double EdgeFunction::Value::below(bool upper) const { return point.mean - edge(upper).value; }

double EdgeFunction::Value::error(bool upper) const {
  return point.error + edge(upper).error + kUnit * std::abs(below(upper));
}

const EdgeFunction::Value& EdgeFunction::at(double parameter) {
  if (const auto found = known_.find(parameter); found != known_.end()) return found->second;
  const LinePoint point = line_.at(parameter);
  const TongueEdges edges = tongue_.edges(point.variation, [&] { return edges_of(point, order()); });
  return known_.emplace(parameter, Value{point, edges}).first->second;
}

TongueEdges EdgeFunction::edges_of(const LinePoint& point, int order) {
  if (const auto epsilon = amplitude_of_one_harmonic(point.variation))
    return line_.mathieu_tongue(*epsilon, order);
  return tongue_edges(point.variation, order, order).front();
}

double EdgeFunction::gap(const Value& value, bool upper) {
  double result = kInfinity;
  for (const int next : {order() - 2, order() + 2}) {
    if (next < 0 || next > kLargestTongue) continue;
    const Value other{value.point, edges_of(value.point, next)};
    for (const bool edge : {false, true}) {
      const bool exists = edge || next > 0, alike = edge == upper || is_square(value.point.variation);
      if (!exists || !alike) continue;
      result = std::min(result, std::abs(other.edge(edge).value - value.edge(upper).value) -
                                    other.edge(edge).error - value.edge(upper).error);
    }
  }
  return result;
}

std::optional<double> EdgeFunction::bend(const Value& a, const Value& b, bool upper) {
  const auto &from = a.point.variation, &to = b.point.variation;
  if (a.point.mean != b.point.mean || order() + 2 > kLargestTongue || !same_direction(from, to)) return {};
  if (is_square(from)) {
    const auto left = square_wave_upper_is_even(from.deviation(), a.edges),
               right = square_wave_upper_is_even(to.deviation(), b.edges);
    if (!left || left != right) return {};
  } else if (!amplitude_of_one_harmonic(from) || !amplitude_of_one_harmonic(to)) {
    return {};
  }
  const double change = change_between(a.point, b.point);
  const double least = std::min(gap(a, upper), gap(b, upper)) - change;  // each moves by half of it at most
  if (!(least > 0.0)) return {};
  return 0.25 * change * change / least;
}

std::optional<EdgeFunction::Slope> EdgeFunction::slope(bool upper, double from, double to,
                                                       const TongueLine& within) {
  constexpr int kNodes = 12;
  const double centre = 0.5 * (from + to);
  const double reach = 0.02 * std::max(std::abs(centre), 0.05 * (within.to - within.from));
  double low = std::max(within.from, centre - reach), high = std::min(within.to, centre + reach);
  if (centre > 0.0) low = std::max(low, 0.0);  // where V changes its sign edges may have a corner
  if (centre < 0.0) high = std::min(high, 0.0);
  const double half = 0.5 * (high - low), middle = 0.5 * (high + low);
  if (from < low || to > high || to - from > 0.25 * half || !(half > 0.0)) return std::nullopt;
  std::array<double, kNodes> values, coefficients{};
  double noise = 0.0;
  for (int j = 0; j < kNodes; ++j) {
    const Value& value = at(middle + half * std::cos(std::numbers::pi * (j + 0.5) / kNodes));
    values[static_cast<std::size_t>(j)] = value.below(upper);
    noise = std::max(noise, 2.0 * kUnit * (std::abs(value.point.mean) + std::abs(value.edges.upper.value)));
  }
  for (int k = 0; k < kNodes; ++k) {
    double& sum = coefficients[static_cast<std::size_t>(k)];
    for (int j = 0; j < kNodes; ++j)
      sum += values[static_cast<std::size_t>(j)] * std::cos(std::numbers::pi * k * (j + 0.5) / kNodes);
    sum *= 2.0 / kNodes;
  }
  // T_k' = k U_(k-1); three Gauss points give the mean of the slope
  const auto derivative = [&](double x) {
    const double t = std::clamp((x - middle) / half, -1.0, 1.0);
    double sum = 0.0, before = 0.0, u = 1.0;
    for (int k = 1; k < kNodes; ++k) {
      sum += k * coefficients[static_cast<std::size_t>(k)] * u;
      const double next = 2.0 * t * u - before;
      before = u;
      u = next;
    }
    return sum / half;
  };
  const double side = std::sqrt(0.6) * 0.5 * (to - from);
  const double mean =
      (5.0 * derivative(centre - side) + 8.0 * derivative(centre) + 5.0 * derivative(centre + side)) / 18.0;
  const double rest = (std::abs(coefficients[kNodes - 1]) + std::abs(coefficients[kNodes - 2])) * kNodes;
  return Slope{mean, (rest + 4.0 * kNodes * noise) / half / std::abs(mean)};
}

}  // namespace strutt
