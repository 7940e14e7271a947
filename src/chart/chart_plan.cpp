#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>

#include "chart/cell_engine.hpp"
#include "chart/cost_table.hpp"
#include "chart/surrogate_forecast.hpp"
#include "chart/surrogate_scope.hpp"
#include "strutt/base/error.hpp"
#include "strutt/base/parallel.hpp"
#include "strutt/chart/stability_chart.hpp"
#include "strutt/floquet/stability.hpp"

namespace strutt {
namespace {

constexpr std::size_t kStripCells = 65'536;
constexpr std::size_t kSurrogateStripCells = 98'304;  // four pieces of 4096 columns, for as many threads

constexpr double kLeastSeconds = 0.01;  // point by point, of charts for which a surrogate is considered
constexpr double kLeastGain = 2.0;      // more than the forecast can be wrong by

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

void check_memory(const ChartPlan& plan, const ChartRequest& request) {
  const double bytes = std::max(plan.result_bytes, plan.working_bytes);
  if (bytes <= plan.budget_bytes || request.force) return;
  throw MemoryBudgetExceeded("a chart of " + std::to_string(request.x.points) + " x " +
                             std::to_string(request.y.points) + " points with " +
                             std::to_string(request.layers.size()) + " layers takes " + gigabytes(bytes) +
                             ", more than the budget of " + gigabytes(plan.budget_bytes) +
                             " (half of the memory); --force lifts it");
}

/// Why a surrogate that is possible is not worth building.
std::string refusal_by_cost(const SurrogateForecast& forecast, double with_surrogate, double point_by_point) {
  if (forecast.boxes == 0) return "no box is worth its nodes, or reaches the tolerance";
  return fmt::format("it would take {:.2g} s, point by point takes {:.2g} s", with_surrogate, point_by_point);
}

void set_strips(ChartPlan& plan, const ChartRequest& request, std::size_t cells) {
  plan.rows_per_strip = std::clamp<std::size_t>(cells / request.x.points, 1, request.y.points);
  plan.working_bytes = 8.0 * static_cast<double>(plan.rows_per_strip * request.x.points) *
                       static_cast<double>(request.layers.size() + 4);
}

/// Method, forecasts and time of one thread.
void choose_method(ChartPlan& plan, const Scene& scene, const ChartRequest& request) {
  const bool asked = request.method == Method::surrogate, open = request.method == Method::automatic;
  const auto engine = asked ? Method::automatic : request.method;
  plan.point = forecast_points(scene, request.x, request.y,
                               {.tolerance = request.tolerance, .method = engine}, parts_of(request.layers));
  plan.expected_seconds = static_cast<double>(plan.cells) * plan.point.seconds;
  if (plan.method == Method::propagator && !scene.linear) plan.expected_seconds += kCosts.hill_tables;
  if (!asked && !open) return;
  const auto scope = surrogate_scope(scene, request.x, request.y);
  plan.refusal = scope.refusal;
  if (open && plan.refusal.empty() && plan.expected_seconds < kLeastSeconds)
    plan.refusal = "the chart is small";
  if (!plan.refusal.empty()) return;
  plan.surrogate = forecast_surrogate(scene, request, scope);
  const double seconds = expected_seconds(*plan.surrogate, plan.point, scene, request, scope);
  if (open && kLeastGain * seconds > plan.expected_seconds) {
    plan.refusal = refusal_by_cost(*plan.surrogate, seconds, plan.expected_seconds);
    return;
  }
  plan.method = Method::surrogate;
  plan.expected_seconds = seconds;
  set_strips(plan, request, kSurrogateStripCells);
  plan.working_bytes += plan.surrogate->bytes;
}

}  // namespace

double memory_budget() {
  return 0.5 * static_cast<double>(sysconf(_SC_PHYS_PAGES)) * static_cast<double>(sysconf(_SC_PAGESIZE));
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

  ChartPlan plan;
  const double cells = static_cast<double>(request.x.points) * static_cast<double>(request.y.points);
  if (!(cells < 9e15))
    throw MemoryBudgetExceeded("a chart of " + to_text(cells) + " cells is beyond any machine");
  const std::size_t nx = request.x.points, ny = request.y.points, layers = request.layers.size();
  plan.cells = nx * ny;
  plan.result_bytes = 8.0 * (cells * static_cast<double>(layers) + static_cast<double>(nx + ny));
  set_strips(plan, request, kStripCells);
  plan.budget_bytes = memory_budget();
  plan.threads = thread_count({.threads = request.threads});
  check_memory(plan, request);
  plan.method = method_for(linear_model(corner),
                           request.method == Method::surrogate ? Method::automatic : request.method);
  choose_method(plan, scene, request);
  plan.expected_seconds /= plan.threads;
  check_memory(plan, request);
  return plan;
}

}  // namespace strutt
