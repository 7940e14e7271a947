#include <fmt/format.h>

#include <algorithm>
#include <memory>

#include "commands.hpp"
#include "portrait_output.hpp"
#include "scene_arguments.hpp"
#include "signals.hpp"
#include "strutt/base/error.hpp"
#include "strutt/free_pendulum/stroboscopic_portrait.hpp"
#include "terminal.hpp"

namespace strutt::app {
namespace {

constexpr std::uint64_t kMostCells = 1000;
constexpr std::uint64_t kMostCount = 1'000'000;
constexpr int kStarts = 60;

/// Bytes of a point while it is computed and written: in its curve, in a table of five columns, in that
/// file's buffer.
constexpr double kBytesPerPoint = 3 * sizeof(PhasePoint) + 5 * 2 * sizeof(double);

/// The scene, if there is one, and what has to be computed for it.
struct Job {
  std::optional<SceneFile> scene;
  std::optional<PhysicalPendulum> pendulum;
  bool is_excited = false;
  PortraitOptions levels;            // free
  StroboscopicOptions stroboscopic;  // excited
  std::vector<MotionStart> starts;   // excited
};

int int_of(const char* flag, const std::optional<std::string>& text, int otherwise, std::uint64_t least,
           std::uint64_t most) {
  return text ? static_cast<int>(count_of(flag, *text, least, most)) : otherwise;
}

std::vector<double> list_of(const std::string& flag, const std::string& text, const std::string& unit) {
  std::vector<double> values;
  for (const auto& part : split(text, ',')) values.push_back(quantity_of(flag, part, unit));
  return values;
}

void refuse(const std::optional<std::string>& flag, const char* name, const char* why) {
  if (flag) throw UsageError(fmt::format("{} {}", name, why));
}

void check_flags(const PortraitArguments& a, bool excited) {
  refuse(a.tolerance, "--tolerance", "is not for portrait: it computes to full double precision");
  constexpr const char* free_only = "is for free pendulums; this scene has [support], [moment] or damping";
  constexpr const char* excited_only = "is for scenes with [support], [moment] or damping";
  if (excited) {
    refuse(a.points, "--points", free_only);
    refuse(a.amplitudes, "--amplitudes", free_only);
    refuse(a.excesses, "--excesses", free_only);
    if (a.starts) refuse(a.curves, "--curves", "and --starts exclude each other");
  } else {
    refuse(a.sections, "--sections", excited_only);
    refuse(a.starts, "--starts", excited_only);
    if (a.amplitudes || a.excesses) refuse(a.curves, "--curves", "excludes --amplitudes and --excesses");
  }
  require_two_files(a.output, a.figure);
}

PortraitOptions levels_of(const PortraitArguments& a, double alpha) {
  PortraitOptions options{.alpha = alpha};
  options.cells = int_of("--cells", a.cells, options.cells, 1, kMostCells);
  options.points = int_of("--points", a.points, options.points, 9, kMostCount);
  if (a.amplitudes || a.excesses) options.amplitudes = options.excesses = {};
  if (a.amplitudes) options.amplitudes = list_of("--amplitudes", *a.amplitudes, "rad");
  if (a.excesses) options.excesses = list_of("--excesses", *a.excesses, "");
  if (a.curves) {
    const int count = int_of("--curves", a.curves, 0, 1, kMostCount);
    options.amplitudes.clear();
    for (int j = 1; j <= count; ++j) options.amplitudes.push_back(j * std::numbers::pi / (count + 1));
  }
  options.validate();
  return options;
}

std::vector<MotionStart> starts_in(const std::string& path) {
  const NumericTable table = read_table(path, {.required = {"angle", "velocity"},
                                               .optional = {},
                                               .units = {{"angle", "rad"}, {"velocity", "rad/s"}}});
  const std::size_t angle = table.column("angle"), velocity = table.column("velocity");
  std::vector<MotionStart> starts;
  for (std::size_t i = 0; i < table.rows.size(); ++i) {
    starts.push_back({table.rows[i][angle], table.rows[i][velocity]});
    if (std::abs(starts.back().angle) > 1e9)
      throw table.error_at(i, angle, "the angle must be between -1e9 and 1e9 rad");
  }
  return starts;
}

Job job_of(const PortraitArguments& a) {
  Job job;
  require_one_standard_input(a, "--starts", a.starts);
  if (!a.scene.empty()) {
    job.scene = load_scene(a);
    if (!job.scene->scene.pendulum)
      throw FileError(job.scene->file, 0, 0, "portrait needs a scene with [pendulum]");
    job.pendulum = pendulum(job.scene->scene);
    job.is_excited = !is_free(job.scene->scene);
  } else if (!a.set.empty()) {
    throw UsageError("--set goes with a scene");
  }
  check_flags(a, job.is_excited);
  const int threads = threads_of(a);
  if (!job.is_excited) {
    method_of(a, "the portrait of a free pendulum", {Method::exact});
    job.levels = levels_of(a, job.pendulum ? job.pendulum->alpha() : 1.0);
    return job;
  }
  StroboscopicOptions& options = job.stroboscopic;
  options.method = method_of(a, "the portrait of an excited pendulum", {Method::arkode, Method::cvode});
  options.threads = threads;
  options.cells = int_of("--cells", a.cells, options.cells, 1, kMostCells);
  options.sections = int_of("--sections", a.sections, options.sections, 1, kMostCount);
  options.cancel = &cancel_flag();
  const int count = int_of("--curves", a.curves, kStarts, 1, kMostCount);
  job.starts = a.starts ? starts_in(*a.starts) : portrait_starts(job.pendulum->alpha(), options.cells, count);
  return job;
}

/// An upper estimate of the number of points.
double points_of(const Job& job) {
  if (job.is_excited) return static_cast<double>(job.starts.size()) * (job.stroboscopic.sections + 1.0);
  const PortraitOptions& o = job.levels;
  const auto levels = static_cast<double>(o.amplitudes.size() + 2 * o.excesses.size() + 2);
  return levels * (o.cells + 1.0) * (o.points + 4.0);
}

std::vector<std::string> plan_lines(const Job& job) {
  std::vector<std::string> lines;
  if (job.is_excited) {
    const StroboscopicOptions& o = job.stroboscopic;
    lines = {fmt::format("portrait: {} starts, {} sections of each", job.starts.size(), o.sections),
             "method: " + std::string(to_string(o.method)), fmt::format("cells: {}", o.cells),
             "largest error bound of a section: " + to_text(o.tolerance) + " rad",
             fmt::format("threads: {}", o.threads == 0 ? "all" : std::to_string(o.threads))};
  } else {
    const PortraitOptions& o = job.levels;
    lines = {fmt::format("portrait: {} amplitudes, {} excesses, {} points a closed curve",
                         o.amplitudes.size(), o.excesses.size(), o.points),
             "method: exact", fmt::format("cells: {}", o.cells), "alpha: " + to_text(o.alpha) + " rad/s"};
  }
  lines.push_back(fmt::format("memory: at most {:.3g} MB", kBytesPerPoint * points_of(job) / 1e6));
  return lines;
}

void print_plan(const Job& job) {
  if (job.scene) return app::print_plan(*job.scene, plan_lines(job));
  app::print_plan("free pendulum", plan_lines(job));
}

Provenance provenance_of(const PortraitArguments& a, const Job& job) {
  Provenance provenance = make_provenance(a.command);
  if (job.is_excited) {
    const auto method = job.stroboscopic.method == Method::cvode ? Method::cvode : Method::arkode;
    provenance.emplace_back("model", describe(job.scene->scene));
    provenance.emplace_back("method", to_string(method));
    provenance.emplace_back("section_tolerance", to_text(job.stroboscopic.tolerance) + " rad");
  } else {
    provenance.emplace_back("model", "free pendulum");
    provenance.emplace_back("method", to_string(Method::exact));
    provenance.emplace_back("alpha", to_text(job.levels.alpha) + " rad/s");
  }
  if (job.scene) provenance.emplace_back("scene", to_toml(*job.scene));
  return provenance;
}

PortraitDescription description_of(const Job& job) {
  if (!job.is_excited) {
    const std::string title = "Phase portrait of the free pendulum";
    return {title, job.levels.alpha, job.levels.cells, job.scene.has_value()};
  }
  return {"Stroboscopic portrait: " + describe(job.scene->scene), job.pendulum->alpha(),
          job.stroboscopic.cells, true};
}

StroboscopicPortrait sections_of(const Job& job, Progress& progress) {
  StroboscopicOptions options = job.stroboscopic;
  options.progress = [&](std::size_t done, std::size_t total) { progress.update(done, total); };
  const auto moving = support(job.scene->scene), driving = moment(job.scene->scene);
  auto portrait = stroboscopic_portrait(*job.pendulum, moving ? &*moving : nullptr,
                                        driving ? &*driving : nullptr, job.starts, options);
  progress.clear();
  throw_if_interrupted();
  return portrait;
}

std::size_t point_count(const std::vector<PhaseCurve>& curves) {
  std::size_t count = 0;
  for (const auto& curve : curves) count += curve.points.size();
  return count;
}

}  // namespace

ExitCode run(const PortraitArguments& arguments) {
  const Job job = job_of(arguments);
  require_memory(arguments, kBytesPerPoint * points_of(job));
  if (arguments.dry_run) {
    print_plan(job);
    return ExitCode::done;
  }
  install_signal_handlers();
  Progress progress(!arguments.quiet, "curves");
  PortraitOutput output(arguments, description_of(job));
  StroboscopicPortrait portrait;
  if (job.is_excited)
    portrait = sections_of(job, progress);
  else
    portrait.curves = phase_portrait(job.levels);
  throw_if_interrupted();
  output.write(portrait.curves, provenance_of(arguments, job));
  if (!arguments.quiet) {
    std::string note = fmt::format("wrote {}: {} curves, {} points in {:.2g} s", output.places(),
                                   portrait.curves.size(), point_count(portrait.curves), progress.seconds());
    if (job.is_excited) {
      note += fmt::format("; {} of {} sections, {} curves end early, where the error bound exceeds {} rad",
                          portrait.reached, portrait.asked, portrait.ended_early,
                          to_text(job.stroboscopic.tolerance));
    }
    print_note(note);
  }
  return portrait.ended_early == 0 ? ExitCode::done : ExitCode::unresolved;
}

}  // namespace strutt::app
