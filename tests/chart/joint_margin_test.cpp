// The joint row of stability_margin() where the surface has several nearest points.
#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <numeric>
#include <random>

#include "strutt/base/error.hpp"
#include "strutt/chart/stability_margin.hpp"
#include "strutt/floquet/stability.hpp"
#include "support/scenes.hpp"

namespace strutt::test::joint_margin_test {
namespace {

Scene with(Scene scene, const std::vector<std::pair<std::string, double>>& values) {
  for (const auto& [path, value] : values) parameter(scene, path) = value;
  return scene;
}

Scene hill(double period, double mean, double cosine, double sine, double damping) {
  Scene scene;
  scene.hill = HillTable{
      .period = period, .mean = mean, .harmonics = {{1, cosine, 0.0}, {2, 0.0, sine}}, .damping = damping};
  return scene;
}

Scene square_wave(double period, double mean, double amplitude, double damping) {
  Scene scene;
  scene.hill = HillTable{.waveform = Waveform::square,
                         .period = period,
                         .mean = mean,
                         .amplitude = amplitude,
                         .damping = damping};
  return scene;
}

/// The margin at relative changes of the parameters, positive on the side of the design.
class Around {
 public:
  Around(const Scene& scene, const StabilityMargin& margin)
      : scene_(scene),
        paths_(margin.joint.parameters),
        sign_(margin.verdict == Verdict::stable ? 1.0 : -1.0) {
    for (const auto& path : paths_) values_.push_back(parameter(scene_, path));
  }

  std::size_t size() const { return paths_.size(); }

  double operator()(const std::vector<double>& direction, double distance) {
    for (std::size_t i = 0; i < paths_.size(); ++i)
      parameter(scene_, paths_[i]) = values_[i] * (1.0 + distance * direction[i]);
    try {
      return sign_ * analyse(engine_, linear_model(scene_), {.tolerance = 1e-12}, {.winding = false}).margin;
    } catch (const InvalidInput&) {
      return HUGE_VAL;
    }
  }

 private:
  MonodromyEngine engine_;
  Scene scene_;
  std::vector<std::string> paths_;
  std::vector<double> values_;
  double sign_;
};

std::vector<double> unit(std::vector<double> v) {
  const double length = std::sqrt(std::inner_product(v.begin(), v.end(), v.begin(), 0.0));
  for (double& x : v) x /= length;
  return v;
}

/// The least margin at a distance: the best of random directions, changed at random by less and less.
double least_margin(Around& margin, double distance, std::mt19937_64& random) {
  std::normal_distribution<double> normal;
  const auto changed = [&](std::vector<double> direction, double step) {
    for (double& x : direction) x += step * normal(random);
    return unit(direction);
  };
  struct Member {
    double value;
    std::vector<double> direction;
  };
  std::vector<Member> members;
  for (int k = 0; k < 1000; ++k) {
    const auto direction = changed(std::vector<double>(margin.size(), 0.0), 1.0);
    members.push_back({margin(direction, distance), direction});
  }
  std::ranges::sort(members, {}, &Member::value);
  members.resize(40);
  for (Member& member : members) {
    double step = 0.3;
    for (int turn = 0; turn < 250; ++turn) {
      const auto next = changed(member.direction, step);
      const double value = margin(next, distance);
      step *= value < member.value ? 1.5 : 0.9;
      if (value < member.value) member = {value, next};
    }
  }
  return std::ranges::min(members, {}, &Member::value).value;
}

}  // namespace

TEST_CASE("no random search finds an edge nearer than the joint margin, which is one",
          "[chart][margin][slow]") {
  const std::vector<Scene> designs{
      mathieu_scene(1.842, 1.241, 0.6),
      mathieu_scene(3.589, 1.151, 1.0),
      mathieu_scene(4.560, 1.417, 0.6),
      mathieu_scene(3.032, 0.196, 0.02),
      hill(3.833, 1.252, 1.181, 0.065, 1.0),
      hill(4.393, 3.614, 0.823, -0.590, 0.3),
      hill(3.974, 0.717, 1.250, -0.812, 0.1),  // unstable
      square_wave(6.28, 1.7, 0.5, 0.3),
      square_wave(4.783, 1.099, 0.687, 0.02),
      square_wave(2.507, 2.136, 0.136, 1.0),
      with(rod(Equilibrium::hanging, 0.026, 10.858), {{"pendulum.length", 0.507}}),  // unstable, no damping
      with(rod(Equilibrium::hanging, 0.026, 4.226, 0.6), {{"pendulum.length", 1.226}}),
      with(rod(Equilibrium::hanging, 0.036, 8.166, 1.0), {{"pendulum.length", 0.917}}),
      with(rod(Equilibrium::inverted, 0.173, 90.611, 1.0), {{"pendulum.length", 1.684}}),
  };
  std::mt19937_64 random(5);
  for (const Scene& scene : designs) {
    const auto found = stability_margin(scene, stability_parameters(scene));
    const JointMargin& joint = found.joint;
    CAPTURE(describe(scene), joint.distance, joint.error);
    CHECK(joint.outcome == Outcome::converged);
    Around margin(scene, found);
    Scene design = scene;
    std::vector<double> direction;
    for (std::size_t i = 0; i < joint.edge.size(); ++i)
      direction.push_back(joint.edge[i] / parameter(design, joint.parameters[i]) - 1.0);
    direction = unit(direction);
    const double r = std::abs(joint.distance);
    CHECK(margin(direction, r * (1.0 - 1e-8)) > 0.0);
    CHECK(margin(direction, r * (1.0 + 1e-8)) < 0.0);
    CHECK(least_margin(margin, 0.99 * r, random) > 0.0);
    CHECK(least_margin(margin, 1.001 * r, random) < 0.0);  // so does the search find what there is
  }
}

TEST_CASE("no edge found means nothing where a single parameter is beyond the known tongues",
          "[chart][margin]") {
  const auto found = stability_margin(rod(Equilibrium::hanging, 0.05, 0.05), {"support.frequency"});
  CHECK(std::isnan(found.parameters.front().distance));
  CHECK(std::isnan(found.joint.distance));
  CHECK(found.joint.outcome == Outcome::tolerance_not_reached);
}

}  // namespace strutt::test::joint_margin_test
