#include "strutt/model/scene.hpp"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>

#include "strutt/base/error.hpp"
#include "support/ratchet.hpp"
#include "support/scenes.hpp"

namespace strutt::test::scene_test {

using test::mathieu_scene;
using test::rod_scene;

namespace {

Scene hill_scene(Waveform waveform) {
  Scene scene;
  scene.hill = HillTable{.waveform = waveform, .period = 2.0, .mean = 1.1, .amplitude = 0.4, .damping = 0.05};
  if (waveform == Waveform::harmonics) scene.hill->harmonics = {{1, 0.3, 0.1}, {4, 0.0, 0.2}};
  return scene;
}

Scene linear_scene() {
  Scene scene;
  scene.linear.emplace();
  scene.linear->mass = Eigen::MatrixXd{{1.0, 0.1}, {0.1, 2.0}};
  scene.linear->stiffness = {Eigen::MatrixXd{{1.0, 0.2}, {0.2, 3.0}},
                             {{2, Eigen::MatrixXd{{0.5, 0.0}, {0.6, 0.7}}, {}}}};
  scene.linear->damping.mean = Eigen::MatrixXd{{0.01, 0.0}, {0.02, 0.03}};
  return scene;
}

std::vector<Scene> every_kind() {
  auto body = rod_scene(), squares = rod_scene(), samples = rod_scene(), harmonics = rod_scene(),
       pushed = rod_scene();
  body.pendulum = PendulumTable{.shape = PendulumTable::Shape::body, .inertia = 0.4, .centroid = 0.5};
  squares.support->waveform = Waveform::square;
  samples.support->waveform = Waveform::samples;
  samples.support->samples = {0.0, 0.05, -0.05};
  harmonics.support->waveform = Waveform::harmonics;
  harmonics.support->harmonics = {{1, 0.0, 0.05}, {3, 0.01, 0.0}};
  pushed.moment = MomentTable{0.1, {{2, 0.3, 0.0}}, 12.0};
  Scene free;
  free.pendulum = PendulumTable{.shape = PendulumTable::Shape::point_mass, .length = 2.0};
  return {rod_scene(),
          body,
          squares,
          samples,
          harmonics,
          pushed,
          free,
          mathieu_scene(1.0, 0.5, 0.1),
          mathieu_scene(4.0, -1.0, 0.1, true),
          hill_scene(Waveform::harmonics),
          hill_scene(Waveform::square),
          linear_scene()};
}

/// The message of the InvalidInput that `call` throws; empty if it throws none.
template <typename Call>
std::string refusal(Call call) {
  try {
    call();
  } catch (const InvalidInput& error) {
    return error.what();
  }
  return "";
}

template <typename Change>
std::string refused(Scene scene, Change change) {
  validate(scene);
  change(scene);
  return refusal([&] { validate(scene); });
}

}  // namespace

TEST_CASE("Every parameter is written and read by its path", "[model][scene][parameter]") {
  for (auto scene : every_kind()) {
    const auto paths = parameter_paths(scene);
    INFO(describe(scene));
    CHECK(paths.size() >= 3);
    double value = 1000.0;
    for (const auto& path : paths) parameter(scene, path) = value++;
    value = 1000.0;  // nothing was overwritten: each path is another number
    for (const auto& path : paths) {
      CHECK(parameter(std::as_const(scene), path) == value++);
      CHECK(parameter_info(scene, path).path == path);
      auto label = path;
      std::replace(label.begin(), label.end(), '.', ' ');
      CHECK(parameter_info(scene, path).label == label);
    }
    CHECK(parameter_paths(scene) == paths);
  }
}

TEST_CASE("Paths name the fields they say, with their units", "[model][scene][parameter]") {
  auto scene = rod_scene();
  scene.moment = MomentTable{0.1, {{2, 0.3, 0.4}}, {}};
  parameter(scene, "support.frequency") = 5.0;
  CHECK(scene.support->frequency == 5.0);
  CHECK(parameter(scene, "moment.harmonics.2.sin") == 0.4);
  CHECK(parameter(scene, "moment.harmonics.2.cos") == 0.3);
  CHECK(parameter_info(scene, "moment.constant").unit == "N m");
  CHECK(parameter_info(scene, "support.amplitude").unit == "m");
  CHECK(parameter_info(scene, "support.phase").unit == "rad");
  CHECK(parameter_info(scene, "support.frequency").unit == "rad/s");
  CHECK(parameter_info(scene, "pendulum.mass").unit == "kg");
  CHECK(parameter_info(scene, "pendulum.gravity").unit == "m/s^2");
  CHECK(parameter_info(scene, "pendulum.damping").unit == "1/s");
  CHECK(parameter_info(every_kind()[1], "pendulum.inertia").unit == "kg m^2");

  auto linear = linear_scene();
  CHECK(parameter(linear, "linear.stiffness.harmonics.2.cos.1.0") == 0.6);
  parameter(linear, "linear.mass.1.1") = 7.0;
  CHECK(linear.linear->mass(1, 1) == 7.0);
  CHECK(parameter(linear, "linear.damping.mean.1.0") == 0.02);
  CHECK(parameter_paths(linear).front() == "linear.period");
  CHECK(parameter(hill_scene(Waveform::harmonics), "hill.harmonics.4.sin") == 0.2);
}

TEST_CASE("Parameters of absent parts do not exist, and the nearest one is named",
          "[model][scene][parameter][error]") {
  const auto message = [](const Scene& scene, const char* path) {
    return refusal([&] { parameter(scene, path); });
  };
  CHECK(message(rod_scene(), "support.freqency") ==
        "unknown parameter 'support.freqency' for this scene; did you mean 'support.frequency'?");
  CHECK(message(rod_scene(), "pendulum.inertia") != "");
  CHECK(message(rod_scene(), "moment.constant") != "");
  CHECK(message(mathieu_scene(1, 1), "mathieu.a") != "");
  CHECK(message(mathieu_scene(1, 1, 0, true), "mathieu.delta") != "");
  CHECK(message(hill_scene(Waveform::square), "hill.harmonics.1.cos") != "");
  CHECK(message(hill_scene(Waveform::harmonics), "hill.amplitude") != "");
  CHECK(message(hill_scene(Waveform::harmonics), "hill.harmonics.2.cos") ==
        "unknown parameter 'hill.harmonics.2.cos' for this scene; did you mean 'hill.harmonics.1.cos'?");
  CHECK(message(linear_scene(), "linear.mass.2.0") != "");
  for (const std::string strange : {"x", ""}) {
    CHECK(message(rod_scene(), strange.c_str())
              .starts_with("unknown parameter '" + strange +
                           "' for this scene; known are 'pendulum.mass', 'pendulum.length'"));
  }
}

TEST_CASE("validate names the parameter that is out of range", "[model][scene][error][extreme][N38]") {
  for (const double bad : {0.0, -1.0, std::nan(""), HUGE_VAL}) {
    const std::string start = " = " + to_text(bad) + " is not allowed: it must be ";
    for (const char* path : {"pendulum.mass", "pendulum.length", "pendulum.gravity", "support.frequency"}) {
      CHECK_THAT(refused(rod_scene(), [&](Scene& s) { parameter(s, path) = bad; }),
                 Catch::StartsWith(path + start));
    }
    for (const char* path : {"pendulum.inertia", "pendulum.centroid"}) {
      CHECK_THAT(refused(every_kind()[1], [&](Scene& s) { parameter(s, path) = bad; }),
                 Catch::StartsWith(path + start));
    }
    CHECK_THAT(refused(hill_scene(Waveform::square), [&](Scene& s) { s.hill->period = bad; }),
               Catch::StartsWith("hill.period" + start));
    CHECK_THAT(refused(linear_scene(), [&](Scene& s) { s.linear->period = bad; }),
               Catch::StartsWith("linear.period" + start));
    CHECK_THAT(refused(every_kind()[5], [&](Scene& s) { s.moment->frequency = bad; }),
               Catch::StartsWith("moment.frequency" + start));
  }
  CHECK(refused(rod_scene(), [](Scene& s) { s.pendulum->damping = -1.0; }) ==
        "pendulum.damping = -1 is not allowed: it must be a finite number >= 0");
  CHECK(refused(mathieu_scene(1, 1), [](Scene& s) { s.mathieu->damping = -1.0; }) ==
        "mathieu.damping = -1 is not allowed: it must be a finite number >= 0");
  CHECK(refused(hill_scene(Waveform::square), [](Scene& s) { s.hill->damping = -1.0; }) ==
        "hill.damping = -1 is not allowed: it must be a finite number >= 0");
  CHECK(refused(linear_scene(), [](Scene& s) { s.linear->damping.mean *= -1.0; }) ==
        "");  // [linear] takes any
}

TEST_CASE("validate finds what is not finite anywhere, lists included",
          "[model][scene][error][extreme][N36]") {
  for (const auto& scene : every_kind()) {
    for (const auto& path : parameter_paths(scene)) {
      CHECK_THAT(refused(scene, [&](Scene& s) { parameter(s, path) = std::nan(""); }),
                 Catch::StartsWith(path + " = nan"));
    }
  }
  CHECK(refused(every_kind()[3], [](Scene& s) { s.support->samples[1] = HUGE_VAL; }) ==
        "support.samples = inf is not allowed: it must be finite in every value");
  CHECK(refused(every_kind()[3], [](Scene& s) { s.support->samples.clear(); }) ==
        "number of values in support.samples = 0 is not allowed: it must be at least 1");
}

TEST_CASE("validate checks the combination of tables", "[model][scene][error]") {
  CHECK_THAT(refusal([] { validate(Scene{}); }), Catch::StartsWith("number of models in the scene = 0"));
  CHECK_THAT(refused(rod_scene(), [](Scene& s) { s.mathieu.emplace(); }),
             Catch::StartsWith("number of models in the scene = 2"));
  CHECK(refused(mathieu_scene(1, 1), [](Scene& s) { s.support = rod_scene().support; }) ==
        "[support] and [moment] go with [pendulum] only");
  CHECK(refused(mathieu_scene(1, 1), [](Scene& s) { s.moment.emplace(); }) ==
        "[support] and [moment] go with [pendulum] only");
  CHECK(refused(every_kind()[5], [](Scene& s) { s.moment->frequency = 13.0; }) ==
        "moment.frequency = 13 is not allowed: it must be that of the support");
  CHECK_THAT(refused(every_kind()[6],
                     [](Scene& s) {
                       s.moment = MomentTable{0.0, {{1, 1.0, 0.0}}, {}};
                     }),
             Catch::StartsWith("moment.frequency is required"));
  CHECK(refused(every_kind()[6], [](Scene& s) { s.moment = MomentTable{0.2, {}, {}}; }) == "");
  CHECK_THAT(refused(every_kind()[1], [](Scene& s) { s.pendulum->inertia = 0.24; }),
             Catch::StartsWith(
                 "pendulum.inertia = 0.24 is not allowed: it must be at least mass * centroid^2 = 0.25"));
  for (const auto& [kind, path] :
       {std::pair{4, "support.harmonics"}, {5, "moment.harmonics"}, {9, "hill.harmonics"}}) {
    const auto list = [&path = path](Scene& s) -> std::vector<Harmonic>& {
      return std::string(path).starts_with("hill")     ? s.hill->harmonics
             : std::string(path).starts_with("moment") ? s.moment->harmonics
                                                       : s.support->harmonics;
    };
    const auto scene = every_kind()[static_cast<std::size_t>(kind)];
    CHECK(refused(scene, [&](Scene& s) { list(s)[0].order = 0; }) ==
          "order in " + std::string(path) + " = 0 is not allowed: it must be an integer >= 1");
    CHECK(refused(scene, [&](Scene& s) { list(s).push_back(list(s)[0]); }) ==
          "order in " + std::string(path) + " = " + std::to_string(list(const_cast<Scene&>(scene))[0].order) +
              " is not allowed: it must be given only once");
  }
}

TEST_CASE("A scene gives the body, support and moment it describes", "[model][scene][ratchet]") {
  auto scene = rod_scene();
  scene.moment = MomentTable{0.1, {{2, 0.3, 0.4}}, {}};
  CHECK(pendulum(scene).inertia == PhysicalPendulum::uniform_rod(1.2, 0.8).inertia);
  CHECK(pendulum(scene).damping == 0.25);
  check_close("support and moment of a scene (relative)", support(scene)->value(0.1), 0.06 * std::cos(1.2),
              1.5e-15);
  CHECK(moment(scene)->frequency == 12.0);
  check_close("support and moment of a scene (relative)", moment(scene)->value(0.05),
              0.1 + 0.3 * std::cos(1.2) + 0.4 * std::sin(1.2), 1.5e-15);
  CHECK(support(every_kind()[2])->function.derivative().derivative().is_piecewise_constant());
  check_close("support and moment of a scene (relative)",
              support(every_kind()[3])->value(2.0 * std::numbers::pi / 36.0), 0.05, 1.5e-15);
  check_close("alpha^2 of a scene (relative)", pendulum(every_kind()[1]).alpha_squared(), 9.81 * 0.5 / 0.4,
              8e-16);
  check_close("alpha^2 of a scene (relative)", pendulum(every_kind()[6]).alpha_squared(), 9.81 / 2.0, 8e-16);
  CHECK_FALSE(support(every_kind()[6]));
  CHECK_FALSE(moment(every_kind()[6]));
  CHECK(refusal([] { pendulum(mathieu_scene(1, 1)); }) == "the scene has no [pendulum]");
}

TEST_CASE("Each kind of scene gives the linear equation it describes", "[model][scene][ratchet]") {
  const auto hill = [](const Scene& scene) { return std::get<HillEquation>(linear_model(scene)); };
  CHECK(hill(mathieu_scene(1.5, -0.4, 0.1)).delta() == 1.5);
  CHECK(hill(mathieu_scene(1.5, -0.4, 0.1)).coefficient(0.0) == 1.1);
  CHECK(hill(mathieu_scene(4.0, -1.0, 0.1, true)).coefficient(0.0) == 1.5);
  CHECK(hill(hill_scene(Waveform::square)).coefficient.is_piecewise_constant());
  check_close("coefficient of a scene with a square wave (relative)",
              hill(hill_scene(Waveform::square)).coefficient(0.0),
              1.5 / (std::numbers::pi * std::numbers::pi), 8e-16);
  CHECK(hill(hill_scene(Waveform::harmonics)).coefficient.harmonics().size() == 2);
  CHECK(hill(every_kind()[6]).delta() == 1.0);
  CHECK(hill(rod_scene(Equilibrium::inverted)).delta() == -hill(rod_scene()).delta());
  CHECK(std::get<LinearPeriodicSystem>(linear_model(linear_scene())).states() == 4);
}

TEST_CASE("describe names the model in words", "[model][scene]") {
  std::vector<std::string> texts;
  for (const auto& scene : every_kind()) texts.push_back(describe(scene));
  CHECK(texts == std::vector<std::string>{
                     "pendulum, hanging, sinusoidal support", "pendulum, hanging, sinusoidal support",
                     "pendulum, hanging, support with square acceleration",
                     "pendulum, hanging, sampled support", "pendulum, hanging, support with harmonics",
                     "pendulum, hanging, sinusoidal support", "pendulum, hanging, fixed support",
                     "Mathieu's equation (delta, epsilon)", "Mathieu's equation (a, q)", "Hill's equation",
                     "Meissner's equation", "linear periodic system, 4 states"});
  CHECK(describe(rod_scene(Equilibrium::inverted)) == "pendulum, inverted, sinusoidal support");
}

}  // namespace strutt::test::scene_test
