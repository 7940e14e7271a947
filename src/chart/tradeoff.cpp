#include "strutt/chart/tradeoff.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "chart/tradeoff_contestant.hpp"
#include "strutt/base/error.hpp"
#include "strutt/base/parallel.hpp"
#include "strutt/chart/forecast.hpp"
#include "strutt/chart/stability_chart.hpp"
#include "strutt/floquet/stability.hpp"

namespace strutt {
namespace {

constexpr std::array kJudged{Method::automatic,  Method::surrogate, Method::exact,
                             Method::propagator, Method::arkode,    Method::cvode};
constexpr std::array kDecades{1e-2, 1e-3, 1e-4, 1e-5, 1e-6, 1e-7, 1e-8, 1e-9, 1e-10, 1e-11, 1e-12, 1e-13};

bool is_cancelled(const TradeoffRequest& request) {
  return request.cancel != nullptr && request.cancel->load();
}

/// The points that make an equation.
Questions questions_of(Scene scene, const TradeoffPoints& points) {
  std::vector<double*> values;
  for (const auto& path : points.parameters) values.push_back(&parameter(scene, path));
  Questions result;
  result.scene = scene;
  for (const auto& row : points.rows) {
    for (std::size_t i = 0; i < row.size(); ++i) *values[i] = row[i];
    try {
      validate(scene);
      LinearModel model = linear_model(scene);
      std::visit([](const auto& m) { m.validate(); }, model);
      result.models.push_back(std::move(model));
      result.rows.push_back(row);
      result.equations.push_back(judge::equation_of(scene));
    } catch (const InvalidInput&) {
      // as in a chart: not every point of a box need be a body
    }
  }
  if (result.models.empty()) throw InvalidInput("points", "none", "one that makes an equation or more");
  return result;
}

/// Fills in the truths; false when cancelled.
bool find_truths(Questions& questions, const TradeoffRequest& request) {
  questions.truths.resize(questions.equations.size());
  return parallel_for(questions.equations.size(), {.threads = request.threads, .cancel = request.cancel},
                      [&](std::size_t i, int) {
                        auto truth = judge::monodromy(questions.equations[i], request.cancel);
                        if (truth)
                          questions.truths[i] = *std::move(truth);
                        else if (!is_cancelled(request))
                          throw NumericalFailure("the reference needs more steps than it may take");
                      }) &&
         !is_cancelled(request);
}

/// Marks the rows that no other method beats in both; equal rows alike.
void mark_front(std::vector<TradeoffRow>& rows) {
  std::vector<TradeoffRow*> order;
  for (auto& row : rows) {
    if (row.method != Method::automatic && std::isfinite(row.true_error)) order.push_back(&row);
  }
  std::stable_sort(order.begin(), order.end(), [](const TradeoffRow* a, const TradeoffRow* b) {
    return a->points_per_second != b->points_per_second ? a->points_per_second > b->points_per_second
                                                        : a->true_error < b->true_error;
  });
  const TradeoffRow* last = nullptr;  // on the front
  for (TradeoffRow* row : order) {
    const bool equal = last != nullptr && row->true_error == last->true_error &&
                       row->points_per_second == last->points_per_second;
    row->pareto = last == nullptr || row->true_error < last->true_error || equal;
    if (row->pareto) last = row;
  }
}

/// Throws InvalidInput if the method does not fit.
void check_fit(const Scene& scene, const LinearModel& model, Method method, const TradeoffPoints& points) {
  if (method != Method::surrogate) {
    method_for(model, method);
    return;
  }
  if (!points.box) throw InvalidInput("method surrogate needs points from the box of a chart");
  const auto refusal = Surrogate::refusal(scene, points.box->x, points.box->y);
  if (!refusal.empty()) throw InvalidInput("there is no surrogate: " + refusal);
}

bool fits(const Scene& scene, const LinearModel& model, Method method, const TradeoffPoints& points) {
  try {
    check_fit(scene, model, method, points);
    return true;
  } catch (const InvalidInput&) {
    return false;
  }
}

}  // namespace

TradeoffPoints scene_point() { return {{}, {{}}, std::nullopt}; }

TradeoffPoints scattered_points(const Axis& x, const Axis& y, std::size_t count) {
  constexpr double plastic = 1.3247179572447460;  // p^3 = p + 1
  constexpr std::size_t cells = std::size_t{1} << 30;
  const auto along = [&](Axis axis, double share) {
    if (axis.points == 1) return axis.from;
    axis.points = cells + 1;
    return axis.value(static_cast<std::size_t>(share * static_cast<double>(cells)));
  };
  TradeoffPoints result{{x.parameter, y.parameter}, {}, ChartBox{x, y}};
  for (std::size_t i = 1; i <= count; ++i) {
    double whole = 0.0;
    const auto n = static_cast<double>(i);
    const double first = std::modf(0.5 + n / plastic, &whole);
    const double second = std::modf(0.5 + n / (plastic * plastic), &whole);
    result.rows.push_back({along(x, first), along(y, second)});
  }
  return result;
}

TradeoffRequest completed(const Scene& scene, TradeoffRequest request) {
  const LinearModel model = linear_model(scene);
  if (request.methods.empty()) {
    std::copy_if(kJudged.begin(), kJudged.end(), std::back_inserter(request.methods),
                 [&](Method method) { return fits(scene, model, method, request.points); });
  }
  if (request.tolerances.empty()) request.tolerances.assign(kDecades.begin(), kDecades.end());
  for (const Method method : request.methods) check_fit(scene, model, method, request.points);
  for (const double tolerance : request.tolerances) MonodromyOptions{.tolerance = tolerance}.validate();
  require(request.repeats >= 1, "repeats", request.repeats, "at least 1");
  require(request.seconds >= 0.0, "seconds", request.seconds, "at least 0");
  return request;
}

double expected_seconds(const Scene& scene, const TradeoffRequest& request) {
  const LinearModel model = linear_model(scene);
  double seconds = 0.0;
  const auto points = static_cast<double>(request.points.rows.size());
  for (const Method method : request.methods) {
    for (const double tolerance : request.tolerances) {
      if (method == Method::surrogate) {
        seconds +=
            request.repeats * plan_chart(scene, chart_of(*request.points.box, tolerance)).expected_seconds;
        continue;
      }
      const double once = points * forecast_point(model, {.tolerance = tolerance, .method = method},
                                                  {.winding = false, .matrix = false})
                                       .seconds;
      seconds += 2.0 * once + request.repeats * std::max(request.seconds, once);
    }
  }
  return seconds;
}

Tradeoff measure_tradeoff(const Scene& scene, const TradeoffRequest& asked,
                          const TradeoffProgress& progress) {
  const TradeoffRequest request = completed(scene, asked);
  Questions questions = questions_of(scene, request.points);
  Tradeoff result{.rows = {}, .points = questions.models.size(), .cancelled = true};
  if (!find_truths(questions, request)) return result;

  std::vector<Contestant> contestants;
  for (const Method method : request.methods) {
    for (const double tolerance : request.tolerances) contestants.emplace_back(method, tolerance, request);
  }
  std::size_t done = 0;
  const std::size_t total = contestants.size() * static_cast<std::size_t>(request.repeats + 1);
  for (int round = 0; round <= request.repeats; ++round) {
    for (auto& contestant : contestants) {
      if (round == 0)
        contestant.judge(questions);
      else
        contestant.measure(questions, request.seconds);
      if (is_cancelled(request)) return result;
      if (progress) progress(++done, total);
    }
  }
  for (const auto& contestant : contestants) result.rows.push_back(contestant.row());
  mark_front(result.rows);
  result.cancelled = false;
  return result;
}

}  // namespace strutt
