#include "command_line.hpp"

#include <CLI/CLI.hpp>  // slow to compile: the only file that includes it
#include <algorithm>
#include <functional>

#include "exit_code.hpp"
#include "help_texts.hpp"
#include "recorded_command.hpp"
#include "strutt/io/provenance.hpp"
#include "unknown_words.hpp"

namespace strutt::app {
namespace {

/// A flag with a value.
template <typename Value>
CLI::Option* add(CLI::App& command, const char* flag, Value& value, const char* text, const char* type) {
  return command.add_option(flag, value, text)->type_name(type);
}

/// The flags of every command, with or without a scene.
void add_output(CLI::App& command, CommonArguments& arguments) {
  command.add_option("--threads", arguments.threads, "number of threads (default: all)")->type_name("N");
  command.add_option("-o,--output", arguments.output, "where the data go; - or nothing: standard output")
      ->type_name("FILE");
  command.add_flag("--json", arguments.json, "write JSON instead of CSV");
  command.add_flag("--quiet", arguments.quiet, "no progress, summary and warnings");
  command.add_flag("--force", arguments.force, "lift the memory budget (half of the RAM)");
  command.add_flag("--dry-run", arguments.dry_run,
                   "print the effective scene, the model and the plan, and stop");
  command.set_help_flag("-h,--help", "print this help and exit");
  command.set_version_flag("--version", "strutt " + version_text(), "print the version and exit");
  command.allow_extras();  // told apart afterwards, with a suggestion
}

void add_set(CLI::App& command, CommonArguments& arguments) {
  command
      .add_option("--set", arguments.set,
                  "change a parameter of the scene; the value may have a unit; repeatable")
      ->type_name("PATH=VALUE")
      ->allow_extra_args(false);
}

void add_scene(CLI::App& command, CommonArguments& arguments) {
  command.add_option("scene", arguments.scene, "scene file (TOML), - for standard input")
      ->required()
      ->type_name("SCENE");
}

void add_common(CLI::App& command, CommonArguments& arguments, const std::string& tolerance,
                const std::string& methods, const std::string& range = "1e-13 to 1e-2 (default 1e-9)") {
  command.add_option("--tolerance", arguments.tolerance, tolerance + ", " + range)->type_name("T");
  command.add_option("--method", arguments.method, "auto (default), " + methods)->type_name("M");
  add_set(command, arguments);
  add_output(command, arguments);
}

CLI::App* add_chart(CLI::App& app, ChartArguments& arguments) {
  auto* command = app.add_subcommand("chart", "stability chart over two parameters of a scene");
  add_scene(*command, arguments);
  add_common(*command, arguments, "largest error of trace and M",
             "surrogate, propagator, cvode, arkode, exact");
  add(*command, "--x", arguments.x,
      "horizontal axis: parameter path, ends, number of points, :log for a log axis", "P=FROM:TO:N[:log]");
  add(*command, "--y", arguments.y, "vertical axis", "P=FROM:TO:N[:log]");
  add(*command, "--layers", arguments.layers,
      "of verdict,growth,winding,discriminant,margin,outcome (default verdict,growth)", "A,B");
  add(*command, "--figure", arguments.figure, "draw the chart as .png, .svg or .pdf", "FILE");
  command->footer(
      std::string(
          "The ending of -o FILE tells the format: .csv, .npy (one layer), .npz, .h5; .json with --json.\n") +
      kChartExample + kExitCodes);
  return command;
}

CLI::App* add_stability(CLI::App& app, StabilityArguments& arguments) {
  auto* command = app.add_subcommand("stability", "verdict, growth, monodromy matrix of one point or many");
  add_scene(*command, arguments);
  add_common(*command, arguments, "largest error of trace and M", "propagator, cvode, arkode, exact");
  add(*command, "--points", arguments.points, "CSV file whose header names parameters: one result per row",
      "IN.csv");
  command->footer(std::string(kStabilityExample) + kExitCodes);
  return command;
}

CLI::App* add_motion(CLI::App& app, MotionArguments& arguments) {
  auto* command = app.add_subcommand("motion", "time series of the pendulum of a scene");
  add_scene(*command, arguments);
  add_common(*command, arguments, "largest error of the angle, rad", "exact, arkode, cvode");
  command->add_option("--angle", arguments.angle, "angle at t = 0 from the hanging position")
      ->required()
      ->type_name("RAD");
  command->add_option("--velocity", arguments.velocity, "angular velocity at t = 0")
      ->required()
      ->type_name("RAD_PER_S");
  add(*command, "--duration", arguments.duration, "last time, with --samples", "S");
  add(*command, "--samples", arguments.samples, "number of times from 0 to the duration, both included", "N");
  add(*command, "--times", arguments.times, "CSV file with a column t (s), any order", "IN.csv");
  command->add_flag("--linear", arguments.linear, "the linearised equation");
  command->footer(std::string(kMotionExample) + kExitCodes);
  return command;
}

CLI::App* add_portrait(CLI::App& app, PortraitArguments& arguments) {
  auto* command =
      app.add_subcommand("portrait", "phase portrait of a pendulum; sections of it if it is excited");
  add(*command, "scene", arguments.scene,
      "scene file (TOML), - for standard input; without one: the free pendulum with alpha = 1", "SCENE");
  add(*command, "--method", arguments.method, "auto (default), cvode, arkode, exact", "M");
  add_set(*command, arguments);
  add_output(*command, arguments);
  add(*command, "--tolerance", arguments.tolerance, "refused", "T")->group("");
  add(*command, "--cells", arguments.cells, "width of the window in periods of 2 pi (default 3; excited: 1)",
      "N");
  add(*command, "--curves", arguments.curves,
      "number of librations (default 7); excited: of starts (default 60)", "N");
  add(*command, "--points", arguments.points, "free: points of a closed curve (default 201)", "N");
  add(*command, "--amplitudes", arguments.amplitudes, "free: amplitudes of the librations", "RAD,...");
  add(*command, "--excesses", arguments.excesses, "free: further levels C1 - 2, < 0 libration, > 0 rotation",
      "E,...");
  add(*command, "--sections", arguments.sections, "excited: sections of every start (default 300)", "N");
  add(*command, "--starts", arguments.starts, "excited: CSV file with the columns angle, velocity", "IN.csv");
  add(*command, "--figure", arguments.figure, "draw the portrait as .png, .svg or .pdf", "FILE");
  command->footer(
      std::string(
          "The ending of -o FILE tells the format: .csv, .npz, .h5; .json with --json.\n"
          "Excited means: the scene has [support], [moment] or damping. The sections are one period of the\n"
          "excitation apart; a curve ends where the error bound of its angle exceeds 1e-6 rad (exit code "
          "1).\n") +
      kPortraitExample + kExitCodes);
  return command;
}

CLI::App* add_normal_form(CLI::App& app, NormalFormArguments& arguments) {
  auto* command = app.add_subcommand("normal-form", "third-order normal form of planar centres");
  command
      ->add_option(
          "--points", arguments.points,
          "CSV file with the column alpha and any of f1_20, f1_11, f1_02, f1_30, f1_21, f1_12, f1_03, "
          "f2_20, ..., f2_03 (no factorials; a missing one is 0): one result per row")
      ->required()
      ->type_name("IN.csv");
  command->add_option("--tolerance", arguments.tolerance)->group("");  // refused with its reason
  add_output(*command, arguments);
  command->footer(std::string(kNormalFormExample) + kExitCodes);
  return command;
}

CLI::App* add_characteristic(CLI::App& app, CharacteristicArguments& arguments) {
  auto* command = app.add_subcommand("characteristic", "characteristic values of Mathieu's equation");
  command->add_option("--order", arguments.order, "orders n of a_n, b_n, 0 <= A <= B <= 10000")
      ->required()
      ->type_name("A:B");
  command->add_option("--q", arguments.q, "parameters of x'' + (a - 2 q cos 2t) x = 0, -1e8 to 1e8")
      ->required()
      ->type_name("Q[,Q...]");
  add(*command, "--method", arguments.method, "auto (default), fourier", "M");
  command->add_option("--tolerance", arguments.tolerance)->group("");  // refused with its reason
  add_output(*command, arguments);
  command->footer(std::string(kCharacteristicExample) + kExitCodes);
  return command;
}

CLI::App* add_tongues(CLI::App& app, TonguesArguments& arguments) {
  auto* command = app.add_subcommand("tongues", "all tongues on a line: edges, index, width");
  add_scene(*command, arguments);
  add_common(*command, arguments, "largest error of a position relative to max(1, |position|)",
             "fourier, exact (square waves) or propagator (damping, [linear]): whichever fits",
             "1e-13 to 1e-2 (default 1e-12)");
  command->add_option("--along", arguments.along, "the parameter that changes, and its range")
      ->required()
      ->type_name("P=FROM:TO");
  add(*command, "--at", arguments.at, "CSV file whose header names further parameters: a line per row",
      "IN.csv");
  add(*command, "--count", arguments.count, "tongues n = 0 ... N - 1 (default: all on the line)", "N");
  command->add_flag("--growth", arguments.growth,
                    "add the largest growth per period between both edges, and where");
  add(*command, "--over", arguments.over, "a second parameter and its range: the edges as curves",
      "Q=FROM:TO");
  add(*command, "--chord", arguments.chord,
      "with --over: largest distance of a curve from the line between its points, as part of the "
      "window, 1e-6 to 0.1 (default 1e-3)",
      "C");
  add(*command, "--figure", arguments.figure, "with --over: draw the curves as .png, .svg or .pdf", "FILE");
  command->footer(std::string(kTonguesExample) + kExitCodes);
  return command;
}

CLI::App* add_margin(CLI::App& app, MarginArguments& arguments) {
  auto* command = app.add_subcommand("margin", "distance from a design to the nearest edges of stability");
  add_scene(*command, arguments);
  add_common(*command, arguments, "largest error of an edge relative to max(1, |edge|)", "no other",
             "1e-13 to 1e-2 (default 1e-12)");
  add(*command, "--parameters", arguments.parameters,
      "parameters that change, one by one and jointly (default: all that move the stability)", "P,Q,...");
  add(*command, "--bands", arguments.bands, "instead: the stable and unstable bands of one parameter",
      "P=FROM:TO");
  add(*command, "--closing-damping", arguments.closing_damping,
      "instead: the damping that closes each tongue on a line, whatever the scene's", "P=FROM:TO");
  add(*command, "--count", arguments.count, "with --closing-damping: tongues n = 1 ... N - 1 only", "N");
  add(*command, "--box", arguments.box,
      "instead: the worst growth per period over uncertain parameters (--tolerance: of it, default 1e-3)",
      "P=FROM:TO,...");
  command->add_flag("--sensitivities", arguments.sensitivities,
                    "instead: derivatives of growth, winding and margin with respect to the parameters");
  add(*command, "--edge", arguments.edge, "with --sensitivities: those of the nearest edge along P too", "P");
  command->footer(std::string(kMarginExample) + kExitCodes);
  return command;
}

CLI::App* add_period(CLI::App& app, PeriodArguments& arguments) {
  auto* command = app.add_subcommand("period", "period of the free pendulum at an amplitude");
  add(*command, "--scene", arguments.scene, "scene whose pendulum gives alpha (default: alpha = 1)", "SCENE");
  add_common(*command, arguments, "largest relative error of the period", "exact",
             "5e-16 to 1e-1 (default 1e-15)");
  add(*command, "--amplitude", arguments.amplitude, "largest angle, 0 to 3.141592653589793", "RAD");
  add(*command, "--from-top", arguments.from_top, "pi - amplitude, 0 to pi", "RAD");
  add(*command, "--separatrix-excess", arguments.separatrix_excess,
      "(velocity/alpha)^2 - 4 cos^2(angle/2), >= -4: negative librations, positive rotations", "E");
  add(*command, "--points", arguments.points,
      "CSV file with a column amplitude, from_top or separatrix_excess, and alpha if wanted", "IN.csv");
  command->add_flag("--compare", arguments.compare,
                    "add T/T0 by the normal form and by Krylov's technique, each with its true error");
  add(*command, "--figure", arguments.figure,
      "with --points and --compare: draw periods and errors as .png, .svg or .pdf", "FILE");
  command->footer(std::string(kPeriodExample) + kExitCodes);
  return command;
}

CLI::App* add_tradeoff(CLI::App& app, TradeoffArguments& arguments) {
  auto* command =
      app.add_subcommand("tradeoff", "speed and accuracy of every method that fits a scene, measured");
  add_scene(*command, arguments);
  add_common(*command, arguments, "measure at this one only",
             "propagator, cvode, arkode, exact: this one only", "1e-13 to 1e-2 (default: every decade)");
  add(*command, "--samples", arguments.samples,
      "points scattered over the box of [chart] (default 64); 0, or no box: the scene as it stands", "N");
  add(*command, "--figure", arguments.figure, "draw speed over accuracy as .png, .svg or .pdf", "FILE");
  command->footer(std::string("Exit code 1: a result is further from the truth than its error bound.\n") +
                  kTradeoffExample + kExitCodes);
  return command;
}

std::vector<std::string> command_names(const CLI::App& app) {
  std::vector<std::string> names;
  for (const auto* command : app.get_subcommands([](const CLI::App*) { return true; }))
    names.push_back(command->get_name());
  return names;
}

std::vector<std::string> flag_names(const CLI::App& command) {
  std::vector<std::string> names;
  for (const auto* option : command.get_options()) {
    for (const auto& name : option->get_lnames()) names.push_back("--" + name);
  }
  return names;
}

[[noreturn]] void refuse_extras(const CLI::App& command, const std::vector<std::string>& extras) {
  refuse_words(extras, command.get_name(), flag_names(command));
}

/// A command: what parses it, and what it was told.
struct Command {
  const CLI::App* parser;
  CommonArguments* common;
  std::function<Arguments()> arguments;
};

template <typename Told>
Command command(CLI::App* (*add)(CLI::App&, Told&), CLI::App& app, Told& told) {
  return {add(app, told), &told, [&told] { return Arguments(told); }};
}

}  // namespace

Arguments parse_command_line(int argc, const char* const* argv) {
  CLI::App app("Stability of linear systems with periodic coefficients, and charts of it.", "strutt");
  app.set_help_flag("-h,--help", "print this help and exit");
  app.set_version_flag("--version", "strutt " + version_text(), "print the version and exit");
  app.footer(std::string("strutt COMMAND --help tells more about each.\n") + kExitCodes);
  app.allow_extras();
  ChartArguments chart;
  StabilityArguments stability;
  MotionArguments motion;
  PeriodArguments period;
  PortraitArguments portrait;
  NormalFormArguments normal_form;
  TradeoffArguments tradeoff;
  CharacteristicArguments characteristic;
  TonguesArguments tongues;
  MarginArguments margin;
  const std::vector<Command> commands{command(add_chart, app, chart),
                                      command(add_stability, app, stability),
                                      command(add_motion, app, motion),
                                      command(add_period, app, period),
                                      command(add_portrait, app, portrait),
                                      command(add_normal_form, app, normal_form),
                                      command(add_characteristic, app, characteristic),
                                      command(add_tongues, app, tongues),
                                      command(add_margin, app, margin),
                                      command(add_tradeoff, app, tradeoff)};

  const auto chosen = [&]() -> const CLI::App* {
    const auto parsed = app.get_subcommands();
    return parsed.empty() ? nullptr : parsed.front();
  };
  try {
    app.parse(argc, argv);
  } catch (const CLI::CallForHelp&) {
    return Information{app.help()};
  } catch (const CLI::CallForVersion& version) {
    return Information{std::string(version.what()) + "\n"};
  } catch (const CLI::ParseError& error) {
    // A misspelt flag often is why a required one seems to be missing.
    if (chosen() != nullptr && !chosen()->remaining().empty())
      refuse_extras(*chosen(), chosen()->remaining());
    throw UsageError(error.what());
  }
  if (chosen() == nullptr) refuse_command(app.remaining(), command_names(app));
  const auto extras = app.remaining(true);
  if (!extras.empty()) refuse_extras(*chosen(), extras);
  const auto found = std::find_if(commands.begin(), commands.end(),
                                  [&](const Command& known) { return known.parser == chosen(); });
  found->common->command = recorded_command(argc, argv);
  return found->arguments();
}

}  // namespace strutt::app
