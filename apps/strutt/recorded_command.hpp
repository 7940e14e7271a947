#pragma once

#include <string>

namespace strutt::app {

/// The command as recorded in files: the same for any number of threads and any place of the result.
std::string recorded_command(int argc, const char* const* argv);

}  // namespace strutt::app
