#include "strutt/model/scene.hpp"

#include <cmath>

#include "model/harmonic_orders.hpp"
#include "model/parameter_table.hpp"
#include "strutt/base/error.hpp"
#include "strutt/base/floating_point.hpp"

namespace strutt {
namespace {

const ParameterEntry& find(const std::vector<ParameterEntry>& table, std::string_view path) {
  std::vector<std::string> known;
  for (const auto& entry : table) {
    if (entry.info.path == path) return entry;
    known.push_back(entry.info.path);
  }
  throw InvalidInput("unknown parameter '" + std::string(path) + "' for this scene" +
                     suggestion(path, known));
}

void positive(std::string_view path, double value) {
  require(value > 0.0 && std::isfinite(value), path, value, "a finite number > 0");
}

void not_negative(std::string_view path, double value) {
  require(value >= 0.0 && std::isfinite(value), path, value, "a finite number >= 0");
}

void validate_pendulum(const PendulumTable& p) {
  positive("pendulum.mass", p.mass);
  positive("pendulum.gravity", p.gravity);
  not_negative("pendulum.damping", p.damping);
  if (p.shape == PendulumTable::Shape::body) {
    positive("pendulum.inertia", p.inertia);
    positive("pendulum.centroid", p.centroid);
    const double least = p.mass * p.centroid * p.centroid;
    require(p.inertia >= least * (1.0 - 1e-12), "pendulum.inertia", p.inertia,
            "at least mass * centroid^2 = " + to_text(least));
  } else {
    positive("pendulum.length", p.length);
  }
}

void validate_support(const SupportTable& s) {
  positive("support.frequency", s.frequency);
  require_orders("order in support.harmonics", s.harmonics);
  if (s.waveform != Waveform::samples) return;
  const auto count = static_cast<double>(s.samples.size());
  require(count >= 1, "number of values in support.samples", count, "at least 1");
  for (const double r : s.samples) require(std::isfinite(r), "support.samples", r, "finite in every value");
}

void validate_moment(const MomentTable& m, const std::optional<SupportTable>& support) {
  require_orders("order in moment.harmonics", m.harmonics);
  if (m.frequency) {
    positive("moment.frequency", *m.frequency);
    require(!support || support->frequency == *m.frequency, "moment.frequency", *m.frequency,
            "that of the support");
  } else if (!support && !m.harmonics.empty()) {
    throw InvalidInput("moment.frequency is required: there are harmonics and no [support]");
  }
}

void validate_hill(const HillTable& h) {
  positive("hill.period", h.period);
  not_negative("hill.damping", h.damping);
  require_orders("order in hill.harmonics", h.harmonics);
}

}  // namespace

double& parameter(Scene& scene, std::string_view path) {
  auto table = parameter_table(scene);
  return *find(table, path).value;
}

double parameter(const Scene& scene, std::string_view path) {
  Scene copy = scene;
  return parameter(copy, path);
}

ParameterInfo parameter_info(const Scene& scene, std::string_view path) {
  Scene copy = scene;
  return find(parameter_table(copy), path).info;
}

std::vector<std::string> parameter_paths(const Scene& scene) {
  Scene copy = scene;
  std::vector<std::string> result;
  for (const auto& entry : parameter_table(copy)) result.push_back(entry.info.path);
  return result;
}

void validate(const Scene& scene) {
  Scene copy = scene;
  for (const auto& entry : parameter_table(copy)) {
    require(std::isfinite(*entry.value), entry.info.path, *entry.value, "a finite number");
  }
  const int models = scene.pendulum.has_value() + scene.mathieu.has_value() + scene.hill.has_value() +
                     scene.linear.has_value();
  require(models == 1, "number of models in the scene", models,
          "exactly one of [pendulum], [mathieu], [hill], [linear]");
  if (!scene.pendulum && (scene.support || scene.moment)) {
    throw InvalidInput("[support] and [moment] go with [pendulum] only");
  }
  if (scene.pendulum) validate_pendulum(*scene.pendulum);
  if (scene.support) validate_support(*scene.support);
  if (scene.moment) validate_moment(*scene.moment, scene.support);
  if (scene.mathieu) not_negative("mathieu.damping", scene.mathieu->damping);
  if (scene.hill) validate_hill(*scene.hill);
  if (scene.linear) scene.linear->validate();
}

PhysicalPendulum pendulum(const Scene& scene) {
  if (!scene.pendulum) throw InvalidInput("the scene has no [pendulum]");
  const auto& p = *scene.pendulum;
  switch (p.shape) {
    case PendulumTable::Shape::rod:
      return PhysicalPendulum::uniform_rod(p.mass, p.length, p.gravity, p.damping);
    case PendulumTable::Shape::point_mass:
      return PhysicalPendulum::point_mass(p.mass, p.length, p.gravity, p.damping);
    case PendulumTable::Shape::body:
      break;
  }
  return {p.mass, p.inertia, p.centroid, p.gravity, p.damping};
}

std::optional<Excitation> support(const Scene& scene) {
  if (!scene.support) return std::nullopt;
  const auto& s = *scene.support;
  switch (s.waveform) {
    case Waveform::sine:
      return sinusoidal_support(s.amplitude, s.frequency, s.phase);
    case Waveform::square:
      return square_acceleration_support(s.amplitude, s.frequency, s.phase);
    case Waveform::samples:
      return Excitation{s.frequency, PeriodicFunction::samples(s.samples)};
    case Waveform::harmonics:
      break;
  }
  return Excitation{s.frequency, PeriodicFunction::fourier(0.0, s.harmonics)};
}

std::optional<Excitation> moment(const Scene& scene) {
  if (!scene.moment) return std::nullopt;
  const auto& m = *scene.moment;
  const double frequency = m.frequency ? *m.frequency : scene.support ? scene.support->frequency : 1.0;
  return Excitation{frequency, PeriodicFunction::fourier(m.constant, m.harmonics)};
}

LinearModel linear_model(const Scene& scene) {
  const DefaultFloatingPoint environment;
  if (scene.linear) return *scene.linear;
  if (scene.mathieu) {
    const auto& m = *scene.mathieu;
    return m.mathieu_form ? mathieu_a_q(m.delta, m.epsilon, m.damping)
                          : mathieu_delta_epsilon(m.delta, m.epsilon, m.damping);
  }
  if (scene.hill) {
    const auto& h = *scene.hill;
    const auto w = h.waveform == Waveform::square ? PeriodicFunction::square(h.mean, h.amplitude, 0.0)
                                                  : PeriodicFunction::fourier(h.mean, h.harmonics);
    auto equation = hill_equation(h.period, w, h.damping);
    equation.validate();
    return equation;
  }
  const auto excitation = support(scene);
  return linearise(pendulum(scene), scene.pendulum->about, excitation ? &*excitation : nullptr).equation;
}

std::string describe(const Scene& scene) {
  if (scene.mathieu)
    return scene.mathieu->mathieu_form ? "Mathieu's equation (a, q)" : "Mathieu's equation (delta, epsilon)";
  if (scene.hill) return scene.hill->waveform == Waveform::square ? "Meissner's equation" : "Hill's equation";
  if (scene.linear) {
    return "linear periodic system, " + std::to_string(scene.linear->states()) + " states";
  }
  std::string text =
      scene.pendulum->about == Equilibrium::hanging ? "pendulum, hanging" : "pendulum, inverted";
  if (!scene.support) return text + ", fixed support";
  switch (scene.support->waveform) {
    case Waveform::sine:
      return text + ", sinusoidal support";
    case Waveform::square:
      return text + ", support with square acceleration";
    case Waveform::samples:
      return text + ", sampled support";
    case Waveform::harmonics:
      break;
  }
  return text + ", support with harmonics";
}

}  // namespace strutt
