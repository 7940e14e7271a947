#pragma once

#include <span>

#include "chart/surrogate_scope.hpp"
#include "strutt/chart/forecast.hpp"
#include "strutt/chart/stability_chart.hpp"

namespace strutt {

/// What a surrogate over the axes of the request would take, by the rules of build_surrogate with trial
/// propagators along the edges of each box instead of nodes all over it.
SurrogateForecast forecast_surrogate(const Scene& scene, const ChartRequest& request,
                                     const SurrogateScope& scope);

/// Expected time of one thread for the chart, `point` each of the cells that are not interpolated.
double expected_seconds(const SurrogateForecast& forecast, const PointForecast& point, const Scene& scene,
                        const ChartRequest& request, const SurrogateScope& scope);

}  // namespace strutt
