#include "strutt/chart/tongues.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "commands.hpp"
#include "rows.hpp"
#include "scene_arguments.hpp"
#include "signals.hpp"
#include "strutt/base/error.hpp"
#include "strutt/base/parallel.hpp"
#include "terminal.hpp"
#include "tongue_lines.hpp"

namespace strutt::app {
namespace {

/// Columns that are there only if asked for, or needed.
struct Extras {
  bool mechanism = false;
  bool growth = false;
  bool crossing = false;
};

std::vector<Column> columns_of(const Scene& scene, const TongueLine& line, const SceneRows& lines,
                               const Extras& extras) {
  const auto unit = [&](const std::string& path) { return column_unit(scene, path); };
  std::vector<Column> columns{{"n", "1"}, {"edge", ""}};
  for (const auto& path : lines.columns) columns.push_back({path, unit(path)});
  columns.insert(columns.end(), {{"position", unit(line.parameter)},
                                 {"width", unit(line.parameter)},
                                 {"width_relative_error", "1"},
                                 {"error", "1"},
                                 {"method", ""},
                                 {"outcome", ""}});
  if (extras.mechanism) columns.push_back({"mechanism", ""});
  if (extras.growth)
    columns.insert(columns.end(), {{"growth", "1"}, {"growth_position", unit(line.parameter)}});
  if (extras.crossing) columns.push_back({"crossing", "1"});
  return columns;
}

std::vector<Cell> cells_of(const std::vector<double>& at, const TongueEdge& edge, const Extras& extras) {
  std::vector<Cell> row{edge.order == kNoOrder ? Cell() : Cell(static_cast<double>(edge.order)),
                        std::string(edge.upper ? "upper" : "lower")};
  row.insert(row.end(), at.begin(), at.end());
  row.insert(row.end(), {edge.position, number(edge.width), number(edge.width_relative_error), edge.error,
                         std::string(to_string(edge.method)), std::string(to_string(edge.outcome))});
  if (extras.mechanism) row.emplace_back(std::string(to_string(edge.mechanism)));
  if (extras.growth) row.insert(row.end(), {number(edge.growth), number(edge.growth_position)});
  if (extras.crossing) row.emplace_back(static_cast<double>(edge.crossing));
  return row;
}

template <typename Predicate>
bool any_edge(const std::vector<std::vector<TongueEdge>>& lines, const Predicate& predicate) {
  return std::ranges::any_of(lines, [&](const auto& edges) { return std::ranges::any_of(edges, predicate); });
}

}  // namespace

ExitCode run(const TonguesArguments& arguments) {
  const ParallelOptions parallel{.threads = threads_of(arguments), .cancel = &cancel_flag()};
  require_one_standard_input(arguments, "--at", arguments.at);
  const SceneFile scene = load_scene(arguments);
  TongueOptions options{.growth = arguments.growth, .cancel = &cancel_flag()};
  options.tolerance = tolerance_of(arguments, scene.chart.tolerance.value_or(options.tolerance));
  if (arguments.count)
    options.count = static_cast<int>(count_of("--count", *arguments.count, 1, kLargestTongue + 1));
  const TongueLine line = usable_line(arguments, scene);
  if (arguments.over) return run_tongue_curves(arguments, scene, line);
  if (arguments.figure || arguments.chord) throw UsageError("--figure and --chord go with --over");
  const Method method = tongue_method(scene.scene, line);
  method_of(arguments, "tongues", {method});
  const SceneRows lines = scene_rows(arguments, scene.scene, line, {line.parameter});
  if (arguments.dry_run) {
    print_plan(scene,
               {"along: " + text_of(line), fmt::format("lines: {}", lines.scenes.size()),
                "method: " + std::string(to_string(method)), "tolerance: " + to_text(options.tolerance),
                fmt::format("threads: {}", thread_count(parallel))});
    return ExitCode::done;
  }
  install_signal_handlers();
  std::vector<std::vector<TongueEdge>> edges(lines.scenes.size());
  parallel_for(edges.size(), parallel,
               [&](std::size_t i, int) { edges[i] = tongues(lines.scenes[i], line, options); });
  throw_if_interrupted();
  const bool crossing = any_edge(edges, [](const TongueEdge& e) { return e.crossing > 0; });
  const Extras extras{
      .mechanism = scene.scene.linear.has_value(), .growth = arguments.growth, .crossing = crossing};
  RowWriter writer(row_path(arguments), arguments.json, columns_of(scene.scene, line, lines, extras),
                   provenance_of(arguments, scene, method, options.tolerance));
  for (std::size_t i = 0; i < edges.size(); ++i)
    for (const TongueEdge& edge : edges[i]) writer.write(cells_of(lines.rows[i], edge, extras));
  writer.commit();
  const bool missed = any_edge(edges, [](const TongueEdge& e) { return e.outcome != Outcome::converged; });
  return missed ? ExitCode::unresolved : ExitCode::done;
}

}  // namespace strutt::app
