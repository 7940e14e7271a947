#include "strutt/io/scene_file.hpp"

#include "io/scene_reader.hpp"
#include "io/text.hpp"
#include "strutt/base/error.hpp"

namespace strutt {
namespace {

/// Says where the value stands that `validate` complains about: its message begins with the path of the
/// value.
[[noreturn]] void fail_located(const TomlDocument& document, const std::string& message) {
  const toml::source_region* best = &document.root().source();
  std::size_t length = 0;
  for (const auto& [path, where] : document.places()) {
    if (path.size() > length && message.starts_with(path)) {
      best = &where;
      length = path.size();
    }
  }
  document.fail(*best, message);
}

/// Values that are each in their range can still make no equation together: a length of 1e-300 m, a frequency
/// of 1e-300 rad/s. The table that they stand in is named.
void check_equation(const TomlDocument& document, const Scene& scene) {
  const auto check = [&](const std::string& table, const auto& make) {
    try {
      make();
    } catch (const InvalidInput& error) {
      document.fail(*document.root().get(table), "[" + table + "]: " + error.what());
    }
  };
  if (scene.pendulum) check("pendulum", [&] { pendulum(scene).validate(); });
  const char* pendulum_table = scene.support ? "support" : "pendulum";
  check(scene.mathieu  ? "mathieu"
        : scene.hill   ? "hill"
        : scene.linear ? "linear"
                       : pendulum_table,
        [&] { (void)linear_model(scene); });
}

}  // namespace

SceneFile parse_scene(std::string_view text, const std::string& name) {
  const TomlDocument document(text, name);
  const auto directory = std::filesystem::path(name).parent_path();
  SceneFile result{
      .file = name, .scene = read_scene_tables(document, directory.empty() ? "." : directory), .chart = {}};
  try {
    validate(result.scene);
  } catch (const FileError&) {
    throw;
  } catch (const InvalidInput& error) {
    fail_located(document, error.what());
  }
  check_equation(document, result.scene);
  if (const auto* chart = document.root().get("chart")) {
    result.chart = read_chart_table(document, *chart, result.scene);
  }
  return result;
}

SceneFile read_scene(const std::filesystem::path& path) {
  const std::string name = path == "-" ? "standard input" : path.string();
  return parse_scene(read_file(path, kLargestScene), name);
}

}  // namespace strutt
