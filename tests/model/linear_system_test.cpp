#include "strutt/model/linear_system.hpp"

#include <catch2/catch.hpp>
#include <cmath>

#include "strutt/base/error.hpp"
#include "support/ratchet.hpp"

namespace strutt::test::linear_system_test {

using Eigen::MatrixXd;

namespace {

const MatrixXd kMean{{2.0, -0.5}, {-0.5, 3.0}};
const MatrixXd kCosine{{0.1, 0.4}, {0.4, -0.2}};
const MatrixXd kSkew{{0.0, 0.3}, {-0.3, 0.0}};

LinearPeriodicSystem good() {
  LinearPeriodicSystem system;
  system.mass = MatrixXd{{2.0, 0.5}, {0.5, 1.0}};
  system.stiffness = {kMean, {{1, kCosine, {}}, {3, {}, kSkew}}};
  return system;
}

}  // namespace

TEST_CASE("A periodic matrix is the sum of its harmonics", "[model][linear_system][ratchet]") {
  const PeriodicMatrix k{kMean, {{1, kCosine, {}}, {3, {}, kSkew}, {2, kCosine, kSkew}}};
  MatrixXd value(2, 2);
  for (const double theta : {-1.0, 0.0, 0.7, 5.0}) {
    k.evaluate(theta, value);
    for (int i = 0; i < 2; ++i) {
      for (int j = 0; j < 2; ++j) {
        const double expected = kMean(i, j) + kCosine(i, j) * (std::cos(theta) + std::cos(2.0 * theta)) +
                                kSkew(i, j) * (std::sin(3.0 * theta) + std::sin(2.0 * theta));
        check_within("value of a periodic matrix", std::abs(value(i, j) - expected), 1e-15);
      }
    }
    CHECK(value.cwiseAbs().rowwise().sum().maxCoeff() <= k.bound());
  }
  check_close("bound of a periodic matrix (relative)", k.bound(), 3.5 + 2.0 * 0.6 + 2.0 * 0.3, 8e-16);
}

TEST_CASE("Properties of periodic matrices look at every matrix", "[model][linear_system]") {
  const MatrixXd zero = MatrixXd::Zero(2, 2);
  CHECK(PeriodicMatrix{kMean, {}}.is_constant());
  CHECK(PeriodicMatrix{kMean, {{1, zero, {}}, {2, {}, zero}}}.is_constant());
  CHECK_FALSE(PeriodicMatrix{kMean, {{1, zero, {}}, {2, {}, kSkew}}}.is_constant());
  CHECK_FALSE(PeriodicMatrix{kMean, {{1, kCosine, {}}}}.is_constant());

  CHECK(PeriodicMatrix{zero, {{1, zero, {}}}}.is_zero());
  CHECK(PeriodicMatrix{}.is_zero());
  CHECK_FALSE(PeriodicMatrix{kMean, {}}.is_zero());
  CHECK_FALSE(PeriodicMatrix{zero, {{1, {}, kSkew}}}.is_zero());

  CHECK(PeriodicMatrix{kMean, {{1, kCosine, {}}}}.is_symmetric());
  CHECK_FALSE(PeriodicMatrix{kMean, {{1, kCosine, kSkew}}}.is_symmetric());
  MatrixXd nearly = kMean;
  nearly(0, 1) = std::nextafter(nearly(0, 1), 0.0);
  CHECK_FALSE(PeriodicMatrix{nearly, {}}.is_symmetric());
}

TEST_CASE("Proportional damping is recognised exactly, and only it", "[model][linear_system]") {
  auto system = good();
  CHECK(system.degrees_of_freedom() == 2);
  CHECK(system.states() == 4);
  CHECK_FALSE(system.has_damping());
  CHECK(system.proportional_damping() == 0.0);
  system.damping.mean = MatrixXd::Zero(2, 2);
  CHECK_FALSE(system.has_damping());
  CHECK(system.proportional_damping() == 0.0);
  for (const double c : {0.25, -3.0, 1e-300}) {
    system.damping.mean = c * system.mass;
    CHECK(system.has_damping());
    CHECK(system.proportional_damping() == c);
  }
  system.damping.mean = MatrixXd{{0.5, 0.125}, {0.125, 0.25000000000000006}};
  CHECK_FALSE(system.proportional_damping());
  system.damping.mean = kSkew;  // gyroscopic
  CHECK_FALSE(system.proportional_damping());
  system.damping = {0.25 * system.mass, {{1, system.mass, {}}}};
  CHECK_FALSE(system.proportional_damping());
  system.damping = {MatrixXd::Zero(2, 2), {{1, {}, system.mass}}};
  CHECK(system.has_damping());
  CHECK_FALSE(system.proportional_damping());
}

TEST_CASE("A linear system says what is wrong with it", "[model][linear_system][error]") {
  const auto refused = [](auto change) {
    auto system = good();
    system.validate();
    change(system);
    std::string message;
    try {
      system.validate();
    } catch (const InvalidInput& error) {
      message = error.what();
    }
    return message;
  };
  using System = LinearPeriodicSystem;
  const MatrixXd three = MatrixXd::Identity(3, 3), broken = kMean * std::nan("");
  for (const double bad : {0.0, -1.0, std::nan(""), HUGE_VAL}) {
    CHECK(refused([bad](System& s) { s.period = bad; }) ==
          "linear.period = " + to_text(bad) + " is not allowed: it must be a finite number > 0");
  }
  CHECK(refused([](System& s) { s.mass.resize(0, 0); }) ==
        "linear.mass = matrix is not allowed: it must be square, not empty");
  CHECK(refused([](System& s) { s.mass = MatrixXd::Ones(2, 3); }) ==
        "linear.mass = matrix is not allowed: it must be square, not empty");
  CHECK(refused([](System& s) { s.mass = MatrixXd::Ones(2, 2); }) ==
        "linear.mass = matrix is not allowed: it must be invertible");
  CHECK(refused([&](System& s) { s.mass = broken; }) ==
        "linear.mass = matrix is not allowed: it must be finite in every entry");
  CHECK(refused([](System& s) { s.stiffness = {}; }) ==
        "linear.stiffness = nothing is not allowed: it must be given");
  const std::string shape = " = matrix is not allowed: it must be square, of the size of linear.mass";
  const std::string finite = " = matrix is not allowed: it must be finite in every entry";
  CHECK(refused([&](System& s) { s.stiffness.mean = three; }) == "linear.stiffness" + shape);
  CHECK(refused([&](System& s) { s.stiffness.harmonics[1].sine = three; }) == "linear.stiffness" + shape);
  CHECK(refused([&](System& s) { s.stiffness.harmonics[0].cosine = broken; }) == "linear.stiffness" + finite);
  CHECK(refused([&](System& s) { s.damping.mean = three; }) == "linear.damping" + shape);
  CHECK(refused([&](System& s) { s.damping.mean = broken; }) == "linear.damping" + finite);
  // harmonics without a mean would be lost
  CHECK(refused([](System& s) {
          s.damping.harmonics = {{1, kSkew, {}}};
        }) == "linear.damping.mean = nothing is not allowed: it must be given with harmonics");
  CHECK(refused([](System& s) { s.stiffness.harmonics[0].order = 0; }) ==
        "order in linear.stiffness.harmonics = 0 is not allowed: it must be an integer >= 1");
  CHECK(refused([](System& s) { s.stiffness.harmonics[0].order = 3; }) ==
        "order in linear.stiffness.harmonics = 3 is not allowed: it must be given only once");
}

}  // namespace strutt::test::linear_system_test
