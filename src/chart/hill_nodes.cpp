#include "chart/hill_nodes.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <numbers>
#include <set>
#include <utility>

namespace strutt {
namespace {

using std::numbers::pi;

constexpr double kUnit = 0x1p-53;
constexpr std::size_t kLanes = 512;  // of a job
constexpr std::size_t kMostFamilies = 16;

using Points = std::vector<std::optional<PointEquation>>;

/// The functions of the phase that occur: k for cos(k theta), -k for sin(k theta).
std::vector<int> basis_of(const Points& points) {
  std::set<int> names;
  for (const auto& point : points) {
    if (!point) continue;
    for (const auto& h : point->equation.coefficient.harmonics()) {
      if (h.cosine != 0.0) names.insert(h.order);
      if (h.sine != 0.0) names.insert(-h.order);
    }
  }
  return {names.begin(), names.end()};
}

/// Means and weights of some lanes.
struct Lanes {
  std::vector<double> mean;
  std::vector<std::vector<double>> weights;

  Lanes(const Points& points, std::span<const std::size_t> members, const std::vector<int>& basis)
      : weights(basis.size(), std::vector<double>(members.size(), 0.0)) {
    for (std::size_t l = 0; l < members.size(); ++l) {
      const auto& w = points[members[l]]->equation.coefficient;
      mean.push_back(w.mean());
      for (const auto& h : w.harmonics()) {
        for (const auto& [name, weight] : {std::pair{h.order, h.cosine}, std::pair{-h.order, h.sine}}) {
          const auto place = std::lower_bound(basis.begin(), basis.end(), name);
          if (weight != 0.0) weights[static_cast<std::size_t>(place - basis.begin())][l] = weight;
        }
      }
    }
  }

  HillBatch batch() const {
    HillBatch result{mean, {}};
    for (const auto& w : weights) result.weights.emplace_back(w);
    return result;
  }
};

/// One lane of a group.
PropagatorSample sample_of(const PointEquation& point, const HillGroup& group, std::size_t l, double length) {
  PropagatorSample result;
  const auto& r = group.result;
  const double kappa = point.kappa;
  result.exponent = r.exponent[l];
  result.half_damping = point.half_damping;
  result.kappa = kappa;
  result.shifted = point.shifted;
  result.right_hand_sides = static_cast<long>(group.plan.steps) * group.plan.terms;
  const Eigen::Matrix2d value{{r.u1[l], kappa * r.u2[l]}, {r.du1[l] / kappa, r.du2[l]}};
  Eigen::Matrix2d error{{r.u1_error[l], kappa * r.u2_error[l]}, {r.du1_error[l] / kappa, r.du2_error[l]}};
  const double size = value.cwiseAbs().maxCoeff();
  const auto& w = point.equation.coefficient;
  const double evaluation = HillSeries::evaluation_error(w.highest_order());
  const double coefficients = (evaluation + point.equation.coefficient_error) * length * std::sqrt(w.bound());
  error.array() += size * (kUnit + coefficients);
  const auto canonical = at_kappa(value, error, 1.0 / kappa);
  result.value = canonical.value;
  result.error = canonical.error;
  result.valid = error.allFinite() && std::isfinite(size);
  return result;
}

}  // namespace

HillNodes::HillNodes(const Scene& scene, const Axis& x, const Axis& y,
                     const std::optional<double>& even_phase, const ParallelOptions& parallel)
    : parallel_(parallel),
      model_(scene, x, y, even_phase),
      length_(even_phase ? pi : 2.0 * pi),
      families_(static_cast<std::size_t>(thread_count(parallel))) {}

HillFamily& HillNodes::family(std::size_t slot, double tolerance, const std::vector<int>& harmonics) {
  auto& own = families_[slot];
  const std::pair key{tolerance, harmonics};
  const auto found = own.find(key);
  if (found != own.end()) return found->second;
  if (own.size() >= kMostFamilies) own.clear();
  std::vector<PeriodicFunction> basis;
  for (const int name : harmonics) {
    basis.push_back(
        PeriodicFunction::fourier(0.0, {{std::abs(name), name > 0 ? 1.0 : 0.0, name > 0 ? 0.0 : 1.0}}));
  }
  return own.try_emplace(key, std::move(basis), 0.0, length_, tolerance).first->second;
}

bool HillNodes::sample(const std::vector<std::array<double, 2>>& values, double tolerance,
                       std::vector<PropagatorSample>& result) {
  result.assign(values.size(), {});
  Points points;
  std::vector<std::size_t> valid;
  for (const auto& value : values) {
    points.push_back(model_.at(value[0], value[1]));
    if (points.back()) valid.push_back(points.size() - 1);
  }
  const auto basis = basis_of(points);
  const std::size_t jobs = (valid.size() + kLanes - 1) / kLanes;
  const bool complete = parallel_for(jobs, parallel_, [&](std::size_t job, int slot) {
    const std::size_t first = job * kLanes;
    const auto members = std::span(valid).subspan(first, std::min(kLanes, valid.size() - first));
    const Lanes lanes(points, members, basis);
    family(static_cast<std::size_t>(slot), tolerance, basis)
        .propagate(lanes.batch(), [&](const HillGroup& group) {
          if (group.plan.steps == 0) return;
          for (std::size_t l = 0; l < group.lanes.size(); ++l) {
            const std::size_t member = members[group.lanes[l]];
            result[member] = sample_of(*points[member], group, l, length_);
          }
        });
  });
  return complete && !(parallel_.cancel != nullptr && parallel_.cancel->load());
}

}  // namespace strutt
