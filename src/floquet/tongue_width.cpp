#include "strutt/floquet/tongue_width.hpp"

#include <algorithm>
#include <limits>
#include <numbers>
#include <numeric>
#include <utility>

#include "floquet/cancellable_width.hpp"
#include "floquet/fourier_excitation.hpp"
#include "floquet/resonant_block.hpp"
#include "floquet/square_wave.hpp"
#include "strutt/base/error.hpp"
#include "strutt/base/floating_point.hpp"

namespace strutt {
namespace {

template <unsigned digits>
using Wide = boost::multiprecision::number<boost::multiprecision::cpp_bin_float<digits>,
                                           boost::multiprecision::et_off>;

constexpr int kMostSteps = 40;
constexpr int kParts = 16;  // of the way between the edges

/// A bound of a width from both sides.
struct Enclosure {
  long double low = 0, high = std::numeric_limits<long double>::infinity();

  void narrow(long double from, long double to) {
    low = std::max(low, from);
    high = std::min(high, to);
  }
  TongueWidth width() const {
    if (high == 0) return {};
    const auto value = static_cast<double>(0.5L * (low + high));
    if (value == 0.0) return {0.0, 1.0};  // below the smallest double
    const long double radius = std::max(high - value, value - low);
    return {value, low > 0 ? static_cast<double>(radius / value * (1 + 0x1p-40L)) : 1.0};
  }
  bool sharp() const { return high == 0 || high - low <= kWidthAccuracy * low; }
};

/// Both edges in the precision of Real, as balls, and the width from them.
template <typename Real, typename Value>
class WidthSearch {
 public:
  /// `uncertainty`: what the coefficients may move the edges.
  WidthSearch(const HillMatrix& matrix, const TongueEdges& edges, double uncertainty,
              const std::atomic<bool>* cancel)
      : matrix_(matrix), order_(edges.order), cancel_(cancel) {
    lower_ = ball(*edges.lower, uncertainty);
    upper_ = ball(edges.upper, uncertainty);
  }

  void run(Enclosure& enclosure) {
    ResonantBlock<Value> block = at(hull());
    if (!block.finite()) return;
    use(block, enclosure);
    if (enclosure.sharp() || cancelled()) return;
    refine(block);
    const Ball<Real> difference = upper_ - lower_;
    enclosure.narrow(difference.lower(), difference.upper());
    if (cancelled()) return;
    block = at(hull());
    if (!block.finite()) return;
    use(block, enclosure);
    if (!enclosure.sharp() && block.coupling.value.lower() > 0) use_both_ends(enclosure);
  }

 private:
  bool cancelled() const { return cancel_ != nullptr && *cancel_; }

  static Ball<Real> ball(const CharacteristicValue& x, double uncertainty) {
    return {Real(x.value), (static_cast<long double>(x.error) + uncertainty) * Ball<Real>::kUp};
  }

  ResonantBlock<Value> at(const Ball<Real>& x) const {
    return ResonantElimination<Real, Value>(matrix_, order_, x, Direction::mean).run();
  }

  /// All within `reach` of a middle that is itself rounded.
  static Ball<Real> around(const Real& middle, long double reach) {
    return {middle, reach * Ball<Real>::kUp + Ball<Real>::unit() * Ball<Real>{middle, 0}.size()};
  }

  Ball<Real> hull() const {
    const Real middle = (lower_.middle + upper_.middle) / 2;
    const Ball<Real> half = Ball<Real>{upper_.middle, 0} - Ball<Real>{middle, 0};
    return around(middle, half.upper() + std::max(lower_.radius, upper_.radius));
  }

  /// width = 2 |beta|/|h'|, both anywhere in the hull.
  static void use(const ResonantBlock<Value>& block, Enclosure& enclosure) {
    const Ball<Value>&beta = block.coupling.value, &slope = block.distance.slope;
    const long double least = std::max(slope.lower(), 1.0L);
    constexpr long double up = Ball<Value>::kUp;
    enclosure.narrow(2 * beta.lower() / slope.upper() / up, 2 * beta.upper() / least * up);
  }

  /// width = (|beta(lower)| + |beta(upper)|)/(mean of h' between the edges), where beta does not vanish
  /// there: beta changes in the hull by a share as large as the width, which counts where coefficients are
  /// known to a rounding.
  void use_both_ends(Enclosure& enclosure) const {
    const ResonantBlock<Value> lower = at(lower_), upper = at(upper_);
    if (!lower.finite() || !upper.finite()) return;
    const auto &left = lower.coupling.value, &right = upper.coupling.value;
    const auto [least, largest] = mean_slope();
    constexpr long double up = Ball<Value>::kUp;
    enclosure.narrow((left.lower() + right.lower()) / largest / up,
                     (left.upper() + right.upper()) / least * up);
  }

  /// Bounds of the mean of h' between the edges, part by part.
  std::pair<long double, long double> mean_slope() const {
    constexpr long double up = Ball<Value>::kUp;
    const Real way = upper_.middle - lower_.middle;
    const long double half = hull().radius / kParts * up + std::max(lower_.radius, upper_.radius);
    long double least = 0, largest = 0;
    for (int j = 0; j < kParts; ++j) {
      const Real middle = lower_.middle + way * (2 * j + 1) / (2 * kParts);
      const auto block = at(around(middle, half));
      if (!block.finite() || cancelled()) return {1.0L, std::numeric_limits<long double>::infinity()};
      least += std::max(block.distance.slope.lower(), 1.0L);
      largest += block.distance.slope.upper();
    }
    return {least / kParts / up, largest / kParts * up};
  }

  /// Real coupling: the edges are the zeros of h - beta and h + beta, in one order or the other.
  void refine(const ResonantBlock<Real>& around) {
    const Ball<Real> slope = around.distance.slope, change = around.coupling.slope, both = hull();
    lower_ = zero(both, slope - change,
                  [](const auto& block) { return block.distance.value - block.coupling.value; });
    upper_ = zero(both, slope + change,
                  [](const auto& block) { return block.distance.value + block.coupling.value; });
  }

  /// Complex coupling: h = +-|beta|, whose slope lies within h' +- |beta'|.
  void refine(const ResonantBlock<WideComplex<Real>>& around) {
    const auto& fall = around.distance.slope;
    const Ball<Real> slope{fall.middle.re, fall.radius + around.coupling.slope.upper()};
    const auto side = [](int sign) {
      return [sign](const ResonantBlock<WideComplex<Real>>& block) {
        const auto &h = block.distance.value, &beta = block.coupling.value;
        const Real size = MidpointTraits<Value>::absolute(beta.middle);
        return Ball<Real>{h.middle.re, h.radius} +
               Ball<Real>{Real(sign * size), beta.radius + Ball<Value>::unit() * beta.size()};
      };
    };
    lower_ = zero(lower_, slope, side(-1));
    upper_ = zero(upper_, slope, side(1));
  }

  /// Newton's steps from the middle of a ball that holds the zero, as long as they gain.
  template <typename Function>
  Ball<Real> zero(Ball<Real> x, const Ball<Real>& slope, const Function& function) const {
    const Ball<Real> inverse = real_inverse(slope);
    for (int step = 0; inverse.finite() && step < kMostSteps && !cancelled(); ++step) {
      const Ball<Real> middle{x.middle, 0};
      const Ball<Real> next = middle - function(at(middle)) * inverse;
      if (!(next.radius < 0.5L * x.radius)) break;
      x = next;
    }
    return x;
  }

  const HillMatrix& matrix_;
  int order_;
  const std::atomic<bool>* cancel_;
  Ball<Real> lower_, upper_;
};

template <unsigned digits>
void search(const FourierExcitation& v, const TongueEdges& edges, const std::atomic<bool>* cancel,
            Enclosure& enclosure) {
  if (enclosure.sharp() || (cancel != nullptr && *cancel)) return;
  const HillMatrix matrix = v.matrix(HillBasis::bloch, edges.order % 2 == 0 ? 0.0 : 0.5);
  using Real = Wide<digits>;
  if (v.even)
    WidthSearch<Real, Real>(matrix, edges, v.uncertainty(), cancel).run(enclosure);
  else
    WidthSearch<Real, WideComplex<Real>>(matrix, edges, v.uncertainty(), cancel).run(enclosure);
}

/// |dh/dx| / |dh/dnu| in the middle of a tongue.
template <typename Real, typename Value>
double slope_ratio(const HillMatrix& matrix, const TongueEdges& edges) {
  const Ball<Real> middle{Real(std::midpoint(edges.lower->value, edges.upper.value)), 0};
  const auto slope = [&](Direction direction) {
    return ResonantElimination<Real, Value>(matrix, edges.order, middle, direction)
        .run()
        .distance.slope.size();
  };
  return static_cast<double>(slope(Direction::mean) / slope(Direction::exponent));
}

/// The largest common divisor of the orders: the true period of V is 2 pi over it.
int common_order(const FourierExcitation& v) {
  int divisor = 0;
  for (std::size_t m = 1; m < v.harmonics.size(); ++m)
    if (v.harmonics[m] != 0.0) divisor = std::gcd(divisor, static_cast<int>(m));
  return divisor;
}

}  // namespace

TongueWidth tongue_width(const PeriodicFunction& coefficient, const TongueEdges& edges,
                         double coefficient_error) {
  return cancellable_width(coefficient, edges, coefficient_error, nullptr);
}

TongueWidth cancellable_width(const PeriodicFunction& coefficient, const TongueEdges& edges,
                              double coefficient_error, const std::atomic<bool>* cancel) {
  const DefaultFloatingPoint environment;
  require(edges.order >= 1 && edges.lower.has_value(), "order of the tongue", edges.order, "1 or more");
  if (is_square_wave(coefficient))
    return square_wave_width(coefficient.deviation(), edges, coefficient_error);
  const FourierExcitation v(coefficient, coefficient_error);
  const int divisor = common_order(v);
  // the two modes do not meet
  if (divisor == 0 || edges.order % divisor != 0) return {};
  const auto &low = *edges.lower, &high = edges.upper;
  const long double difference = static_cast<long double>(high.value) - low.value;
  const long double error = static_cast<long double>(high.error) + low.error + 2.0L * v.uncertainty();
  Enclosure enclosure;
  enclosure.narrow(difference - error, difference + error);
  search<34>(v, edges, cancel, enclosure);
  if (v.uncertainty() == 0.0) {  // more digits than the coefficients have are of no use
    search<110>(v, edges, cancel, enclosure);
    search<350>(v, edges, cancel, enclosure);
  }
  return enclosure.width();
}

double narrow_tongue_growth(const PeriodicFunction& coefficient, const TongueEdges& edges,
                            const TongueWidth& width) {
  const DefaultFloatingPoint environment;
  require(edges.order >= 1 && edges.lower.has_value(), "order of the tongue", edges.order, "1 or more");
  if (width.value == 0.0 || width.relative_error >= 1.0) return 0.0;
  if (is_square_wave(coefficient)) return square_wave_growth(coefficient.deviation(), edges);
  const FourierExcitation v(coefficient);
  const HillMatrix matrix = v.matrix(HillBasis::bloch, edges.order % 2 == 0 ? 0.0 : 0.5);
  using Real = Wide<34>;
  const double ratio =
      v.even ? slope_ratio<Real, Real>(matrix, edges) : slope_ratio<Real, WideComplex<Real>>(matrix, edges);
  return std::numbers::pi * ratio * width.value;
}

}  // namespace strutt
