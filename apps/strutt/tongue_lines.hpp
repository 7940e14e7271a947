#pragma once

#include <string>
#include <vector>

#include "arguments.hpp"
#include "exit_code.hpp"
#include "rows.hpp"
#include "strutt/chart/tongues.hpp"
#include "strutt/io/scene_file.hpp"

namespace strutt::app {

/// The line of --along, checked against the scene. Throws FileError for a scene that has tongues on no line,
/// UsageError for a line that does not fit, or a --count where tongues have no index.
TongueLine usable_line(const TonguesArguments& arguments, const SceneFile& file);

/// The scene for every row of the table --at, or the scene alone.
struct SceneRows {
  std::vector<std::string> columns;
  std::vector<std::vector<double>> rows{{}};
  std::vector<Scene> scenes;
};

/// Throws FileError for rows with which the line does not fit. `taken`: parameters that --at cannot have.
SceneRows scene_rows(const TonguesArguments& arguments, const Scene& scene, const TongueLine& line,
                     const std::vector<std::string>& taken);

/// --over: edge curves instead of rows for each edge; the scene and --along have been checked.
ExitCode run_tongue_curves(const TonguesArguments& arguments, const SceneFile& scene,
                           const TongueLine& along);

}  // namespace strutt::app
