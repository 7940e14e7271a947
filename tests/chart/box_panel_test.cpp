// Boxes on parts of their first axis.
#include "chart/box_panel.hpp"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <random>

#include "chart/chebyshev.hpp"
#include "chart/surrogate_box.hpp"

namespace strutt::test::box_panel_test {
namespace {

/// A box with coefficients that fall like those of smooth functions.
SurrogateBox box_of(Eigen::Index terms, double decay) {
  std::mt19937_64 random(3);
  std::uniform_real_distribution<double> sign(-1.0, 1.0);
  SurrogateBox box;
  box.interpolated = true;
  box.low = {-1.0, -1.0};
  box.high = {1.0, 1.0};
  for (std::size_t f = 0; f < 4; ++f) {
    Eigen::MatrixXd c(terms, 5);
    for (Eigen::Index k = 0; k < terms; ++k) {
      for (Eigen::Index l = 0; l < 5; ++l)
        c(k, l) = sign(random) * std::pow(decay, static_cast<double>(k + l));
    }
    box.coefficients.push_back(c);
  }
  box.error.assign(4, 1e-10);
  return box;
}

/// sum c(k, l) T_k(x) T_l(y).
double value(const Eigen::MatrixXd& c, double x, double y) {
  double sum = 0.0;
  for (Eigen::Index k = 0; k < c.rows(); ++k) {
    for (Eigen::Index l = 0; l < c.cols(); ++l)
      sum += c(k, l) * std::cos(static_cast<double>(k) * std::acos(x)) *
             std::cos(static_cast<double>(l) * std::acos(y));
  }
  return sum;
}

}  // namespace

TEST_CASE("on a panel fewer terms give the functions of the box, within what is said", "[chart][surrogate]") {
  const auto [terms, decay] = GENERATE(table<Eigen::Index, double>({{14, 0.2}, {24, 0.4}, {40, 0.6}}));
  const SurrogateBox box = box_of(terms, decay);
  for (const auto& [low, high] : {std::pair{-1.0, -0.7}, {-0.1, 0.2}, {0.85, 1.0}}) {
    const BoxPanel panel = panel_of(box, low, high);
    CHECK(panel.coefficients[0].rows() <= 3 * terms / 4);
    for (std::size_t f = 0; f < 4; ++f) {
      CHECK(panel.coefficients[f].rows() == panel.coefficients[0].rows());
      CHECK(panel.error[f] <= (kPanelGrowth - 1.0) * box.error[f]);
      for (double s = -1.0; s <= 1.0; s += 0.125) {
        const double x = std::clamp(0.5 * (low + high) + 0.5 * (high - low) * s, -1.0, 1.0);
        for (const double y : {-1.0, -0.3, 0.8})
          CHECK(std::abs(value(panel.coefficients[f], s, y) - value(box.coefficients[f], x, y)) <=
                panel.error[f] + 1e-13);
      }
    }
  }
}

TEST_CASE("a panel that would save little is the whole box", "[chart][surrogate]") {
  const SurrogateBox box = box_of(10, 0.9);
  for (const auto& [low, high] : {std::pair{-1.0, 1.0}, {-1.0, 0.9}, {0.3, 0.3}}) {
    const BoxPanel panel = panel_of(box, low, high);
    CHECK(panel.low == -1.0);
    CHECK(panel.high == 1.0);
    CHECK(panel.coefficients[2] == box.coefficients[2]);
    CHECK(panel.error == std::vector<double>(4, 0.0));
  }
  SurrogateBox exact = box_of(14, 0.2);
  exact.error.assign(4, 1e-16);  // no room for the rounding of a panel
  CHECK(panel_of(exact, -0.1, 0.2).coefficients[0].rows() == 14);
}

}  // namespace strutt::test::box_panel_test
