#include "chart/resting_resonance.hpp"

#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "base/constants.hpp"
#include "strutt/floquet/verdict.hpp"

namespace strutt {
namespace {

using std::numbers::pi;

bool is_zero(const Eigen::MatrixXd& m) { return m.size() == 0 || m.isZero(0.0); }

bool is_at_rest(const LinearPeriodicSystem& system) {
  return !system.has_damping() && system.mass == system.mass.transpose() && system.stiffness.is_symmetric() &&
         std::ranges::all_of(system.stiffness.harmonics,
                             [](const MatrixHarmonic& h) { return is_zero(h.cosine) && is_zero(h.sine); });
}

/// T w/pi with bounds of their errors.
struct ModeTurns {
  std::vector<double> value, error;

  Margin excess(std::size_t i, std::size_t j, double k) const {
    const double turns = 0.5 * (value[i] + value[j]);
    return {turns - k, 0.5 * (error[i] + error[j]) + 2.0 * kUnit * turns};
  }
};

/// Bounds of the errors of the eigenvalues w^2 of K x = w^2 M x, p(n) u |M^-1| (|K| + w^2 |M|) (LAPACK Users'
/// Guide, generalized symmetric definite eigenproblem), with p(n) = 4 n^2.
Eigen::VectorXd errors_of(const Eigen::VectorXd& squares, const Eigen::MatrixXd& stiffness,
                          const Eigen::MatrixXd& mass) {
  const auto n = static_cast<double>(mass.rows());
  const double inverse = mass.inverse().norm(), units = 4.0 * n * n * kUnit * inverse;
  return (units * (stiffness.norm() + squares.array() * mass.norm())).matrix();
}

class RestingLine {
 public:
  RestingLine(const Scene& scene, const std::string& path)
      : scene_(scene), value_(&parameter(scene_, path)) {}
  RestingLine(const RestingLine&) = delete;

  /// Ascending; nothing where there is an equation of another kind.
  std::optional<ModeTurns> half_turns(double p) {
    *value_ = p;
    const LinearModel model = linear_model(scene_);
    const auto* system = std::get_if<LinearPeriodicSystem>(&model);
    if (system == nullptr || !is_at_rest(*system)) return std::nullopt;
    const Eigen::GeneralizedSelfAdjointEigenSolver<Eigen::MatrixXd> modes(
        system->stiffness.mean, system->mass, Eigen::EigenvaluesOnly);
    if (modes.info() != Eigen::Success || !(modes.eigenvalues().minCoeff() > 0.0)) return std::nullopt;
    const auto errors = errors_of(modes.eigenvalues(), system->stiffness.mean, system->mass);
    ModeTurns result;
    for (Eigen::Index i = 0; i < errors.size(); ++i) {
      const double square = modes.eigenvalues()[i], turns = system->period * std::sqrt(square) / pi;
      result.value.push_back(turns);
      result.error.push_back(turns * (errors[i] / square + 4.0 * kUnit));
    }
    return result;
  }

 private:
  Scene scene_;
  double* value_;
};

/// Two modes and the number of half turns that both make at their resonance.
struct ResonantPair {
  std::size_t i, j;
  double k;
};

std::optional<ResonantPair> resonant_pair(const ModeTurns& turns, std::size_t i, std::size_t j,
                                          Mechanism mechanism) {
  if ((i != j) != (mechanism == Mechanism::complex_pair)) return std::nullopt;
  const double k = std::round(turns.excess(i, j, 0.0).value);
  const bool odd = std::fmod(k, 2.0) != 0.0;
  if (k < 1.0 || (i == j && odd != (mechanism == Mechanism::minus_one))) return std::nullopt;
  return ResonantPair{i, j, k};
}

std::optional<CertainZero> resonance_of(RestingLine& line, const ResonantPair& pair, double from, double to) {
  const auto unknown =
      line.half_turns(from)->excess(pair.i, pair.j, pair.k).value;  // on neither side for certain
  const auto excess = [&](double p) {
    const auto turns = line.half_turns(p);
    return turns ? turns->excess(pair.i, pair.j, pair.k) : Margin{unknown, kInfinity};
  };
  return certain_zero(excess, from, to);
}

}  // namespace

std::optional<CertainZero> resting_resonance(const Scene& rest, const TongueLine& along, Mechanism mechanism,
                                             double near, double within) {
  RestingLine line(rest, along.parameter);
  const double from = std::max(along.from, near - within), to = std::min(along.to, near + within);
  const auto middle = line.half_turns(near);
  if (!middle || !line.half_turns(from) || !line.half_turns(to)) return std::nullopt;
  std::optional<CertainZero> best;
  for (std::size_t i = 0; i < middle->value.size(); ++i)
    for (std::size_t j = 0; j <= i; ++j) {
      const auto pair = resonant_pair(*middle, i, j, mechanism);
      const auto found = pair ? resonance_of(line, *pair, from, to) : std::nullopt;
      if (found && (!best || std::abs(found->position - near) < std::abs(best->position - near)))
        best = found;
    }
  return best;
}

}  // namespace strutt
