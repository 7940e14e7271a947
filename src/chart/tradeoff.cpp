#include "strutt/chart/tradeoff.hpp"

#include <time.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

#include "chart/reference_monodromy.hpp"
#include "strutt/base/error.hpp"
#include "strutt/base/parallel.hpp"
#include "strutt/chart/forecast.hpp"
#include "strutt/floquet/stability.hpp"

namespace strutt {
namespace {

constexpr std::array kJudged{Method::automatic, Method::exact, Method::propagator, Method::arkode,
                             Method::cvode};
constexpr std::array kDecades{1e-2, 1e-3, 1e-4, 1e-5, 1e-6, 1e-7, 1e-8, 1e-9, 1e-10, 1e-11, 1e-12, 1e-13};
constexpr std::size_t kTogether = 256;  // equations that a chart gives an engine at once

/// Processor time of the calling thread: what other programs take meanwhile is not in it.
double thread_seconds() {
  timespec now{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

double median(std::vector<double> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

bool is_cancelled(const TradeoffRequest& request) {
  return request.cancel != nullptr && request.cancel->load();
}

/// What is asked, and the truth about it.
struct Questions {
  std::vector<LinearModel> models;
  std::vector<judge::Equation> equations;
  std::vector<judge::Monodromy> truths;
};

/// The points that make an equation.
Questions questions_of(Scene scene, const TradeoffPoints& points) {
  std::vector<double*> values;
  for (const auto& path : points.parameters) values.push_back(&parameter(scene, path));
  Questions result;
  for (const auto& row : points.rows) {
    for (std::size_t i = 0; i < row.size(); ++i) *values[i] = row[i];
    try {
      validate(scene);
      LinearModel model = linear_model(scene);
      std::visit([](const auto& m) { m.validate(); }, model);
      result.models.push_back(std::move(model));
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

/// The methods of results, most frequent first.
std::vector<Method> methods_in(const std::vector<Stability>& results) {
  std::map<Method, std::size_t> counts;
  for (const auto& result : results) ++counts[result.method];
  std::vector<Method> methods;
  for (const auto& [method, count] : counts) methods.push_back(method);
  std::stable_sort(methods.begin(), methods.end(), [&](Method a, Method b) { return counts[a] > counts[b]; });
  return methods;
}

/// One row while it is being measured.
class Contestant {
 public:
  Contestant(Method method, double tolerance, const TradeoffRequest& request)
      : options_{.tolerance = tolerance, .method = method, .cancel = request.cancel} {
    row_.method = method;
    row_.tolerance = tolerance;
  }

  /// Errors and work; the first, cold run.
  void judge(const Questions& questions) {
    const auto results = analyse(engine_, questions.models, options_, {.winding = false, .matrix = true});
    row_.points = results.size();
    row_.used = methods_in(results);
    const auto count = static_cast<double>(results.size());
    std::vector<double> errors;
    for (std::size_t i = 0; i < results.size(); ++i) {
      const auto& result = results[i];
      errors.push_back(judge::true_error(questions.truths[i], result));
      row_.converged += result.outcome == Outcome::converged ? 1 : 0;
      row_.exceeded += errors.back() > result.error ? 1 : 0;
      row_.error = std::max(row_.error, result.error);
      row_.steps += static_cast<double>(result.cost.steps) / count;
      row_.right_hand_sides += static_cast<double>(result.cost.right_hand_sides) / count;
      row_.estimate_right_hand_sides += static_cast<double>(result.estimate_cost.right_hand_sides) / count;
    }
    row_.true_error = *std::max_element(errors.begin(), errors.end());
    row_.median_true_error = median(std::move(errors));
  }

  /// The first measurement says how often the points are to be repeated in the others.
  void measure(const Questions& questions, double seconds) {
    if (copies_ == 0) {
      const auto most = (kTogether + questions.models.size() - 1) / questions.models.size();
      const double ratio = seconds / std::max(seconds_per_batch(questions.models, 0.0), 1e-9);
      copies_ = ratio < static_cast<double>(most) ? std::max<std::size_t>(static_cast<std::size_t>(ratio), 1)
                                                  : most;
    }
    std::vector<LinearModel> batch;
    for (std::size_t i = 0; i < copies_; ++i)
      batch.insert(batch.end(), questions.models.begin(), questions.models.end());
    times_.push_back(seconds_per_batch(batch, seconds) / static_cast<double>(batch.size()));
  }

  TradeoffRow row() const {
    TradeoffRow result = row_;
    const double middle = median(times_);
    const auto [fastest, slowest] = std::minmax_element(times_.begin(), times_.end());
    result.points_per_second = 1.0 / middle;
    result.spread = (*slowest - *fastest) / middle;
    return result;
  }

 private:
  /// The mean over as many runs as take `at_least`.
  double seconds_per_batch(const std::vector<LinearModel>& batch, double at_least) {
    const double begin = thread_seconds();
    for (double runs = 1.0;; ++runs) {
      const auto results = analyse(engine_, batch, options_, {.winding = false, .matrix = false});
      const double spent = thread_seconds() - begin;
      if (spent >= at_least || results.front().outcome == Outcome::cancelled) return spent / runs;
    }
  }

  MonodromyOptions options_;
  MonodromyEngine engine_;
  TradeoffRow row_;
  std::size_t copies_ = 0;  // of the points in a batch
  std::vector<double> times_;
};

/// Marks the rows that no other method beats in both. Of equal ones the first is marked.
void mark_front(std::vector<TradeoffRow>& rows) {
  std::vector<TradeoffRow*> order;
  for (auto& row : rows) {
    if (row.method != Method::automatic && std::isfinite(row.true_error)) order.push_back(&row);
  }
  std::stable_sort(order.begin(), order.end(), [](const TradeoffRow* a, const TradeoffRow* b) {
    return a->points_per_second != b->points_per_second ? a->points_per_second > b->points_per_second
                                                        : a->true_error < b->true_error;
  });
  double least = std::numeric_limits<double>::infinity();
  for (TradeoffRow* row : order) {
    row->pareto = row->true_error < least;
    least = std::min(least, row->true_error);
  }
}

bool fits(const LinearModel& model, Method method) {
  try {
    method_for(model, method);
    return true;
  } catch (const InvalidInput&) {
    return false;
  }
}

}  // namespace

TradeoffPoints scene_point() { return {{}, {{}}}; }

TradeoffPoints scattered_points(const Axis& x, const Axis& y, std::size_t count) {
  constexpr double plastic = 1.3247179572447460;  // p^3 = p + 1
  constexpr std::size_t cells = std::size_t{1} << 30;
  const auto along = [&](Axis axis, double share) {
    if (axis.points == 1) return axis.from;
    axis.points = cells + 1;
    return axis.value(static_cast<std::size_t>(share * static_cast<double>(cells)));
  };
  TradeoffPoints result{{x.parameter, y.parameter}, {}};
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
                 [&](Method method) { return fits(model, method); });
  }
  if (request.tolerances.empty()) request.tolerances.assign(kDecades.begin(), kDecades.end());
  for (const Method method : request.methods) method_for(model, method);
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
