#include "command_line.hpp"
#include "commands.hpp"
#include "signals.hpp"
#include "strutt/base/floating_point.hpp"
#include "terminal.hpp"

namespace strutt::app {

ExitCode run(const Information& information) {
  print_text(information.text);
  return ExitCode::done;
}

}  // namespace strutt::app

int main(int argc, char** argv) {
  using namespace strutt::app;
  const strutt::DefaultFloatingPoint environment;
  try {
    prepare_process();
    const Arguments arguments = parse_command_line(argc, argv);
    return static_cast<int>(std::visit([](const auto& chosen) { return run(chosen); }, arguments));
  } catch (...) {
    return report_current_exception();
  }
}
