#include <algorithm>

#include "io/scene_reader.hpp"
#include "io/text.hpp"
#include "strutt/base/error.hpp"

namespace strutt {
namespace {

constexpr long long kMostPoints = 1'000'000'000;

/// Runs `check` and puts the position of `node` before what it complains about.
template <typename Check>
auto located(const TomlDocument& document, const toml::node& node, const Check& check) {
  try {
    return check();
  } catch (const InvalidInput& error) {
    document.fail(node, error.what());
  }
}

/// An end of an axis must be a value that the model can have.
void check_end(const TomlTable& table, std::string_view key, const Scene& scene, const std::string& path,
               double value) {
  located(table.document(), table.require(key), [&] {
    Scene changed = scene;
    parameter(changed, path) = value;
    validate(changed);
    return true;
  });
}

Axis read_axis(const TomlTable& table, const Scene& scene, const std::string& name,
               std::size_t default_points) {
  table.allow_only({"parameter", "from", "to", "points", "scale"});
  const auto& document = table.document();
  Axis axis;
  axis.parameter = table.text("parameter");
  const std::string unit = located(document, table.require("parameter"),
                                   [&] { return parameter_info(scene, axis.parameter).unit; });
  axis.from = table.number("from", unit);
  axis.to = table.number("to", unit);
  axis.points = default_points;
  if (const auto* points = table.find("points")) {
    axis.points =
        static_cast<std::size_t>(document.integer(*points, table.path_of("points"), 1, kMostPoints));
  }
  if (table.choice("scale", {"linear", "log"}, true) == 1) axis.scale = AxisScale::logarithmic;
  located(document, table.require("from"), [&] {
    axis.validate(name);
    return true;
  });
  check_end(table, "from", scene, axis.parameter, axis.from);
  check_end(table, "to", scene, axis.parameter, axis.to);
  return axis;
}

std::vector<Layer> read_layers(const TomlTable& table) {
  const auto& document = table.document();
  const auto& list = table.require("layers");
  std::vector<Layer> result;
  for (const auto* node : read_list(document, list, table.path_of("layers"))) {
    const auto* name = node->as_string();
    if (name == nullptr) document.fail(*node, table.path_of("layers") + " must be a list of texts");
    const Layer layer = located(document, *node, [&] { return layer_from_string(printable(name->get())); });
    if (std::find(result.begin(), result.end(), layer) != result.end()) {
      document.fail(*node, table.path_of("layers") + " has '" + name->get() + "' twice");
    }
    result.push_back(layer);
  }
  if (result.empty()) document.fail(list, table.path_of("layers") + " is empty");
  return result;
}

double read_tolerance(const TomlTable& table) {
  const double tolerance = table.number("tolerance", "");
  if (tolerance >= 1e-13 && tolerance <= 1e-2) return tolerance;
  table.fail("tolerance",
             InvalidInput("chart.tolerance", to_text(tolerance), "in the range from 1e-13 to 1e-2").what());
}

}  // namespace

ChartTable read_chart_table(const TomlDocument& document, const toml::node& node, const Scene& scene) {
  const TomlTable table(document, node, "chart");
  table.allow_only({"x", "y", "layers", "tolerance"});
  ChartTable chart;
  if (table.has("x")) chart.x = read_axis({document, table.require("x"), "chart.x"}, scene, "x", 1200);
  if (table.has("y")) chart.y = read_axis({document, table.require("y"), "chart.y"}, scene, "y", 800);
  if (chart.x && chart.y && chart.x->parameter == chart.y->parameter) {
    table.fail("y", "chart.x and chart.y are the same parameter '" + chart.x->parameter + "'");
  }
  if (table.has("layers")) chart.layers = read_layers(table);
  if (table.has("tolerance")) chart.tolerance = read_tolerance(table);
  return chart;
}

}  // namespace strutt
