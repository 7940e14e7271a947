#pragma once

#include <string>
#include <vector>

#include "arguments.hpp"
#include "exit_code.hpp"
#include "strutt/model/scene.hpp"

/// What `strutt margin` answers instead of the distances.
namespace strutt::app {

/// Throws UsageError if more than one question is asked, or a flag goes without its question.
void require_one_question(const MarginArguments& arguments);

ExitCode run_bands(const MarginArguments& arguments);
ExitCode run_closing_damping(const MarginArguments& arguments);
ExitCode run_box(const MarginArguments& arguments);
ExitCode run_sensitivities(const MarginArguments& arguments);

/// --parameters, or all that move the stability. Throws UsageError.
std::vector<std::string> parameters_of(const MarginArguments& arguments, const Scene& scene);

}  // namespace strutt::app
