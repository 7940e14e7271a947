// The judge of `strutt tradeoff`, judged by the tables that two other programs made (tests/reference).
#include "chart/reference_monodromy.hpp"

#include <boost/math/constants/constants.hpp>
#include <catch2/catch.hpp>
#include <cmath>

#include "support/ratchet.hpp"
#include "support/reference.hpp"

namespace strutt::test::reference_monodromy_test {

namespace {

using judge::Real;

constexpr std::size_t kRows = 12;  // of each table, spread over it

Real pi() { return boost::math::constants::pi<Real>(); }

/// The scene of a row of mathieu, hill, square or pendulum.
Scene scene_of(const std::string& table, const reference::Row& r) {
  Scene scene;
  if (table == "mathieu") {
    scene.mathieu = MathieuTable{false, r.input("delta"), r.input("epsilon"), r.input("damping")};
  } else if (table == "hill") {
    scene.hill =
        HillTable{.period = r.input("period"), .mean = r.input("mean"), .damping = r.input("damping")};
    for (int k = 1; k <= 3; ++k) {
      const std::string order = std::to_string(k);
      scene.hill->harmonics.push_back({k, r.input("cos" + order), r.input("sin" + order)});
    }
  } else if (table == "square") {
    scene.hill = HillTable{.waveform = Waveform::square,
                           .period = r.input("period"),
                           .mean = r.input("mean"),
                           .amplitude = r.input("amplitude"),
                           .damping = r.input("damping")};
  } else {
    scene.pendulum =
        PendulumTable{.length = r.input("length"),
                      .gravity = r.input("gravity"),
                      .damping = r.input("damping"),
                      .about = r.text("about") == "hanging" ? Equilibrium::hanging : Equilibrium::inverted};
    scene.support = SupportTable{
        .amplitude = r.input("amplitude"), .frequency = r.input("frequency"), .phase = r.input("phase")};
  }
  return scene;
}

/// The largest difference of entries, x' scaled by kappa, relative to the largest entry.
Real difference(const judge::Monodromy& found, const reference::Row& row) {
  const int n = found.matrix.rows, d = n / 2;
  Real largest = 0, error = 0;
  for (int i = 0; i < n; ++i) {
    for (int j = 0; j < n; ++j) {
      const Real unit = (i < d) == (j < d) ? Real(1) : i < d ? found.kappa : Real(1 / found.kappa);
      const Real truth = unit * Real(row.text("m" + std::to_string(i + 1) + std::to_string(j + 1)));
      const Real distance = abs(found.matrix(i, j) - truth);
      if (distance > error) error = distance;
      if (abs(truth) > largest) largest = abs(truth);
    }
  }
  return error / largest;
}

judge::Monodromy monodromy_of(const judge::Equation& equation) {
  auto found = judge::monodromy(equation);
  REQUIRE(found.has_value());
  return *std::move(found);
}

judge::Monodromy monodromy_of(const Scene& scene) { return monodromy_of(judge::equation_of(scene)); }

}  // namespace

TEST_CASE("The judge agrees with the reference tables to the digits they have",
          "[chart][tradeoff][reference]") {
  for (const std::string table : {"mathieu", "hill", "square", "pendulum"}) {
    const auto rows = reference::read(table);
    const std::size_t stride = rows.size() / kRows + 1;
    for (std::size_t i = 0; i < rows.size(); i += stride) {
      INFO(table << " row " << i);
      CHECK(difference(monodromy_of(scene_of(table, rows[i])), rows[i]) < 1e-35);
    }
  }
}

TEST_CASE("The judge agrees with the reference tables of two degrees of freedom",
          "[chart][tradeoff][reference]") {
  for (const auto& row : reference::read("linear4")) {
    const auto model = reference::model("linear4", row);
    Scene scene;
    scene.linear = std::get<LinearPeriodicSystem>(model);
    auto equation = judge::equation_of(scene);
    // The tables have the period 2 pi itself, a scene the double next to it.
    const Real unit = Real(scene.linear->period) / (2 * pi());
    equation.angular_frequency = equation.kappa = 1;
    for (auto* terms : {&equation.pieces.front().damping, &equation.pieces.front().stiffness}) {
      const bool damping = terms == &equation.pieces.front().damping;
      for (auto& term : *terms) {
        for (auto* part : {&term.cosine, &term.sine}) {
          for (Real& x : part->entries) x /= damping ? unit : Real(unit * unit);
        }
      }
    }
    CHECK(difference(monodromy_of(equation), row) < 1e-35);
  }
}

TEST_CASE("The judge knows the closed forms", "[chart][tradeoff]") {
  SECTION("x'' + c x' + w x = 0") {
    Scene scene;
    scene.hill = HillTable{.period = 3.0, .mean = 2.5, .damping = 0.75};
    const auto found = monodromy_of(scene);
    const Real c = 0.75, omega = sqrt(Real(2.5) - c * c / 4), t = 3;
    const Real decay = exp(-c * t / 2);
    CHECK(abs(found.matrix(0, 0) - decay * (cos(omega * t) + c / (2 * omega) * sin(omega * t))) < 1e-40);
    CHECK(abs(found.matrix(0, 1) / found.kappa - decay * sin(omega * t) / omega) < 1e-40);
    CHECK(abs(found.kappa - 2 * pi() / 3) < 1e-40);  // above sqrt(2.5)
  }
  SECTION("the free pendulum comes back after its period") {
    Scene scene;
    scene.pendulum = PendulumTable{.length = 0.7};
    const auto found = monodromy_of(scene);
    for (int i = 0; i < 2; ++i) {
      for (int j = 0; j < 2; ++j) CHECK(abs(found.matrix(i, j) - (i == j ? 1 : 0)) < 1e-40);
    }
    CHECK(abs(found.kappa * found.kappa - Real(3) * 9.81 / (2 * Real(0.7))) < 1e-40);
  }
  SECTION("Liouville: det M is exp of the integrated trace, with a mass matrix and general damping") {
    Scene scene;
    LinearPeriodicSystem system;
    system.period = 2.0;
    system.mass = Eigen::MatrixXd{{2.0, 0.5}, {0.25, 1.0}};
    system.stiffness = {Eigen::MatrixXd{{3.0, -1.0}, {0.5, 2.0}},
                        {{2, Eigen::MatrixXd{{1.0, 0.0}, {0.5, 0.0}}, {}}}};
    system.damping = {Eigen::MatrixXd{{0.5, 0.25}, {0.0, 1.0}},
                      {{1, {}, Eigen::MatrixXd{{0.0, 1.0}, {2.0, 0.5}}}}};
    scene.linear = system;
    const auto m = monodromy_of(scene).matrix;
    const auto minor = [&](int a, int b, int i, int j) { return m(a, i) * m(b, j) - m(a, j) * m(b, i); };
    const Real determinant = minor(0, 1, 0, 1) * minor(2, 3, 2, 3) - minor(0, 1, 0, 2) * minor(2, 3, 1, 3) +
                             minor(0, 1, 0, 3) * minor(2, 3, 1, 2) + minor(0, 1, 1, 2) * minor(2, 3, 0, 3) -
                             minor(0, 1, 1, 3) * minor(2, 3, 0, 2) + minor(0, 1, 2, 3) * minor(2, 3, 0, 1);
    // trace of mass^-1 C over one period: [1, -0.5; -0.25, 2] C_mean/1.875, the harmonic has mean 0
    const Real trace = 2 * (Real(0.5) + (Real(-0.0625) + 2)) / Real(1.875);
    CHECK(abs(determinant / exp(-trace) - 1) < 1e-38);
  }
}

TEST_CASE("The judge takes every shape and waveform of a pendulum as docs/scene.md says",
          "[chart][tradeoff][ratchet]") {
  Scene rod;
  rod.pendulum = PendulumTable{.mass = 1.5, .length = 0.5, .damping = 0.125};
  rod.support = SupportTable{.amplitude = 0.0625, .frequency = 10.0};
  const auto same = [](const Scene& a, const Scene& b) {
    const auto first = monodromy_of(a), second = monodromy_of(b);
    Real most = 0;
    for (int e = 0; e < 4; ++e) {
      const Real distance = abs(first.matrix(e / 2, e % 2) - second.matrix(e / 2, e % 2));
      if (distance > most) most = distance;
    }
    return most;
  };
  SECTION("harmonics") {
    Scene other = rod;
    other.support =
        SupportTable{.waveform = Waveform::harmonics, .frequency = 10.0, .harmonics = {{1, 0.0, 0.0625}}};
    CHECK(same(rod, other) < 1e-40);
  }
  SECTION("samples of a sine are the sine, up to the rounding of the samples") {
    Scene other = rod;
    other.support = SupportTable{.waveform = Waveform::samples, .frequency = 10.0};
    for (int j = 0; j < 8; ++j)
      other.support->samples.push_back(0.25 + 0.0625 * std::sin(2.0 * 3.141592653589793 * j / 8.0));
    check_within("M from samples of a sine and from the sine", static_cast<double>(same(rod, other)), 6e-16);
    CHECK(same(rod, other) > 0);
  }
  SECTION("bodies") {
    Scene body = rod, point = rod;
    body.pendulum->shape = PendulumTable::Shape::body;
    body.pendulum->centroid = 0.25;
    body.pendulum->inertia = 0.125;  // m l^2/3
    CHECK(same(rod, body) < 1e-40);
    point.pendulum->shape = PendulumTable::Shape::point_mass;
    point.pendulum->length = 0.5 * 2.0 / 3.0;  // the same alpha, up to rounding
    check_within("M of a rod and of a point mass of the same frequency",
                 static_cast<double>(same(rod, point)), 6e-16);
  }
  SECTION("the square wave jumps where it should: a shift by a quarter is a change of phase") {
    Scene square = rod;
    square.support =
        SupportTable{.waveform = Waveform::square, .amplitude = 0.0625, .frequency = 10.0, .phase = 0.375};
    MonodromyEngine engine;
    const auto result = analyse(engine, linear_model(square), {.tolerance = 1e-12});
    CHECK(result.method == Method::exact);
    CHECK(judge::true_error(monodromy_of(square), result) <= result.error);
    check_within("bound of M of a square wave in closed form at tolerance 1e-12", result.error, 8e-14);
  }
  SECTION("Mathieu's two forms") {
    Scene one, two;
    one.mathieu = MathieuTable{false, 0.75, -0.5, 0.25};
    two.mathieu = MathieuTable{true, 3.0, 1.0, 0.5};
    CHECK(same(one, two) < 1e-40);
  }
}

TEST_CASE("The true error is the scaled one of the contract", "[chart][tradeoff][ratchet]") {
  Scene scene;
  scene.hill = HillTable{.period = 3.0, .mean = 100.0};  // kappa = 10
  const auto truth = monodromy_of(scene);
  MonodromyEngine engine;
  auto result = analyse(engine, linear_model(scene), {});
  check_within("true error of M of constant coefficients", judge::true_error(truth, result), 2.5e-15);
  result.matrix(0, 1) += 1e-5;
  check_close("true error of M with a known one added (relative)", judge::true_error(truth, result), 1e-4,
              2.5e-13);
  result.matrix(1, 0) += 1e-2;
  check_close("true error of M with a known one added (relative)", judge::true_error(truth, result), 1e-3,
              2.5e-13);
  result.discriminant += 0.5;
  check_close("true error of M with a known one added (relative)", judge::true_error(truth, result), 0.5,
              2.5e-13);
  result.matrix.resize(0, 0);
  CHECK(std::isinf(judge::true_error(truth, result)));

  scene.hill = HillTable{.period = 10.0, .mean = -1e4};  // grows by exp(1000)
  const auto growing = monodromy_of(scene);
  result = analyse(engine, linear_model(scene), {});
  CHECK(result.log_scale > 0.0);
  check_within("true error of M that grows by exp(1000)", judge::true_error(growing, result), 2.5e-13);
  result.log_scale += 1e-6;
  CHECK(judge::true_error(growing, result) == Approx(2e-6).epsilon(1e-3));  // of the trace, m11 + m22
}

TEST_CASE("The judge stops when it is told to", "[chart][tradeoff]") {
  Scene scene;
  scene.mathieu = MathieuTable{};
  const std::atomic<bool> cancel = true;
  CHECK_FALSE(judge::monodromy(judge::equation_of(scene), &cancel).has_value());
}

}  // namespace strutt::test::reference_monodromy_test
