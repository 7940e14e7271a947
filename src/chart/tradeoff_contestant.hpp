#pragma once

#include <optional>
#include <vector>

#include "chart/reference_monodromy.hpp"
#include "strutt/chart/stability_chart.hpp"
#include "strutt/chart/tradeoff.hpp"
#include "strutt/floquet/stability.hpp"

namespace strutt {

/// What is asked, and the truth about it.
struct Questions {
  Scene scene;
  std::vector<std::vector<double>> rows;  ///< values of the parameters
  std::vector<LinearModel> models;
  std::vector<judge::Equation> equations;
  std::vector<judge::Monodromy> truths;
};

/// The chart over a box that the surrogate is timed with.
ChartRequest chart_of(const ChartBox& box, double tolerance);

/// One row while it is being measured.
class Contestant {
 public:
  Contestant(Method method, double tolerance, const TradeoffRequest& request);

  /// Errors and work; the first, cold run.
  void judge(const Questions& questions);

  /// The first measurement says how often the points are to be repeated in the others.
  void measure(const Questions& questions, double seconds);

  TradeoffRow row() const;

 private:
  double seconds_per_batch(const std::vector<LinearModel>& batch, double at_least);
  double seconds_per_cell(const Scene& scene) const;
  std::vector<Stability> interpolated(const Questions& questions);

  MonodromyOptions options_;
  std::optional<ChartRequest> chart_;  // of the surrogate
  bool shifted_ = false;               // it is about another phase than 0
  MonodromyEngine engine_;
  TradeoffRow row_;
  std::size_t copies_ = 0;  // of the points in a batch
  std::vector<double> times_;
};

}  // namespace strutt
