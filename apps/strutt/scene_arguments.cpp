#include "scene_arguments.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>

#include "exit_code.hpp"
#include "strutt/base/error.hpp"
#include "strutt/chart/stability_chart.hpp"
#include "terminal.hpp"

namespace strutt::app {
namespace {

/// Runs `body`, whose complaints are about a flag.
template <typename Body>
auto about_flag(const std::string& flag, const Body& body) {
  try {
    return body();
  } catch (const InvalidInput& error) {
    throw UsageError(flag + ": " + error.what());
  }
}

void apply_set(Scene& scene, const std::string& text) {
  const auto equals = text.find('=');
  if (equals == std::string::npos) throw UsageError("--set " + text + ": wanted is PATH=VALUE");
  const std::string path = text.substr(0, equals);
  about_flag("--set " + text, [&] {
    parameter(scene, path) = parse_quantity(text.substr(equals + 1), parameter_info(scene, path).unit);
  });
}

}  // namespace

std::vector<std::string> split(const std::string& text, char separator) {
  std::vector<std::string> parts;
  for (std::size_t begin = 0;;) {
    const auto end = text.find(separator, begin);
    parts.push_back(text.substr(begin, end == std::string::npos ? end : end - begin));
    if (end == std::string::npos) return parts;
    begin = end + 1;
  }
}

SceneFile load_scene(const CommonArguments& arguments) {
  SceneFile file = read_scene(arguments.scene);
  if (arguments.set.empty()) return file;
  for (const auto& text : arguments.set) apply_set(file.scene, text);
  about_flag("--set", [&] {
    validate(file.scene);
    (void)linear_model(file.scene);
  });
  return file;
}

void require_one_standard_input(const CommonArguments& arguments, const std::string& flag,
                                const std::optional<std::string>& table) {
  if (arguments.scene == "-" && table == "-")
    throw UsageError("the scene and " + flag + " cannot both be standard input");
}

TongueLine line_of(const std::string& flag, const std::string& text, const Scene& scene) {
  const auto equals = text.find('=');
  const auto ends = split(equals == std::string::npos ? "" : text.substr(equals + 1), ':');
  if (ends.size() != 2) throw UsageError(flag + " '" + text + "': wanted is P=FROM:TO");
  TongueLine line{.parameter = text.substr(0, equals)};
  try {
    const std::string unit = parameter_info(scene, line.parameter).unit;
    line.from = quantity_of(flag, ends[0], unit);
    line.to = quantity_of(flag, ends[1], unit);
  } catch (const InvalidInput& error) {
    throw UsageError(flag + " '" + text + "': " + error.what());
  }
  return line;
}

std::string text_of(const TongueLine& line) {
  return line.parameter + " from " + to_text(line.from) + " to " + to_text(line.to);
}

std::string column_unit(const Scene& scene, const std::string& path) {
  const std::string unit = parameter_info(scene, path).unit;
  return unit.empty() ? "1" : unit;
}

void require_two_files(const std::optional<std::string>& output, const std::optional<std::string>& figure) {
  if (figure && figure == output) throw UsageError("-o and --figure name the same file");
}

double quantity_of(const std::string& flag, const std::string& text, const std::string& dimension) {
  return about_flag(flag, [&] { return parse_quantity(text, dimension); });
}

std::uint64_t count_of(const std::string& flag, const std::string& text, std::uint64_t least,
                       std::uint64_t most) {
  std::uint64_t value = 0;
  const char* const end = text.data() + text.size();
  const auto [stop, error] = std::from_chars(text.data(), end, value);
  if (error != std::errc{} || stop != end || value < least || value > most) {
    throw UsageError(fmt::format("{} = '{}' is not a whole number from {} to {}", flag, text, least, most));
  }
  return value;
}

double tolerance_of(const CommonArguments& arguments, double otherwise, const ToleranceRange& range) {
  if (!arguments.tolerance) return otherwise;
  double value = 0.0;
  if (!parse_number(*arguments.tolerance, value) || !(value >= range.least && value <= range.most)) {
    throw UsageError(fmt::format("--tolerance = '{}' is not a number from {} to {}", *arguments.tolerance,
                                 to_text(range.least), to_text(range.most)));
  }
  return value;
}

Method method_of(const CommonArguments& arguments, const std::string& command,
                 const std::vector<Method>& available) {
  if (!arguments.method) return Method::automatic;
  const Method method = about_flag("--method", [&] { return method_from_string(*arguments.method); });
  if (method == Method::automatic) return method;
  if (std::find(available.begin(), available.end(), method) != available.end()) return method;
  std::string names = "auto";
  for (const Method other : available) names += ", " + std::string(to_string(other));
  throw UsageError("--method " + *arguments.method + " is not available for " + command + "; available are " +
                   names);
}

int threads_of(const CommonArguments& arguments) {
  constexpr std::uint64_t kMost = 1024;
  return arguments.threads ? static_cast<int>(count_of("--threads", *arguments.threads, 1, kMost)) : 0;
}

Axis axis_of(const std::string& flag, const std::string& text, const Scene& scene) {
  constexpr std::uint64_t kMost = std::uint64_t{1} << 53;
  const std::string wanted = flag + " " + text + ": wanted is P=FROM:TO:N or P=FROM:TO:N:log";
  const auto equals = text.find('=');
  if (equals == std::string::npos) throw UsageError(wanted);
  const auto parts = split(text.substr(equals + 1), ':');
  const bool scaled = parts.size() == 4 && (parts[3] == "log" || parts[3] == "linear");
  if (parts.size() != 3 && !scaled) throw UsageError(wanted);
  Axis axis;
  axis.parameter = text.substr(0, equals);
  return about_flag(flag, [&] {
    const std::string unit = parameter_info(scene, axis.parameter).unit;
    axis.from = parse_quantity(parts[0], unit);
    axis.to = parse_quantity(parts[1], unit);
    axis.points = count_of(flag + ": the number of points", parts[2], 1, kMost);
    if (scaled && parts[3] == "log") axis.scale = AxisScale::logarithmic;
    axis.validate(flag.substr(flag.find_first_not_of('-')));
    return axis;
  });
}

std::filesystem::path data_path(const CommonArguments& arguments) {
  return arguments.output && !arguments.output->empty() ? *arguments.output : "-";
}

std::filesystem::path json_path(const CommonArguments& arguments) {
  const auto path = data_path(arguments);
  const bool text = path == "-" || path.extension() == ".json" || path.string().starts_with("/dev/");
  if (!text) throw UsageError("--json writes JSON: -o '" + path.string() + "' must end in .json");
  return path;
}

std::filesystem::path row_path(const CommonArguments& arguments) {
  const auto path = data_path(arguments);
  const std::string ending = path.extension().string();
  for (const std::string_view other : {".npy", ".npz", ".h5", ".hdf5", ".png", ".svg", ".pdf"}) {
    if (ending == other)
      throw UsageError("-o '" + path.string() + "': this command writes CSV, or JSON with --json");
  }
  if (arguments.json && ending == ".csv")
    throw UsageError("--json does not write CSV: -o '" + path.string() + "'");
  if (!arguments.json && ending == ".json") throw UsageError("-o '" + path.string() + "' goes with --json");
  return path;
}

Provenance provenance_of(const CommonArguments& arguments, const SceneFile& scene, Method method,
                         double tolerance) {
  Provenance provenance = make_provenance(arguments.command);
  provenance.emplace_back("model", describe(scene.scene));
  provenance.emplace_back("method", to_string(method));
  provenance.emplace_back("tolerance", to_text(tolerance));
  provenance.emplace_back("scene", to_toml(scene));
  return provenance;
}

void warn_about(const CommonArguments& arguments, const Scene& scene) {
  if (arguments.quiet || !scene.moment || scene.moment->constant == 0.0) return;
  print_warning(
      "the scene has a constant moment: it shifts the equilibrium, but the linearisation stays at " +
      std::string(scene.pendulum && scene.pendulum->about == Equilibrium::inverted ? "pi" : "0"));
}

void require_memory(const CommonArguments& arguments, double bytes) {
  const double budget = memory_budget();
  if (arguments.force || bytes <= budget) return;
  throw MemoryBudgetExceeded(
      fmt::format("this needs {:.3g} GB of memory, the budget is {:.3g} GB; --force lifts it", bytes / 1e9,
                  budget / 1e9));
}

bool is_free(const Scene& scene) {
  return !scene.support && !scene.moment && scene.pendulum && scene.pendulum->damping == 0.0;
}

std::string point_line(const PointForecast& point) {
  std::string line(to_string(point.method));
  if (point.points == 0.0) return line;
  if (point.steps > 0.0) line += fmt::format(", order {}, {:.3g} steps", point.order, point.steps);
  if (point.right_hand_sides > 0.0) line += fmt::format(", {:.3g} evaluations", point.right_hand_sides);
  return line + fmt::format(", {:.2g} us a point", 1e6 * point.seconds);
}

void print_plan(const std::string& model, const std::vector<std::string>& lines, const SceneFile* scene) {
  std::string text = "# model: " + model + "\n";
  for (const auto& line : lines) text += "# " + line + "\n";
  if (scene != nullptr) text += "\n" + to_toml(*scene);
  print_text(text);
}

void print_plan(const SceneFile& scene, const std::vector<std::string>& lines) {
  print_plan(describe(scene.scene), lines, &scene);
}

}  // namespace strutt::app
