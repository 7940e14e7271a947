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

namespace strutt::app {
namespace {

TongueLine line_of(const std::string& text, const Scene& scene) {
  const auto equals = text.find('=');
  const auto ends = split(equals == std::string::npos ? "" : text.substr(equals + 1), ':');
  if (ends.size() != 2) throw UsageError("--along '" + text + "': wanted is P=FROM:TO");
  TongueLine line{.parameter = text.substr(0, equals)};
  try {
    const std::string unit = parameter_info(scene, line.parameter).unit;
    line.from = quantity_of("--along", ends[0], unit);
    line.to = quantity_of("--along", ends[1], unit);
  } catch (const InvalidInput& error) {
    throw UsageError("--along '" + text + "': " + error.what());
  }
  return line;
}

/// A scene that is refused on every line, however short, is a mistake of the file.
void require_scene(const TonguesArguments& arguments, const SceneFile& file, const std::string& path) {
  if (!arguments.set.empty()) return;
  try {
    const double value = parameter(file.scene, path);
    require_tongue_line(file.scene, {path, value, std::nextafter(value, HUGE_VAL)});
  } catch (const InvalidInput& error) {
    throw FileError(file.file, 0, 0, error.what());
  }
}

TongueLine usable(const TongueLine& line, const TonguesArguments& arguments, const SceneFile& file) {
  try {
    require_tongue_line(file.scene, line);
    if (arguments.count && !has_tongue_index(file.scene, line))
      throw UsageError("--count: tongues of a system with more than one degree of freedom have no index");
  } catch (const InvalidInput& error) {
    require_scene(arguments, file, line.parameter);
    throw UsageError("--along '" + arguments.along + "': " + error.what());
  }
  return line;
}

/// A line through the scene for every row of the table, or the scene alone.
struct Lines {
  std::vector<std::string> columns;
  std::vector<std::vector<double>> rows{{}};
  std::vector<Scene> scenes;
};

Lines lines_of(const TonguesArguments& arguments, const Scene& scene, const TongueLine& line) {
  if (!arguments.at) return {.columns = {}, .scenes = {scene}};
  TableSchema schema{.required = {}, .optional = parameter_paths(scene)};
  std::erase(schema.optional, line.parameter);
  for (const auto& path : schema.optional) {
    const std::string unit = parameter_info(scene, path).unit;
    if (!unit.empty()) schema.units[path] = unit;
  }
  NumericTable table = read_table(*arguments.at, schema);
  Lines lines{.columns = table.columns, .rows = table.rows, .scenes = {}};
  for (std::size_t i = 0; i < table.rows.size(); ++i) {
    Scene changed = scene;
    for (std::size_t j = 0; j < table.columns.size(); ++j)
      parameter(changed, table.columns[j]) = table.rows[i][j];
    try {
      require_tongue_line(changed, line);
    } catch (const InvalidInput& error) {
      throw table.error_at(i, 0, error.what());
    }
    lines.scenes.push_back(std::move(changed));
  }
  return lines;
}

/// Columns that are there only if asked for, or needed.
struct Extras {
  bool mechanism = false;
  bool growth = false;
  bool crossing = false;
};

std::vector<Column> columns_of(const Scene& scene, const TongueLine& line, const Lines& lines,
                               const Extras& extras) {
  const auto unit = [&](const std::string& path) {
    const std::string text = parameter_info(scene, path).unit;
    return text.empty() ? "1" : text;
  };
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
  const auto number = [](double x) { return std::isnan(x) ? Cell() : Cell(x); };
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
  const TongueLine line = usable(line_of(arguments.along, scene.scene), arguments, scene);
  const Method method = tongue_method(scene.scene, line);
  method_of(arguments, "tongues", {method});
  const Lines lines = lines_of(arguments, scene.scene, line);
  if (arguments.dry_run) {
    print_plan(
        scene,
        {fmt::format("along: {} from {} to {}", line.parameter, to_text(line.from), to_text(line.to)),
         fmt::format("lines: {}", lines.scenes.size()), "method: " + std::string(to_string(method)),
         "tolerance: " + to_text(options.tolerance), fmt::format("threads: {}", thread_count(parallel))});
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
