#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "arguments.hpp"
#include "strutt/base/method.hpp"
#include "strutt/chart/forecast.hpp"
#include "strutt/chart/tongues.hpp"
#include "strutt/io/provenance.hpp"
#include "strutt/io/scene_file.hpp"

namespace strutt::app {

/// Splits at every `separator`.
std::vector<std::string> split(const std::string& text, char separator);

/// The scene of the command line with every --set applied. Throws FileError for what is wrong in the file,
/// UsageError for what is wrong in --set.
SceneFile load_scene(const CommonArguments& arguments);

/// Throws UsageError if the scene and the table of `flag` are both to be read from standard input.
void require_one_standard_input(const CommonArguments& arguments, const std::string& flag,
                                const std::optional<std::string>& table);

/// The line of "P=FROM:TO", each end a number or a number with a unit. Throws UsageError naming the flag.
TongueLine line_of(const std::string& flag, const std::string& text, const Scene& scene);

/// As a plan says it.
std::string text_of(const TongueLine& line);

/// The unit of a column with the values of a parameter.
std::string column_unit(const Scene& scene, const std::string& path);

/// Throws UsageError if --output and --figure name the same file.
void require_two_files(const std::optional<std::string>& output, const std::optional<std::string>& figure);

/// The value of a flag, a number or a number with a unit. Throws UsageError naming the flag.
double quantity_of(const std::string& flag, const std::string& text, const std::string& dimension);

/// A whole number in [least, most], digits only. Throws UsageError naming the flag and the range.
std::uint64_t count_of(const std::string& flag, const std::string& text, std::uint64_t least,
                       std::uint64_t most);

/// The tolerances that a command takes.
struct ToleranceRange {
  double least = 1e-13;
  double most = 1e-2;
};

/// --tolerance, or `otherwise` if it was not given. Throws UsageError naming the range.
double tolerance_of(const CommonArguments& arguments, double otherwise = 1e-9,
                    const ToleranceRange& range = {});

/// --method, which must be one of `available` (besides auto). Throws UsageError naming them.
Method method_of(const CommonArguments& arguments, const std::string& command,
                 const std::vector<Method>& available);

/// --threads, 0 if it was not given.
int threads_of(const CommonArguments& arguments);

/// The axis of a flag "P=FROM:TO:N[:log]". Throws UsageError.
Axis axis_of(const std::string& flag, const std::string& text, const Scene& scene);

/// Where the data go: `-` for standard output.
std::filesystem::path data_path(const CommonArguments& arguments);

/// The same where JSON is written instead of a format that the ending tells. Throws UsageError for another
/// ending.
std::filesystem::path json_path(const CommonArguments& arguments);

/// The same for a command that writes rows, CSV or JSON. Throws UsageError for the ending of another format.
std::filesystem::path row_path(const CommonArguments& arguments);

/// Provenance with command, scene, model, method and tolerance.
Provenance provenance_of(const CommonArguments& arguments, const SceneFile& scene, Method method,
                         double tolerance);

/// Tells on standard error what a user may not expect of the scene.
void warn_about(const CommonArguments& arguments, const Scene& scene);

/// Throws MemoryBudgetExceeded if `bytes` are more than half of the memory, unless --force was given.
void require_memory(const CommonArguments& arguments, double bytes);

/// A pendulum on which nothing but gravity acts?
bool is_free(const Scene& scene);

/// --dry-run: what is expected of a point.
std::string point_line(const PointForecast& point);

/// --dry-run: the model, the lines of the plan, and the scene if there is one, on standard output.
void print_plan(const std::string& model, const std::vector<std::string>& lines,
                const SceneFile* scene = nullptr);
void print_plan(const SceneFile& scene, const std::vector<std::string>& lines);

}  // namespace strutt::app
