#pragma once

#include "arguments.hpp"

namespace strutt::app {

/// Throws UsageError for everything that is not as --help says.
Arguments parse_command_line(int argc, const char* const* argv);

}  // namespace strutt::app
