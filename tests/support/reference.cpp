#include "support/reference.hpp"
#include "support/paths.hpp"

#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <sstream>
#include <stdexcept>

namespace reference {
namespace {

std::vector<std::string> split(const std::string& line) {
  std::vector<std::string> cells;
  std::stringstream stream(line);
  for (std::string cell; std::getline(stream, cell, ',');) cells.push_back(cell);
  return cells;
}

using namespace strutt;

LinearModel hill_model(const Row& r) {
  const auto w = PeriodicFunction::fourier(r.input("mean"), {{1, r.input("cos1"), r.input("sin1")},
                                                             {2, r.input("cos2"), r.input("sin2")},
                                                             {3, r.input("cos3"), r.input("sin3")}});
  return hill_equation(r.input("period"), w, r.input("damping"));
}

LinearModel pendulum_model(const Row& r) {
  const auto rod =
      PhysicalPendulum::uniform_rod(1.0, r.input("length"), r.input("gravity"), r.input("damping"));
  const auto support = sinusoidal_support(r.input("amplitude"), r.input("frequency"), r.input("phase"));
  const auto about = r.text("about") == "hanging" ? Equilibrium::hanging : Equilibrium::inverted;
  return linearise(rod, about, &support).equation;
}

LinearModel linear_system(const Row& r) {
  const auto symmetric = [&](const char* a, const char* b, const char* c) {
    return Eigen::MatrixXd{{r.input(a), r.input(b)}, {r.input(b), r.input(c)}};
  };
  LinearPeriodicSystem system;
  system.mass = Eigen::Matrix2d::Identity();
  if (r.input("c") != 0.0) system.damping.mean = r.input("c") * system.mass;
  system.stiffness = {symmetric("k1", "k12", "k2"), {{1, symmetric("p11", "p12", "p22"), {}}}};
  return system;
}

}  // namespace

double Row::input(const std::string& column) const { return std::strtod(text(column).c_str(), nullptr); }

std::vector<Row> read(const std::string& table) {
  std::ifstream file(strutt::test::source_directory() + "/tests/reference/" + table + ".csv");
  if (!file) throw std::runtime_error("no reference table " + table);
  std::vector<std::string> header;
  std::vector<Row> rows;
  for (std::string line; std::getline(file, line);) {
    if (line.starts_with('#')) continue;
    const auto cells = split(line);
    if (header.empty()) {
      header = cells;
      continue;
    }
    std::map<std::string, std::string> named;
    for (std::size_t i = 0; i < header.size(); ++i) named[header[i]] = cells.at(i);
    rows.emplace_back(std::move(named));
  }
  return rows;
}

LinearModel model(const std::string& table, const Row& r) {
  if (table == "mathieu")
    return mathieu_delta_epsilon(r.input("delta"), r.input("epsilon"), r.input("damping"));
  if (table == "hill") return hill_model(r);
  if (table == "pendulum") return pendulum_model(r);
  if (table == "linear4") return linear_system(r);
  const auto w = PeriodicFunction::square(r.input("mean"), r.input("amplitude"), 0.0);
  return hill_equation(r.input("period"), w, r.input("damping"));
}

double true_error(const LinearModel& model, const Stability& result, const Row& row) {
  const Eigen::Index n = result.matrix.rows(), d = n / 2;
  const auto* equation = std::get_if<HillEquation>(&model);
  const Real kappa =
      equation != nullptr ? Real(equation->canonical_kappa()) * equation->angular_frequency : Real(1);
  const Real scale = exp(Real(result.log_scale));
  Real largest = 1, error = 0, trace = 0;
  for (Eigen::Index i = 0; i < n; ++i) {
    for (Eigen::Index j = 0; j < n; ++j) {
      const Real truth = row.result("m" + std::to_string(i + 1) + std::to_string(j + 1));
      const Real weight = i < d && j >= d ? kappa : i >= d && j < d ? Real(1 / kappa) : Real(1);
      largest = std::max(largest, Real(abs(truth * weight)));
      error = std::max(error, Real(abs((truth - result.matrix(i, j) * scale) * weight)));
      if (i == j) trace += truth;
    }
  }
  error = std::max(error, Real(abs(trace - result.discriminant * scale)));
  return static_cast<double>(Real(error / largest));
}

}  // namespace reference
