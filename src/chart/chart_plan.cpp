#include <unistd.h>

#include <algorithm>
#include <cmath>

#include "chart/surrogate_scope.hpp"
#include "strutt/base/error.hpp"
#include "strutt/base/parallel.hpp"
#include "strutt/chart/stability_chart.hpp"
#include "strutt/chart/surrogate.hpp"
#include "strutt/floquet/stability.hpp"

namespace strutt {
namespace {

constexpr std::size_t kStripCells = 65'536;

// Cost of a cell, measured on one core of a 2020s server at tolerance 1e-9; for the forecast only.
struct CellCost {
  Method method;
  double seconds;            // of a Hill equation
  double seconds_of_system;  // of four states
};
constexpr CellCost kCellCosts[] = {{Method::surrogate, 2e-8, 4e-6},
                                   {Method::exact, 2e-6, 2e-6},
                                   {Method::propagator, 1e-6, 1.6e-5},
                                   {Method::arkode, 1e-4, 1.8e-4},
                                   {Method::cvode, 5e-4, 1.2e-3}};

constexpr double kMatrixCellSeconds = 4e-6;  // surrogates of whole periods: eigenvalues cell by cell

std::string gigabytes(double bytes) { return to_text(std::round(bytes / 1e7) / 100.0) + " GB"; }

void check_request(const ChartRequest& request) {
  request.x.validate("x");
  request.y.validate("y");
  if (request.x.parameter == request.y.parameter) {
    throw InvalidInput("y axis: parameter", request.y.parameter, "different from that of the x axis");
  }
  if (request.layers.empty()) throw InvalidInput("layers", "none", "at least one");
  for (std::size_t i = 0; i < request.layers.size(); ++i) {
    if (std::count(request.layers.begin(), request.layers.end(), request.layers[i]) > 1) {
      throw InvalidInput("layers", to_string(request.layers[i]), "asked for only once");
    }
  }
  const Method engine = request.method == Method::surrogate ? Method::automatic : request.method;
  MonodromyOptions{.tolerance = request.tolerance, .method = engine}.validate();
}

}  // namespace

double memory_budget() {
  return 0.5 * static_cast<double>(sysconf(_SC_PHYS_PAGES)) * static_cast<double>(sysconf(_SC_PAGESIZE));
}

double expected_seconds_per_point(Method method, const LinearModel& model) {
  const bool system = std::holds_alternative<LinearPeriodicSystem>(model);
  for (const auto& cost : kCellCosts) {
    if (cost.method == method) return system ? cost.seconds_of_system : cost.seconds;
  }
  return 0.0;
}

ChartPlan plan_chart(const Scene& scene, const ChartRequest& request) {
  check_request(request);
  Scene corner = scene;
  for (const double x : {request.x.from, request.x.to}) {
    for (const double y : {request.y.from, request.y.to}) {
      parameter(corner, request.x.parameter) = x;
      parameter(corner, request.y.parameter) = y;
      validate(corner);
    }
  }
  const LinearModel model = linear_model(corner);

  ChartPlan plan;
  const double cells = static_cast<double>(request.x.points) * static_cast<double>(request.y.points);
  if (!(cells < 9e15))
    throw MemoryBudgetExceeded("a chart of " + to_text(cells) + " cells is beyond any machine");
  const std::size_t nx = request.x.points, ny = request.y.points, layers = request.layers.size();
  plan.cells = nx * ny;
  plan.rows_per_strip = std::clamp<std::size_t>(kStripCells / nx, 1, ny);
  plan.result_bytes = 8.0 * (cells * static_cast<double>(layers) + static_cast<double>(nx + ny));
  plan.working_bytes = 8.0 * static_cast<double>(plan.rows_per_strip * nx) * static_cast<double>(layers + 4);
  plan.budget_bytes = memory_budget();
  if (request.method == Method::surrogate) plan.refusal = Surrogate::refusal(scene, request.x, request.y);
  const bool interpolated = request.method == Method::surrogate && plan.refusal.empty();
  plan.method = interpolated || request.method != Method::surrogate ? request.method : Method::automatic;
  if (!interpolated) plan.method = method_for(model, plan.method);
  plan.threads = thread_count({.threads = request.threads});
  const bool matrices =
      interpolated && surrogate_scope(scene, request.x, request.y).kind == SurrogateKind::period;
  plan.expected_seconds =
      cells * (matrices ? kMatrixCellSeconds : expected_seconds_per_point(plan.method, model)) / plan.threads;
  const double bytes = std::max(plan.result_bytes, plan.working_bytes);
  if (bytes > plan.budget_bytes && !request.force) {
    throw MemoryBudgetExceeded("a chart of " + std::to_string(nx) + " x " + std::to_string(ny) +
                               " points with " + std::to_string(layers) + " layers takes " +
                               gigabytes(bytes) + ", more than the budget of " +
                               gigabytes(plan.budget_bytes) + " (half of the memory); --force lifts it");
  }
  return plan;
}

}  // namespace strutt
