#include "strutt/integrate/motion.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "commands.hpp"
#include "rows.hpp"
#include "scene_arguments.hpp"
#include "signals.hpp"
#include "strutt/base/error.hpp"
#include "strutt/free_pendulum/free_motion.hpp"
#include "terminal.hpp"

namespace strutt::app {
namespace {

// Of a sample while it is computed and written: the time, its order, the point.
constexpr double kBytesPerSample = sizeof(MotionPoint) + 4 * sizeof(double);

void check_flags(const MotionArguments& arguments) {
  const bool sampled = arguments.duration || arguments.samples;
  if (arguments.times && sampled) throw UsageError("--times excludes --duration and --samples");
  if (arguments.times) return;
  if (!arguments.duration || !arguments.samples)
    throw UsageError("wanted are --duration and --samples, or --times");
}

/// The times of --duration and --samples, as an axis.
Axis time_axis(const MotionArguments& arguments) {
  Axis axis{.parameter = "t", .from = 0.0, .to = quantity_of("--duration", *arguments.duration, "s")};
  if (!(axis.to >= 0.0)) throw UsageError("--duration = '" + *arguments.duration + "' is not a time >= 0");
  constexpr std::uint64_t kMost = std::uint64_t{1} << 53;
  axis.points = count_of("--samples", *arguments.samples, 1, kMost);
  if (axis.points == 1 && axis.to > 0.0) throw UsageError("--samples = 1 goes with --duration 0 only");
  if (axis.points > 1 && axis.to == 0.0) throw UsageError("--duration = 0 goes with --samples 1 only");
  return axis;
}

std::vector<double> times_of(const std::string& path) {
  const NumericTable table = read_table(path, {.required = {"t"}, .optional = {}, .units = {{"t", "s"}}});
  std::vector<double> times;
  for (std::size_t i = 0; i < table.rows.size(); ++i) {
    times.push_back(table.rows[i][0]);
    if (!(times.back() >= 0.0)) {
      throw table.error_at(i, 0, "t = " + to_text(times.back()) + " is not allowed: it must be >= 0");
    }
  }
  return times;
}

std::vector<double> times_of(const MotionArguments& arguments) {
  if (arguments.times) return times_of(*arguments.times);
  const Axis axis = time_axis(arguments);
  require_memory(arguments, kBytesPerSample * static_cast<double>(axis.points));
  std::vector<double> times(arguments.dry_run ? 0 : axis.points);
  for (std::size_t i = 0; i < times.size(); ++i) times[i] = axis.value(i);
  return times;
}

/// The method that auto stands for; throws UsageError if the one asked for does not fit.
Method chosen_method(Method asked, const Scene& scene, bool linear) {
  const bool free = !linear && is_free(scene);
  if (asked == Method::exact && !free) {
    throw UsageError(
        "--method exact needs a free pendulum (no [support], [moment], damping, --linear); available are "
        "auto, "
        "cvode, arkode");
  }
  return asked == Method::automatic && free ? Method::exact : asked;
}

Motion compute(const Scene& scene, const MotionStart& start, const std::vector<double>& times,
               const MotionOptions& options) {
  if (options.method == Method::exact)
    return free_motion(eigenfrequency(*scene.pendulum), start, times, options.tolerance, options.cancel);
  const auto support_motion = support(scene);
  const auto driving_moment = moment(scene);
  return integrate_motion(pendulum(scene), support_motion ? &*support_motion : nullptr,
                          driving_moment ? &*driving_moment : nullptr, start, times, options);
}

ExitCode write_rows(RowWriter& writer, const Motion& motion) {
  ExitCode code = ExitCode::done;
  std::vector<Cell> row;
  for (const MotionPoint& point : motion.points) {
    if (point.outcome != Outcome::converged) code = ExitCode::unresolved;
    row = {point.t,      point.angle, point.velocity,
           point.energy, point.error, std::string(to_string(point.outcome))};
    writer.write(row);
  }
  throw_if_interrupted();
  writer.commit();
  return code;
}

void summarise(const MotionArguments& arguments, const Motion& motion, double seconds) {
  if (arguments.quiet) return;
  const auto failed = std::count_if(motion.points.begin(), motion.points.end(),
                                    [](const auto& point) { return point.outcome != Outcome::converged; });
  print_note(fmt::format("{} times, {} steps ({}) in {:.2g} s, {} not converged", motion.points.size(),
                         motion.cost.steps, to_string(motion.method), seconds, failed));
}

}  // namespace

ExitCode run(const MotionArguments& arguments) {
  check_flags(arguments);
  require_one_standard_input(arguments, "--times", arguments.times);
  MotionOptions options{
      .tolerance = tolerance_of(arguments),
      .method = method_of(arguments, "motion", {Method::arkode, Method::cvode, Method::exact}),
      .linear = arguments.linear,
      .cancel = &cancel_flag()};
  threads_of(arguments);  // one motion is one thread; a wrong value is an error all the same
  const MotionStart start{quantity_of("--angle", arguments.angle, "rad"),
                          quantity_of("--velocity", arguments.velocity, "rad/s")};
  const SceneFile scene = load_scene(arguments);
  if (!scene.scene.pendulum) throw FileError(scene.file, 0, 0, "motion needs a scene with [pendulum]");
  options.about = scene.scene.pendulum->about;
  options.method = chosen_method(options.method, scene.scene, options.linear);
  const std::vector<double> times = times_of(arguments);
  if (arguments.dry_run) {
    print_plan(scene,
               {"times: " + (arguments.times ? std::to_string(times.size()) : *arguments.samples),
                "method: " + std::string(to_string(options.method)),
                "tolerance: " + to_text(options.tolerance), "threads: 1",
                options.method == Method::exact ? "steps: none, closed form"
                                                : fmt::format("steps: at most {}", options.max_steps)});
    return ExitCode::done;
  }
  if (arguments.linear) warn_about(arguments, scene.scene);

  install_signal_handlers();
  const Progress clock(false, "rows");
  RowWriter writer(row_path(arguments), arguments.json,
                   {{"t", "s"},
                    {"angle", "rad"},
                    {"velocity", "rad/s"},
                    {"energy", "1"},
                    {"error", "rad"},
                    {"outcome", ""}},
                   provenance_of(arguments, scene, options.method, options.tolerance));
  const Motion motion = compute(scene.scene, start, times, options);
  throw_if_interrupted();
  const ExitCode code = write_rows(writer, motion);
  summarise(arguments, motion, clock.seconds());
  return code;
}

}  // namespace strutt::app
