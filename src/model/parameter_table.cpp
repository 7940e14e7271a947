#include "model/parameter_table.hpp"

namespace strutt {
namespace {

using Table = std::vector<ParameterEntry>;

/// "support.frequency" -> "support frequency".
std::string label_of(std::string path) {
  for (char& c : path) {
    if (c == '.' || c == '_') c = ' ';
  }
  return path;
}

void add(Table& table, const std::string& path, const char* unit, double& value) {
  table.push_back({{path, unit, label_of(path)}, &value});
}

void add_harmonics(Table& table, const std::string& path, const char* unit,
                   std::vector<Harmonic>& harmonics) {
  for (auto& h : harmonics) {
    const std::string order = path + ".harmonics." + std::to_string(h.order);
    add(table, order + ".cos", unit, h.cosine);
    add(table, order + ".sin", unit, h.sine);
  }
}

void add_matrix(Table& table, const std::string& path, Eigen::MatrixXd& matrix) {
  for (Eigen::Index i = 0; i < matrix.rows(); ++i) {
    for (Eigen::Index j = 0; j < matrix.cols(); ++j) {
      add(table, path + "." + std::to_string(i) + "." + std::to_string(j), "", matrix(i, j));
    }
  }
}

void add_periodic_matrix(Table& table, const std::string& path, PeriodicMatrix& matrix) {
  add_matrix(table, path + ".mean", matrix.mean);
  for (auto& h : matrix.harmonics) {
    const std::string order = path + ".harmonics." + std::to_string(h.order);
    add_matrix(table, order + ".cos", h.cosine);
    add_matrix(table, order + ".sin", h.sine);
  }
}

void add_pendulum(Table& table, PendulumTable& p) {
  add(table, "pendulum.mass", "kg", p.mass);
  if (p.shape == PendulumTable::Shape::body) {
    add(table, "pendulum.inertia", "kg m^2", p.inertia);
    add(table, "pendulum.centroid", "m", p.centroid);
  } else {
    add(table, "pendulum.length", "m", p.length);
  }
  add(table, "pendulum.gravity", "m/s^2", p.gravity);
  add(table, "pendulum.damping", "1/s", p.damping);
}

void add_support(Table& table, SupportTable& s) {
  if (s.waveform == Waveform::sine || s.waveform == Waveform::square) {
    add(table, "support.amplitude", "m", s.amplitude);
    add(table, "support.phase", "rad", s.phase);
  }
  add(table, "support.frequency", "rad/s", s.frequency);
  if (s.waveform == Waveform::harmonics) add_harmonics(table, "support", "m", s.harmonics);
}

void add_moment(Table& table, MomentTable& m) {
  add(table, "moment.constant", "N m", m.constant);
  if (m.frequency) add(table, "moment.frequency", "rad/s", *m.frequency);
  add_harmonics(table, "moment", "N m", m.harmonics);
}

void add_mathieu(Table& table, MathieuTable& m) {
  add(table, m.mathieu_form ? "mathieu.a" : "mathieu.delta", "", m.delta);
  add(table, m.mathieu_form ? "mathieu.q" : "mathieu.epsilon", "", m.epsilon);
  add(table, "mathieu.damping", "", m.damping);
}

void add_hill(Table& table, HillTable& h) {
  add(table, "hill.period", "", h.period);
  add(table, "hill.mean", "", h.mean);
  if (h.waveform == Waveform::square) {
    add(table, "hill.amplitude", "", h.amplitude);
  } else {
    add_harmonics(table, "hill", "", h.harmonics);
  }
  add(table, "hill.damping", "", h.damping);
}

void add_linear(Table& table, LinearPeriodicSystem& l) {
  add(table, "linear.period", "", l.period);
  add_matrix(table, "linear.mass", l.mass);
  add_periodic_matrix(table, "linear.stiffness", l.stiffness);
  add_periodic_matrix(table, "linear.damping", l.damping);
}

}  // namespace

std::vector<ParameterEntry> parameter_table(Scene& scene) {
  Table table;
  if (scene.pendulum) add_pendulum(table, *scene.pendulum);
  if (scene.support) add_support(table, *scene.support);
  if (scene.moment) add_moment(table, *scene.moment);
  if (scene.mathieu) add_mathieu(table, *scene.mathieu);
  if (scene.hill) add_hill(table, *scene.hill);
  if (scene.linear) add_linear(table, *scene.linear);
  return table;
}

}  // namespace strutt
