#include "chart/resting_resonance.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <boost/math/tools/toms748_solve.hpp>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <numeric>
#include <vector>

namespace strutt {
namespace {

using std::numbers::pi;

bool is_zero(const Eigen::MatrixXd& m) { return m.size() == 0 || m.isZero(0.0); }

bool is_at_rest(const LinearPeriodicSystem& system) {
  return !system.has_damping() && system.mass == system.mass.transpose() && system.stiffness.is_symmetric() &&
         std::ranges::all_of(system.stiffness.harmonics,
                             [](const MatrixHarmonic& h) { return is_zero(h.cosine) && is_zero(h.sine); });
}

class RestingLine {
 public:
  RestingLine(const Scene& scene, const std::string& path)
      : scene_(scene), value_(&parameter(scene_, path)) {}
  RestingLine(const RestingLine&) = delete;

  /// T w/pi, ascending; empty where there is an equation of another kind.
  std::vector<double> half_turns(double p) {
    *value_ = p;
    const LinearModel model = linear_model(scene_);
    const auto* system = std::get_if<LinearPeriodicSystem>(&model);
    if (system == nullptr || !is_at_rest(*system)) return {};
    const Eigen::GeneralizedSelfAdjointEigenSolver<Eigen::MatrixXd> modes(
        system->stiffness.mean, system->mass, Eigen::EigenvaluesOnly);
    if (modes.info() != Eigen::Success || !(modes.eigenvalues().minCoeff() > 0.0)) return {};
    std::vector<double> result;
    for (const double square : modes.eigenvalues()) result.push_back(system->period * std::sqrt(square) / pi);
    return result;
  }

 private:
  Scene scene_;
  double* value_;
};

}  // namespace

std::optional<double> resting_resonance(const Scene& rest, const TongueLine& along, Mechanism mechanism,
                                        double near, double within) {
  RestingLine line(rest, along.parameter);
  const double from = std::max(along.from, near - within), to = std::min(along.to, near + within);
  const auto middle = line.half_turns(near), low = line.half_turns(from), high = line.half_turns(to);
  if (middle.empty() || low.empty() || high.empty()) return std::nullopt;
  std::optional<double> best;
  for (std::size_t i = 0; i < middle.size(); ++i)
    for (std::size_t j = 0; j <= i; ++j) {
      if ((i != j) != (mechanism == Mechanism::complex_pair)) continue;
      const auto turns = [&](const std::vector<double>& t) { return 0.5 * (t[i] + t[j]); };
      const double k = std::round(turns(middle));
      const bool odd = std::fmod(k, 2.0) != 0.0;
      if (k < 1.0 || (i == j && odd != (mechanism == Mechanism::minus_one))) continue;
      const double at_low = turns(low) - k, at_high = turns(high) - k;
      if (!(at_low * at_high < 0.0)) continue;
      const auto excess = [&](double p) {
        const auto t = line.half_turns(p);
        return t.empty() ? at_low : turns(t) - k;
      };
      std::uintmax_t steps = 100;
      const auto root = boost::math::tools::toms748_solve(
          excess, from, to, at_low, at_high, boost::math::tools::eps_tolerance<double>(52), steps);
      const double p = std::midpoint(root.first, root.second);
      if (!best || std::abs(p - near) < std::abs(*best - near)) best = p;
    }
  return best;
}

}  // namespace strutt
