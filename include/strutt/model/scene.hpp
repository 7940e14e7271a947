#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "strutt/model/linear_system.hpp"
#include "strutt/model/linearisation.hpp"

namespace strutt {

/// [pendulum]: the body and where (7) is linearised.
struct PendulumTable {
  enum class Shape { rod, point_mass, body };
  Shape shape = Shape::rod;
  double mass = 1.0;      // kg
  double length = 0.0;    // m, required for rod and point_mass
  double inertia = 0.0;   // kg m^2 about the pivot, body only
  double centroid = 0.0;  // m from the pivot, body only
  double gravity = 9.81;  // m/s^2
  double damping = 0.0;   // 1/s
  Equilibrium about = Equilibrium::hanging;
};

/// How the table of a periodic function gives its shape; the forms exclude each other.
enum class Waveform {
  sine,       ///< [support] amplitude and phase
  harmonics,  ///< list of orders
  square,     ///< [support] square_acceleration with amplitude and phase; [hill] square with amplitude
  samples,    ///< [support] one period of equidistant values
};

/// [support]: r(t), metres.
struct SupportTable {
  Waveform waveform = Waveform::sine;
  double amplitude = 0.0;  // m
  double frequency = 0.0;  // rad/s, required
  double phase = 0.0;      // rad
  std::vector<Harmonic> harmonics = {};
  std::vector<double> samples = {};  // m
};

/// [moment]: M(t), N m.
struct MomentTable {
  double constant = 0.0;
  std::vector<Harmonic> harmonics = {};
  std::optional<double> frequency;  // rad/s; that of the support unless given
};

/// [mathieu]: x'' + damping x' + (delta + epsilon cos t) x, or in Mathieu's form x'' + damping x' + (a - 2 q
/// cos 2t) x.
struct MathieuTable {
  bool mathieu_form = false;  ///< a and q stand in the scene; the parameters are then mathieu.a and mathieu.q
  double delta = 1.0;         ///< or a
  double epsilon = 0.0;       ///< or q
  double damping = 0.0;
};

/// [hill]: x'' + damping x' + w(t) x.
struct HillTable {
  Waveform waveform = Waveform::harmonics;  // harmonics or square
  double period = 0.0;                      // required
  double mean = 0.0;
  double amplitude = 0.0;  // square only: w = mean + amplitude sign(cos(2 pi t/period))
  std::vector<Harmonic> harmonics = {};
  double damping = 0.0;
};

/// What a scene contains. Only what is present is modelled: an absent table removes its terms from the
/// equations. Exactly one of pendulum, mathieu, hill, linear is present; support and moment go with pendulum.
struct Scene {
  std::optional<PendulumTable> pendulum;
  std::optional<SupportTable> support;
  std::optional<MomentTable> moment;
  std::optional<MathieuTable> mathieu;
  std::optional<HillTable> hill;
  std::optional<LinearPeriodicSystem> linear;
};

/// A dimension that a parameter can have, its SI unit as printed ("" for dimensionless) and what it is
/// called.
struct ParameterInfo {
  std::string path;
  std::string unit;   ///< "m", "rad/s", "1/s", "kg", "kg m^2", "N m", "rad", "m/s^2", "" ...
  std::string label;  ///< for axes, e.g. "support frequency"
};

/// The numeric parameter that `path` names in this scene (docs/scene.md: `support.frequency`,
/// `mathieu.delta`, `hill.harmonics.1.cos`, `linear.stiffness.harmonics.1.cos.0.1`), for reading and writing
/// in place. Parameters of absent tables, of an unused shape or waveform, and of orders not in the list do
/// not exist: throws InvalidInput naming the path and the nearest one that does.
double& parameter(Scene& scene, std::string_view path);
double parameter(const Scene& scene, std::string_view path);
ParameterInfo parameter_info(const Scene& scene, std::string_view path);

/// All parameter paths of this scene, in the order of the scene file.
std::vector<std::string> parameter_paths(const Scene& scene);

/// Checks every range and combination that a model needs (lengths, gravity, frequency, period > 0, damping >=
/// 0, all finite ...). Throws InvalidInput whose field is the parameter path.
void validate(const Scene& scene);

/// The rigid body, support and moment of a pendulum scene.
PhysicalPendulum pendulum(const Scene& scene);
std::optional<Excitation> support(const Scene& scene);
std::optional<Excitation> moment(const Scene& scene);

/// The linear equation whose stability the scene asks for: a HillEquation for [pendulum], [mathieu], [hill];
/// the n-state system for [linear]. For a scene that validate() accepts; called for every cell of a chart, so
/// the ranges are checked by the model only (which throws InvalidInput).
using LinearModel = std::variant<HillEquation, LinearPeriodicSystem>;
LinearModel linear_model(const Scene& scene);

/// One line that names the model in words, for provenance and --dry-run, e.g. "pendulum, hanging, harmonic
/// support".
std::string describe(const Scene& scene);

}  // namespace strutt
