#include "io/figure_axis.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace strutt {
namespace {

constexpr int kMostAxisTicks = 9;
constexpr int kMostWideTicks = 4;
constexpr std::size_t kWideLabel = 9;
constexpr double kShortDecades = 3.1;
constexpr double kSlack = 1e-9;

/// The number with so many digits after the point; far from 1 as a multiple of a power of ten (in gnuplot's
/// markup).
std::string number_label(double value, double step) {
  if (value == 0.0) return "0";
  const int step_exponent = static_cast<int>(std::floor(std::log10(step) + kSlack));
  const int exponent = static_cast<int>(std::floor(std::log10(std::abs(value)) + kSlack));
  if (exponent > 5 || exponent < -4) {
    const int digits = std::clamp(exponent - step_exponent, 0, 15);
    return fmt::format("{:.{}f}\u00D710^{{{}}}", value * std::pow(10.0, -exponent), digits, exponent);
  }
  return fmt::format("{:.{}f}", value, std::clamp(-step_exponent, 0, 17));
}

double round_up_125(double value) {
  const double below = round_down_125(value);
  if (below >= value * (1.0 - kSlack)) return below;
  const double lead = below / std::pow(10.0, std::floor(std::log10(below) + kSlack));
  return below * (lead > 1.5 && lead < 3.0 ? 2.5 : 2.0);
}

std::vector<Tick> linear_ticks_at_most(const Axis& axis, int most) {
  const double low = std::min(axis.from, axis.to), high = std::max(axis.from, axis.to);
  const double step = round_up_125((high - low) / most);
  std::vector<Tick> ticks;
  if (!(step > 0.0) || !std::isfinite(step)) return ticks;
  for (double k = std::ceil(low / step - kSlack); k * step <= high + kSlack * step && ticks.size() < 50;
       k += 1.0) {
    const double value = std::abs(k) < 0.5 ? 0.0 : k * step;
    ticks.push_back({(value - axis.from) / (axis.to - axis.from), number_label(value, step)});
    if (!((k + 1.0) * step > k * step)) break;  // a range of a few roundings
  }
  return ticks;
}

std::vector<Tick> linear_ticks(const Axis& axis) {
  auto ticks = linear_ticks_at_most(axis, kMostAxisTicks);
  const bool wide =
      std::any_of(ticks.begin(), ticks.end(), [](const Tick& t) { return t.label.size() > kWideLabel; });
  return wide ? linear_ticks_at_most(axis, kMostWideTicks) : ticks;
}

std::vector<Tick> logarithmic_ticks(const Axis& axis) {
  const double sign = axis.from < 0.0 ? -1.0 : 1.0;
  const double from = std::log10(std::abs(axis.from)), to = std::log10(std::abs(axis.to));
  const double low = std::min(from, to), high = std::max(from, to);
  const bool short_range = high - low < kShortDecades;
  const int every = std::max(1, static_cast<int>(std::ceil((high - low) / kMostAxisTicks)));
  std::vector<Tick> ticks;
  for (int decade = static_cast<int>(std::floor(low)); decade <= high; ++decade) {
    for (int lead = 1; lead <= 9; ++lead) {
      const double exponent = decade + std::log10(lead);
      if (exponent < low - kSlack || exponent > high + kSlack || (lead > 1 && high - low > 12.0)) continue;
      const double value = sign * lead * std::pow(10.0, decade);
      const bool labelled =
          lead == 1 ? decade % every == 0 : short_range && (lead == 2 || lead == 5 || high - low < 0.7);
      const std::string power = fmt::format("{}10^{{{}}}", sign < 0 ? "-" : "", decade);
      const std::string label =
          lead == 1 && !short_range ? power : number_label(value, std::pow(10.0, decade));
      ticks.push_back({(exponent - from) / (to - from), labelled ? label : ""});
    }
  }
  return ticks;
}

bool has_labels(const std::vector<Tick>& ticks) {
  return std::count_if(ticks.begin(), ticks.end(), [](const Tick& t) { return !t.label.empty(); }) >= 2;
}

/// Where no round number fits twice, the ends speak for themselves.
std::vector<Tick> end_ticks(const Axis& axis) {
  return {{0.0, fmt::format("{}", axis.from)}, {1.0, fmt::format("{}", axis.to)}};
}

}  // namespace

double round_down_125(double value) {
  const double power = std::pow(10.0, std::floor(std::log10(value) + kSlack));
  const double lead = value / power * (1.0 + kSlack);
  return power * (lead >= 5.0 ? 5.0 : lead >= 2.0 ? 2.0 : 1.0);
}

std::vector<Tick> axis_ticks(const Axis& axis) {
  if (axis.points == 1 || axis.from == axis.to) return {{0.5, fmt::format("{}", axis.from)}};
  auto ticks = axis.scale == AxisScale::logarithmic ? logarithmic_ticks(axis) : linear_ticks(axis);
  return has_labels(ticks) ? ticks : end_ticks(axis);
}

std::string axis_label(const Axis& axis, const ParameterInfo& info) {
  const std::string name = info.label.empty() ? axis.parameter : info.label;
  return info.unit.empty() ? name : name + " [" + info.unit + "]";
}

}  // namespace strutt
