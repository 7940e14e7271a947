#include "chart/margin_pieces.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

#include "base/minimum.hpp"
#include "chart/chebyshev.hpp"
#include "strutt/base/error.hpp"

namespace strutt {
namespace {

constexpr int kDegree = 8;
constexpr double kShortest = 1e-9;  // of the whole
constexpr int kMostMarginPieces = 10'000;

/// Coefficients of T_0 ... T_n, and a bound of what they leave out.
struct Interpolant {
  std::array<double, kDegree + 1> coefficients{};
  double rest = 0.0;

  bool zero() const {
    return std::ranges::all_of(coefficients, [](double c) { return c == 0.0; });
  }

  bool definite() const {
    double others = rest;
    for (std::size_t k = 1; k <= kDegree; ++k) others += std::abs(coefficients[k]);
    return std::abs(coefficients[0]) > others;
  }

  /// Of dp/dt; Markov: |T_n'| <= n^2.
  Interpolant derivative() const {
    Interpolant result;
    auto& d = result.coefficients;
    for (std::size_t k = kDegree; k-- > 0;)
      d[k] = (k + 2 <= kDegree ? d[k + 2] : 0.0) + 2.0 * static_cast<double>(k + 1) * coefficients[k + 1];
    d[0] *= 0.5;
    result.rest = kDegree * kDegree * rest;
    return result;
  }
};

class PieceSearch {
 public:
  PieceSearch(const std::function<Margin(double)>& function, double from, double to,
              const std::atomic<bool>* cancel)
      : function_(function),
        shortest_(kShortest * (to - from)),
        cancel_(cancel),
        places_{from, std::midpoint(from, to), to} {
    search(from, to);
    std::ranges::sort(places_);
    places_.erase(std::unique(places_.begin(), places_.end()), places_.end());
  }

  const std::vector<double>& places() const { return places_; }

 private:
  Interpolant interpolant(double a, double b) const {
    static const Eigen::MatrixXd transform = chebyshev::transform(kDegree);
    Eigen::VectorXd values(kDegree + 1);
    double error = 0.0;
    for (int j = 0; j <= kDegree; ++j) {
      // the ends themselves: neighbours share them
      const Margin m = function_(j == 0 ? b : j == kDegree ? a : chebyshev::point(j, kDegree, a, b));
      values[j] = m.value;
      error = std::max(error, m.error);
    }
    const Eigen::VectorXd c = transform * values;
    Interpolant result;
    for (int k = 0; k <= kDegree; ++k)
      result.coefficients[static_cast<std::size_t>(k)] = std::abs(c[k]) > error ? c[k] : 0.0;
    result.rest = std::abs(result.coefficients[kDegree]) + std::abs(result.coefficients[kDegree - 1]);
    return result;
  }

  void search(double a, double b) {
    if (cancel_ != nullptr && *cancel_) return;
    if (++pieces_ > kMostMarginPieces)
      throw NumericalFailure("no proof that all edges are found: the margin is not smooth along the line");
    const Interpolant p = interpolant(a, b);
    if (p.zero() || p.definite()) return;  // zero: within its error all the way
    const Interpolant slope = p.derivative();
    if (slope.definite()) return;
    const Interpolant curvature = slope.derivative();
    if (curvature.definite()) {
      add_extremum(a, b, std::copysign(1.0, curvature.coefficients[0]));
      return;
    }
    const double middle = std::midpoint(a, b);
    if (b - a <= shortest_ || !(a < middle && middle < b)) return;
    places_.push_back(middle);
    search(a, middle);
    search(middle, b);
  }

  /// The minimum of a convex function (sign 1) that is above zero at both ends, the maximum of a concave one
  /// (-1) that is below. With an end beyond zero there is one change of sign at most.
  void add_extremum(double a, double b, double sign) {
    const auto beyond = [&](double end) {
      const Margin m = function_(end);
      return sign * m.value < -m.error;
    };
    if (beyond(a) || beyond(b)) return;
    const auto value = [&](double x) { return sign * function_(x).value; };
    places_.push_back(least_between(value, a, b).place);
  }

  const std::function<Margin(double)>& function_;
  double shortest_;
  const std::atomic<bool>* cancel_;
  int pieces_ = 0;
  std::vector<double> places_;
};

}  // namespace

std::vector<double> sign_pieces(const std::function<Margin(double)>& function, double from, double to,
                                const std::atomic<bool>* cancel) {
  return PieceSearch(function, from, to, cancel).places();
}

}  // namespace strutt
