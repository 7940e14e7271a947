#include "strutt/chart/tongue_curves.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "rows.hpp"
#include "scene_arguments.hpp"
#include "signals.hpp"
#include "strutt/base/error.hpp"
#include "strutt/io/tongue_figure.hpp"
#include "terminal.hpp"
#include "tongue_lines.hpp"

namespace strutt::app {
namespace {

/// What curves are asked for.
struct CurveRequest {
  TongueLine along, over;
  CurveOptions options;
};

double chord_of(const TonguesArguments& arguments, double otherwise) {
  if (!arguments.chord) return otherwise;
  const double chord = quantity_of("--chord", *arguments.chord, "");
  if (!(chord >= 1e-6 && chord <= 0.1))
    throw UsageError("--chord " + *arguments.chord + ": wanted is 1e-6 to 0.1");
  return chord;
}

/// Throws UsageError where the scene does not fit at an end of --over.
void require_window(const Scene& scene, const CurveRequest& request, const std::string& text) {
  try {
    if (request.along.parameter == request.over.parameter)
      throw InvalidInput("it is the parameter of --along");
    require(request.over.from < request.over.to, "TO", request.over.to, "above FROM");
    Scene changed = scene;
    for (const double end : {request.over.from, request.over.to}) {
      parameter(changed, request.over.parameter) = end;
      require_tongue_line(changed, request.along);
    }
  } catch (const InvalidInput& error) {
    throw UsageError("--over '" + text + "': " + error.what());
  }
}

std::vector<Column> columns_of(const Scene& scene, const CurveRequest& request, const SceneRows& rows) {
  std::vector<Column> columns{{"n", "1"}, {"curve", "1"}, {"edge", ""}};
  for (const auto& path : rows.columns) columns.push_back({path, column_unit(scene, path)});
  for (const auto& path : {request.along.parameter, request.over.parameter})
    columns.push_back({path, column_unit(scene, path)});
  columns.insert(columns.end(), {{"error", "1"}, {"method", ""}, {"outcome", ""}});
  if (scene.linear) columns.push_back({"mechanism", ""});
  return columns;
}

/// Writes the points of all curves of a scene; says whether all have converged.
bool write_curves(RowWriter& writer, const std::vector<double>& at, const std::vector<TongueCurve>& curves,
                  bool mechanism) {
  bool converged = true;
  for (std::size_t i = 0; i < curves.size(); ++i)
    for (const CurvePoint& point : curves[i].points) {
      const int order = curves[i].order;
      std::vector<Cell> row{order == kNoOrder ? Cell() : Cell(static_cast<double>(order)),
                            static_cast<double>(i), std::string(to_string(point.kind))};
      row.insert(row.end(), at.begin(), at.end());
      row.insert(row.end(), {point.along, point.over, point.error, std::string(to_string(point.method)),
                             std::string(to_string(point.outcome))});
      if (mechanism) row.emplace_back(std::string(to_string(point.mechanism)));
      writer.write(row);
      converged = converged && point.outcome == Outcome::converged;
    }
  return converged;
}

}  // namespace

ExitCode run_tongue_curves(const TonguesArguments& arguments, const SceneFile& scene,
                           const TongueLine& along) {
  if (arguments.growth) throw UsageError("--growth does not go with --over");
  CurveRequest request{along, line_of("--over", *arguments.over, scene.scene), {}};
  require_window(scene.scene, request, *arguments.over);
  request.options.tolerance =
      tolerance_of(arguments, scene.chart.tolerance.value_or(request.options.tolerance));
  request.options.chord = chord_of(arguments, request.options.chord);
  request.options.threads = threads_of(arguments);
  request.options.cancel = &cancel_flag();
  if (arguments.count)
    request.options.count = static_cast<int>(count_of("--count", *arguments.count, 1, kLargestTongue + 1));
  const SceneRows rows = scene_rows(arguments, scene.scene, along, {along.parameter, request.over.parameter});
  if (arguments.figure && rows.scenes.size() != 1)
    throw UsageError("--figure draws the curves of one scene, not of a table --at with several rows");
  require_two_files(arguments.output, arguments.figure);
  if (arguments.dry_run) {
    print_plan(scene, {"along: " + text_of(request.along), "over: " + text_of(request.over),
                       "chord: " + to_text(request.options.chord),
                       "tolerance: " + to_text(request.options.tolerance)});
    return ExitCode::done;
  }
  std::optional<TongueFigure> figure;
  if (arguments.figure) figure.emplace(*arguments.figure);
  install_signal_handlers();
  RowWriter writer(
      row_path(arguments), arguments.json, columns_of(scene.scene, request, rows),
      provenance_of(arguments, scene, tongue_method(scene.scene, along), request.options.tolerance));
  bool converged = true;
  for (std::size_t i = 0; i < rows.scenes.size(); ++i) {
    const auto curves = tongue_curves(rows.scenes[i], request.along, request.over, request.options);
    throw_if_interrupted();
    converged = write_curves(writer, rows.rows[i], curves, scene.scene.linear.has_value()) && converged;
    if (figure) {
      writer.prepare();
      figure->draw({.title = "Edges of tongues: " + describe(scene.scene),
                    .along = request.along,
                    .over = request.over,
                    .along_info = parameter_info(scene.scene, request.along.parameter),
                    .over_info = parameter_info(scene.scene, request.over.parameter),
                    .curves = curves});
    }
  }
  writer.commit();
  return converged ? ExitCode::done : ExitCode::unresolved;
}

}  // namespace strutt::app
