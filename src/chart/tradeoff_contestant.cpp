#include "chart/tradeoff_contestant.hpp"

#include <time.h>

#include <algorithm>
#include <cmath>
#include <map>

namespace strutt {
namespace {

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

/// The methods of results, most frequent first.
std::vector<Method> methods_in(const std::vector<Stability>& results) {
  std::map<Method, std::size_t> counts;
  for (const auto& result : results) ++counts[result.method];
  std::vector<Method> methods;
  for (const auto& [method, count] : counts) methods.push_back(method);
  std::stable_sort(methods.begin(), methods.end(), [&](Method a, Method b) { return counts[a] > counts[b]; });
  return methods;
}

/// Bound of the error of the trace relative to M from 0, whose largest entry is half of |trace| at least:
/// what is left of a monodromy seen from another phase.
double error_of_trace(const HillMonodromy& monodromy) {
  const auto& [value, error] = monodromy.matrix;
  const double unit = std::exp2(static_cast<double>(value.exponent));
  return error.trace() * unit / std::max(1.0, 0.5 * std::abs(value.mantissa.trace()) * unit) + 0x1p-50;
}

/// What the surrogate says at a point; nothing where it does not answer for its tolerance.
std::optional<Stability> answer(const Surrogate& surrogate, const LinearModel& model, double x, double y) {
  if (auto found = surrogate.hill_monodromy(x, y)) {
    if (surrogate.even_phase().value_or(0.0) != 0.0)
      found->error = std::max(found->error, error_of_trace(*found));
    if (!(found->error <= surrogate.data().tolerance)) return std::nullopt;
    const auto* const system = std::get_if<LinearPeriodicSystem>(&model);
    const auto equation = system != nullptr ? *as_hill_equation(*system) : std::get<HillEquation>(model);
    return assess(equation, *found);
  }
  const auto found = surrogate.monodromy(x, y);
  if (!found || found->outcome != Outcome::converged) return std::nullopt;
  return assess(std::get<LinearPeriodicSystem>(model), *found);
}

}  // namespace

ChartRequest chart_of(const ChartBox& box, double tolerance) {
  return {.x = box.x,
          .y = box.y,
          .layers = {Layer::verdict, Layer::growth, Layer::margin},
          .tolerance = tolerance,
          .method = Method::surrogate,
          .threads = 1};
}

Contestant::Contestant(Method method, double tolerance, const TradeoffRequest& request)
    : options_{.tolerance = tolerance, .method = method, .cancel = request.cancel} {
  row_.method = method;
  row_.tolerance = tolerance;
  if (method != Method::surrogate) return;
  chart_ = chart_of(*request.points.box, tolerance);
  chart_->cancel = request.cancel;
}

void Contestant::judge(const Questions& questions) {
  const auto results = chart_ ? interpolated(questions)
                              : analyse(engine_, questions.models, options_,
                                        {.verdict = false, .winding = false, .matrix = true});
  row_.points = results.size();
  row_.used = methods_in(results);
  const auto count = static_cast<double>(results.size());
  std::vector<double> errors;
  for (std::size_t i = 0; i < results.size(); ++i) {
    const auto& result = results[i];
    errors.push_back(shifted_ && result.method == Method::surrogate
                         ? judge::trace_error(questions.truths[i], result)
                         : judge::true_error(questions.truths[i], result));
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

/// By the surrogate of the chart, and where it does not answer by the engine.
std::vector<Stability> Contestant::interpolated(const Questions& questions) {
  const Surrogate surrogate(questions.scene, chart_->x, chart_->y,
                            {.tolerance = chart_->tolerance, .threads = 1, .cancel = chart_->cancel});
  shifted_ = surrogate.even_phase().value_or(0.0) != 0.0;
  const double cells = static_cast<double>(chart_->x.points) * static_cast<double>(chart_->y.points);
  row_.right_hand_sides = static_cast<double>(surrogate.report().right_hand_sides) / cells;
  MonodromyOptions point_by_point = options_;
  point_by_point.method = Method::automatic;
  std::vector<Stability> results;
  for (std::size_t i = 0; i < questions.models.size(); ++i) {
    const auto& row = questions.rows[i];
    auto found =
        surrogate.cancelled() ? std::nullopt : answer(surrogate, questions.models[i], row[0], row[1]);
    results.push_back(
        found ? *std::move(found)
              : analyse(engine_, questions.models[i], point_by_point, {.verdict = false, .winding = false}));
  }
  return results;
}

void Contestant::measure(const Questions& questions, double seconds) {
  if (chart_) {
    times_.push_back(seconds_per_cell(questions.scene));
    return;
  }
  if (copies_ == 0) {
    const auto most = (kTogether + questions.models.size() - 1) / questions.models.size();
    const double ratio = seconds / std::max(seconds_per_batch(questions.models, 0.0), 1e-9);
    copies_ =
        ratio < static_cast<double>(most) ? std::max<std::size_t>(static_cast<std::size_t>(ratio), 1) : most;
  }
  std::vector<LinearModel> batch;
  for (std::size_t i = 0; i < copies_; ++i)
    batch.insert(batch.end(), questions.models.begin(), questions.models.end());
  times_.push_back(seconds_per_batch(batch, seconds) / static_cast<double>(batch.size()));
}

TradeoffRow Contestant::row() const {
  TradeoffRow result = row_;
  const double middle = median(times_);
  const auto [fastest, slowest] = std::minmax_element(times_.begin(), times_.end());
  result.points_per_second = 1.0 / middle;
  result.spread = (*slowest - *fastest) / middle;
  return result;
}

/// The mean over as many runs as take `at_least`.
double Contestant::seconds_per_batch(const std::vector<LinearModel>& batch, double at_least) {
  const double begin = thread_seconds();
  for (double runs = 1.0;; ++runs) {
    const auto results =
        analyse(engine_, batch, options_, {.verdict = false, .winding = false, .matrix = false});
    const double spent = thread_seconds() - begin;
    if (spent >= at_least || results.front().outcome == Outcome::cancelled) return spent / runs;
  }
}

/// Of the whole chart, building included.
double Contestant::seconds_per_cell(const Scene& scene) const {
  const double begin = thread_seconds();
  const auto summary = compute_chart(scene, *chart_, [](const ChartStrip&) {});
  return (thread_seconds() - begin) / static_cast<double>(std::max<std::size_t>(summary.cells, 1));
}

}  // namespace strutt
