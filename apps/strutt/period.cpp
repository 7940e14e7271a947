#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <string_view>

#include "commands.hpp"
#include "orbits.hpp"
#include "rows.hpp"
#include "scene_arguments.hpp"
#include "signals.hpp"
#include "strutt/base/error.hpp"
#include "strutt/free_pendulum/period_formulas.hpp"
#include "strutt/io/period_figure.hpp"
#include "terminal.hpp"

namespace strutt::app {
namespace {

/// What is to be told about an orbit.
struct Wanted {
  double tolerance = 1e-15;
  std::optional<CheapestPeriod> cheapest;  // none: the closed form whatever the tolerance
  bool compare = false;
};

/// The formulas that `--compare` shows.
constexpr std::array kCompared{PeriodMethod::normal_form, PeriodMethod::krylov, PeriodMethod::krylov_squared};

void check_flags(const PeriodArguments& arguments) {
  int given = arguments.points ? 1 : 0;
  for (const Input& input : kInputs) given += arguments.*input.argument ? 1 : 0;
  if (given != 1)
    throw UsageError("wanted is exactly one of --amplitude, --from-top, --separatrix-excess, --points");
  require_one_standard_input(arguments, "--points", arguments.points);
  if (arguments.scene.empty() && !arguments.set.empty()) throw UsageError("--set goes with --scene only");
  if (!arguments.figure) return;
  if (!arguments.compare || !arguments.points) throw UsageError("--figure goes with --points and --compare");
  require_two_files(arguments.output, arguments.figure);
}

/// The scene, if there is one: a pendulum on which nothing but gravity acts.
std::optional<SceneFile> free_scene(const PeriodArguments& arguments) {
  if (arguments.scene.empty()) return std::nullopt;
  SceneFile file = load_scene(arguments);
  const Scene& scene = file.scene;
  const auto refuse = [&](const std::string& what) {
    throw FileError(file.file, 0, 0, "period needs a free pendulum: " + what);
  };
  if (!scene.pendulum) refuse("the scene has no [pendulum]");
  if (scene.support) refuse("the scene has a [support]");
  if (scene.moment) refuse("the scene has a [moment]");
  if (scene.pendulum->damping != 0.0) refuse("pendulum.damping = " + to_text(scene.pendulum->damping));
  return file;
}

Provenance provenance_of(const PeriodArguments& arguments, const std::optional<SceneFile>& scene,
                         Method method, double tolerance) {
  if (scene) return app::provenance_of(arguments, *scene, method, tolerance);
  Provenance provenance = make_provenance(arguments.command);
  provenance.emplace_back("model", "free pendulum");
  provenance.emplace_back("method", to_string(method));
  provenance.emplace_back("tolerance", to_text(tolerance));
  return provenance;
}

std::vector<Column> columns_of(const Orbits& orbits, bool compare) {
  std::vector<Column> columns;
  for (const auto& name : orbits.columns)
    columns.push_back({name, name == "alpha" ? "rad/s" : name == "separatrix_excess" ? "1" : "rad"});
  columns.insert(columns.end(),
                 {{"period", "s"}, {"ratio", "1"}, {"error", "1"}, {"method", ""}, {"outcome", ""}});
  if (!compare) return columns;
  for (const auto formula : kCompared) {
    const std::string name(to_string(formula));
    columns.insert(columns.end(), {{name, "1"}, {name + "_error", "1"}});
  }
  return columns;
}

Outcome outcome_of(const Period& result, double tolerance) {
  if (std::isinf(result.period) && result.method != PeriodMethod::separatrix) return Outcome::non_finite;
  return result.error <= tolerance ? Outcome::converged : Outcome::tolerance_not_reached;
}

/// Ratio and error of every formula; empty where it has no meaning.
void append_comparison(std::vector<Cell>& cells, const Input& input, double orbit) {
  for (const auto method : kCompared) {
    const FormulaError formula = input.formula(method, orbit);
    if (std::isnan(formula.ratio)) {
      cells.insert(cells.end(), {Cell{}, Cell{}});
    } else {
      cells.insert(cells.end(), {formula.ratio, formula.relative_error});
    }
  }
}

ExitCode write_rows(RowWriter& writer, const Orbits& orbits, const Eigenfrequency& scene_alpha,
                    const Wanted& wanted) {
  ExitCode code = ExitCode::done;
  std::vector<Cell> cells;
  for (const auto& row : orbits.rows) {
    throw_if_interrupted();
    const Eigenfrequency alpha = orbits.alpha(row, scene_alpha);
    const double orbit = row[orbits.orbit_column];
    const Period result = wanted.cheapest ? (*wanted.cheapest.*orbits.input->cheapest)(orbit, alpha)
                                          : orbits.period(row, alpha);
    const Outcome outcome = outcome_of(result, wanted.tolerance);
    if (outcome != Outcome::converged) code = ExitCode::unresolved;
    cells.assign(row.begin(), row.end());
    cells.insert(cells.end(), {result.period, result.ratio, result.error,
                               std::string(to_string(result.method)), std::string(to_string(outcome))});
    if (wanted.compare) append_comparison(cells, *orbits.input, orbit);
    writer.write(cells);
  }
  writer.commit();
  return code;
}

/// The librations among the orbits, for the figure.
std::vector<PeriodSample> samples_of(const Orbits& orbits) {
  std::vector<PeriodSample> samples;
  for (const auto& row : orbits.rows) {
    const double orbit = row[orbits.orbit_column];
    const double amplitude = orbits.input->amplitude(orbit);
    if (std::isnan(amplitude)) continue;
    samples.push_back({amplitude, orbits.period(row, {}).ratio,
                       orbits.input->formula(PeriodMethod::krylov, orbit),
                       orbits.input->formula(PeriodMethod::krylov_squared, orbit)});
  }
  return samples;
}

/// Refuses what cannot be drawn before anything is written.
void check_samples(const std::vector<PeriodSample>& samples, const std::string& file) {
  const bool differ = std::any_of(samples.begin(), samples.end(), [&](const PeriodSample& sample) {
    return sample.amplitude != samples.front().amplitude;
  });
  if (!differ)
    throw FileError(file == "-" ? "standard input" : file, 0, 0,
                    "--figure needs librations of two amplitudes or more");
}

/// The double next to pi is often meant for pi itself, where the period is infinite.
void warn_about_pi(const PeriodArguments& arguments, const Orbits& orbits) {
  const bool amplitudes = std::string_view(orbits.input->column) == "amplitude";
  const bool met = amplitudes && std::any_of(orbits.rows.begin(), orbits.rows.end(), [&](const auto& row) {
                     return row[orbits.orbit_column] == std::numbers::pi;
                   });
  if (met && !arguments.quiet)
    print_warning(
        "amplitude 3.141592653589793 is 1.2e-16 below pi and its period finite; the separatrix is from_top "
        "0");
}

void print_plan(const std::optional<SceneFile>& scene, const Orbits& orbits, const Wanted& wanted) {
  const std::vector<std::string> lines{
      fmt::format("points: {}", orbits.rows.size()),
      std::string("method: ") +
          (wanted.cheapest ? "the cheapest formula that is good enough, else exact" : "exact"),
      "tolerance: " + to_text(wanted.tolerance), "threads: 1"};
  if (scene) return app::print_plan(*scene, lines);
  app::print_plan("free pendulum", lines);
}

}  // namespace

ExitCode run(const PeriodArguments& arguments) {
  check_flags(arguments);
  Wanted wanted;
  wanted.tolerance = tolerance_of(arguments, 1e-15, {.least = 5e-16, .most = 1e-1});
  wanted.compare = arguments.compare;
  const Method method = method_of(arguments, "period", {Method::exact});
  if (method == Method::automatic) wanted.cheapest.emplace(wanted.tolerance);
  threads_of(arguments);  // a period costs less than handing it to a thread
  const auto scene = free_scene(arguments);
  const Eigenfrequency alpha = scene ? eigenfrequency(*scene->scene.pendulum) : Eigenfrequency{};
  const Orbits orbits = orbits_of(arguments, alpha);
  if (arguments.dry_run) {
    print_plan(scene, orbits, wanted);
    return ExitCode::done;
  }
  warn_about_pi(arguments, orbits);
  install_signal_handlers();
  const auto samples = arguments.figure ? samples_of(orbits) : std::vector<PeriodSample>{};
  if (arguments.figure) check_samples(samples, *arguments.points);
  std::optional<PeriodFigure> figure;
  if (arguments.figure) figure.emplace(*arguments.figure);
  RowWriter writer(row_path(arguments), arguments.json, columns_of(orbits, wanted.compare),
                   provenance_of(arguments, scene, method, wanted.tolerance));
  const ExitCode code = write_rows(writer, orbits, alpha, wanted);
  if (figure) figure->draw(samples);
  return code;
}

}  // namespace strutt::app
