#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>
#include <vector>

#include "base/bracketed_zero.hpp"
#include "base/constants.hpp"
#include "base/minimum.hpp"
#include "chart/closing_tip.hpp"

namespace strutt {
namespace {

constexpr int kTongueSamples = 16;  // of the growth across a tongue: what has fewer maxima is seen
constexpr int kTurns = 30;          // five suffice

class WideTongue {
 public:
  WideTongue(DampedLine& damped, const TongueLine& line, const TongueEdge& low, const TongueEdge& high,
             const std::atomic<bool>* cancel)
      : damped_(damped),
        line_(line),
        order_(low.order),
        low_(low.position),
        high_(high.position),
        cancel_(cancel) {}

  ClosingDamping tip() {
    Tip best{.place = std::midpoint(low_, high_)};
    for (const double start : starts()) {
      const Tip tip = climb(start);
      if (tip.damping > best.damping) best = tip;
    }
    const double error = best.damping > 0.0 ? damped_.error(best.place, best.damping) + best.left : kInfinity;
    return {.damping = best.damping, .error = error, .position = best.place};
  }

 private:
  struct Tip {
    double place = 0.0, damping = 0.0;
    double left = kInfinity;  ///< to the maximum, relative
  };

  /// How much more damping the tongue could stand at a point, if damping did not shift the mean; no more than
  /// -c outside of it.
  double excess(double p, double c) {
    if (cancel_ != nullptr && *cancel_) return -c;
    const Stability s = damped_.at(p, c);
    const bool inside = (s.discriminant > 0.0) == (order_ % 2 == 0) && std::lround(2.0 * s.winding) == order_;
    return inside ? 2.0 * s.growth_per_time : -c;
  }

  /// Where the growth without damping has its maxima, as far as some points of the tongue show.
  std::vector<double> starts() {
    std::vector<double> places, values;
    for (int i = 0; i <= kTongueSamples; ++i) {
      places.push_back(std::lerp(low_, high_, static_cast<double>(i) / kTongueSamples));
      values.push_back(i == 0 || i == kTongueSamples ? 0.0 : excess(places.back(), 0.0));
    }
    std::vector<double> result;
    for (std::size_t i = 1; i + 1 < places.size(); ++i)
      if (values[i] > values[i - 1] && values[i] >= values[i + 1]) result.push_back(places[i]);
    return result;
  }

  /// In turn the place that stands most at a damping, and the damping that closes the tongue there: either
  /// squares the distance from the tip.
  Tip climb(double place) {
    Tip tip{.place = place};
    for (int turn = 0; turn < kTurns; ++turn) {
      const Minimum best = most_open(tip.place, tip.damping);
      const double rise = -best.value;
      tip.left = 4.0 * std::max(rise, 0.0) / tip.damping + 0x1p-50;  // a double's half of a maximum's digits
      if (!(rise > kUnit * tip.damping)) break;
      tip.place = best.place;
      tip.damping = closing(tip.place, tip.damping, rise);
    }
    return tip;
  }

  /// The maximum of the excess next to a place, on the line, with its sign turned.
  Minimum most_open(double place, double c) {
    const auto lack = [&](double p) { return -excess(p, c); };
    const Minimum here{place, lack(place)};
    const double low = beyond(here, line_.from, lack), high = beyond(here, line_.to, lack);
    Minimum best = least_between(lack, low, high, 28);
    for (const Minimum& other : {here, Minimum{low, lack(low)}, Minimum{high, lack(high)}})
      if (other.value < best.value) best = other;
    return best;
  }

  /// A place towards the end of the line, with the maximum before it or at that end.
  template <typename Function>
  double beyond(const Minimum& here, double end, const Function& lack) {
    const double first =
        std::max((high_ - low_) / kTongueSamples, kUnit * std::max(1.0, std::abs(here.place)));
    double last = here.value;
    return here.place + std::copysign(certain_distance(here.place, end, first,
                                                       [&](double p) {
                                                         const double value = lack(p);
                                                         return value > std::exchange(last, value);
                                                       }),
                                      end - here.place);
  }

  /// The damping that closes the tongue at a place where it stands `rise` more than c.
  double closing(double p, double c, double rise) {
    const auto function = [&](double damping) { return excess(p, damping); };
    double low = c, high = c + rise, at_low = rise, at_high = function(high);
    for (; at_high > 0.0; at_high = function(high)) {
      low = std::exchange(high, high + 2.0 * (high - c));
      at_low = at_high;
    }
    return at_high == 0.0 ? high : bracketed_zero(function, low, high, at_low, at_high, are_close).middle();
  }

  DampedLine& damped_;
  const TongueLine& line_;
  int order_;
  double low_, high_;
  const std::atomic<bool>* cancel_;
};

}  // namespace

ClosingDamping tip_by_multipliers(DampedLine& damped, const TongueLine& line, const TongueEdge& low,
                                  const TongueEdge& high, const std::atomic<bool>* cancel) {
  return WideTongue(damped, line, low, high, cancel).tip();
}

}  // namespace strutt
