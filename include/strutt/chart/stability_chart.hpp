#pragma once

#include <atomic>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "strutt/base/method.hpp"
#include "strutt/base/outcome.hpp"
#include "strutt/chart/axis.hpp"
#include "strutt/chart/forecast.hpp"
#include "strutt/chart/surrogate.hpp"
#include "strutt/model/scene.hpp"

namespace strutt {

/// The arrays a chart can hold, one value a cell.
enum class Layer : signed char { verdict, growth, winding, discriminant, margin, outcome };
inline constexpr int kLayerCount = 6;
std::string_view to_string(Layer layer);
Layer layer_from_string(std::string_view name);  ///< throws InvalidInput naming the known layers
std::string_view unit_of(Layer layer);           ///< "1" or "" as written to files
bool is_categorical(Layer layer);                ///< verdict and outcome: int8 in binary files, names in text

/// What to compute.
struct ChartRequest {
  Axis x;
  Axis y;
  std::vector<Layer> layers{Layer::verdict, Layer::growth};
  double tolerance = 1e-9;  ///< 1e-13 <= tolerance <= 1e-2
  /// surrogate: Chebyshev boxes (chart/surrogate.hpp) for all cells whose error and verdict they can answer
  /// for, the others and charts without a surrogate point by point by the engine's choice. automatic: that,
  /// where it is expected to be the cheapest, else point by point. Every other method: point by point.
  Method method = Method::automatic;
  int threads = 0;     ///< 0: all
  bool force = false;  ///< lifts the memory budget
  const std::atomic<bool>* cancel = nullptr;
};

/// What it will take, known before anything is computed.
struct ChartPlan {
  std::size_t cells = 0;
  std::size_t rows_per_strip = 0;
  double result_bytes = 0.0;      ///< of all layers and axes as float64
  double working_bytes = 0.0;     ///< of strip buffer, workspaces and surrogate; does not grow with the rows
  double budget_bytes = 0.0;      ///< memory_budget()
  double expected_seconds = 0.0;  ///< chart/forecast.hpp; without reading and writing
  Method method = Method::automatic;  ///< the one that will be used
  /// Why no surrogate is used; empty if one is, or if another method was asked for.
  std::string refusal;
  PointForecast point;                         ///< of a cell that is not interpolated
  std::optional<SurrogateForecast> surrogate;  ///< if one was considered
  int threads = 1;
};

/// What a result may take unless the user lifts the budget: half of the physical memory, in bytes.
double memory_budget();

/// Checks the request against the scene (parameters exist, ends are valid values, sizes do not overflow) and
/// forecasts it. Method::automatic takes the surrogate where a chart takes a hundredth of a second or more
/// point by point, and at most half of that by the surrogate. The same scene and request but for the threads
/// give the same plan.
/// Throws InvalidInput, and MemoryBudgetExceeded when result_bytes or working_bytes > budget_bytes unless
/// `force`.
ChartPlan plan_chart(const Scene& scene, const ChartRequest& request);

/// Consecutive rows of a chart: layer l, row j (from 0 in this strip), column i at
/// values[l][j * nx + i], exactly rows * columns values each; categorical layers as the enumerator's value.
/// Failed cells: NaN in real layers, unresolved in `verdict`.
struct ChartStrip {
  std::size_t first_row = 0;
  std::size_t rows = 0;
  std::size_t columns = 0;
  std::vector<std::span<double>> values;  ///< one per requested layer, in the order of the request
};

/// Receives the strips in order of rows, on the calling thread. What `values` show is written over
/// afterwards.
using StripSink = std::function<void(const ChartStrip&)>;

/// Cells done so far of all, from the calling thread, a few times a second.
using ProgressSink = std::function<void(std::size_t done, std::size_t total)>;

/// What came out, besides the cells.
struct ChartSummary {
  bool cancelled = false;
  std::size_t cells = 0;
  std::size_t unresolved = 0;         ///< cells whose verdict is unresolved (0 unless asked for)
  std::vector<std::size_t> outcomes;  ///< cells per Outcome
  long right_hand_sides = 0;
  double largest_error = 0.0;                ///< of all converged cells
  std::size_t interpolated = 0;              ///< cells whose values come from the surrogate
  std::vector<std::size_t> methods;          ///< cells per Method that gave their values
  std::optional<SurrogateReport> surrogate;  ///< how building it went
};

/// Computes the chart strip by strip. Cells are independent: the same bits for any number of threads.
/// Throws what plan_chart throws; exceptions of the sinks pass through.
ChartSummary compute_chart(const Scene& scene, const ChartRequest& request, const StripSink& sink,
                           const ProgressSink& progress = {});

/// The same straight into arrays of the caller, one per layer in the order of the request, each of ny rows of
/// nx values. Throws InvalidInput besides if they are not.
ChartSummary compute_chart(const Scene& scene, const ChartRequest& request,
                           std::span<const std::span<double>> arrays, const ProgressSink& progress = {});

}  // namespace strutt
