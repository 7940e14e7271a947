#include <string>

#include "strutt/base/error.hpp"
#include "strutt/io/scene_file.hpp"

namespace strutt {
namespace {

/// A TOML float that reads back to the same bits.
std::string real(double value) {
  const std::string text = to_text(value);
  return text.find_first_not_of("-0123456789") == std::string::npos ? text + ".0" : text;
}

void line(std::string& out, const char* key, const std::string& value) {
  out += std::string(key) + " = " + value + "\n";
}

void line(std::string& out, const char* key, double value) { line(out, key, real(value)); }

std::string toml_string(std::string_view text) { return "\"" + std::string(text) + "\""; }

std::string list(const std::vector<double>& values) {
  std::string text;
  for (const double value : values) text += (text.empty() ? "" : ", ") + real(value);
  return "[" + text + "]";
}

std::string matrix(const Eigen::MatrixXd& values) {
  std::string text;
  for (Eigen::Index i = 0; i < values.rows(); ++i) {
    const Eigen::VectorXd row = values.row(i);
    text += (i == 0 ? "" : ", ") + list({row.begin(), row.end()});
  }
  return "[" + text + "]";
}

void add_harmonics(std::string& out, const std::vector<Harmonic>& harmonics) {
  std::string text;
  for (const auto& h : harmonics) {
    text += (text.empty() ? "{ order = " : ", { order = ") + std::to_string(h.order) +
            ", cos = " + real(h.cosine) + ", sin = " + real(h.sine) + " }";
  }
  line(out, "harmonics", "[" + text + "]");
}

std::string periodic_matrix(const PeriodicMatrix& m) {
  std::string harmonics;
  for (const auto& h : m.harmonics) {
    harmonics += (harmonics.empty() ? "{ order = " : ", { order = ") + std::to_string(h.order);
    if (h.cosine.size() > 0) harmonics += ", cos = " + matrix(h.cosine);
    if (h.sine.size() > 0) harmonics += ", sin = " + matrix(h.sine);
    harmonics += " }";
  }
  std::string text = "{ mean = " + matrix(m.mean);
  if (!harmonics.empty()) text += ", harmonics = [" + harmonics + "]";
  return text + " }";
}

void add(std::string& out, const PendulumTable& p) {
  using Shape = PendulumTable::Shape;
  out += "[pendulum]\n";
  line(out, "shape",
       toml_string(p.shape == Shape::rod          ? "rod"
                   : p.shape == Shape::point_mass ? "point_mass"
                                                  : "body"));
  line(out, "mass", p.mass);
  if (p.shape == Shape::body) {
    line(out, "inertia", p.inertia);
    line(out, "centroid", p.centroid);
  } else {
    line(out, "length", p.length);
  }
  line(out, "gravity", p.gravity);
  line(out, "damping", p.damping);
  line(out, "about", toml_string(p.about == Equilibrium::hanging ? "hanging" : "inverted"));
}

void add(std::string& out, const SupportTable& s) {
  out += "\n[support]\n";
  line(out, "frequency", s.frequency);
  if (s.waveform == Waveform::harmonics) return add_harmonics(out, s.harmonics);
  if (s.waveform == Waveform::samples) return line(out, "samples", list(s.samples));
  if (s.waveform == Waveform::square) line(out, "waveform", toml_string("square_acceleration"));
  line(out, "amplitude", s.amplitude);
  line(out, "phase", s.phase);
}

void add(std::string& out, const MomentTable& m) {
  out += "\n[moment]\n";
  line(out, "constant", m.constant);
  if (m.frequency) line(out, "frequency", *m.frequency);
  if (!m.harmonics.empty()) add_harmonics(out, m.harmonics);
}

void add(std::string& out, const MathieuTable& m) {
  out += "[mathieu]\n";
  line(out, m.mathieu_form ? "a" : "delta", m.delta);
  line(out, m.mathieu_form ? "q" : "epsilon", m.epsilon);
  line(out, "damping", m.damping);
}

void add(std::string& out, const HillTable& h) {
  out += "[hill]\n";
  line(out, "period", h.period);
  line(out, "mean", h.mean);
  if (h.waveform == Waveform::square) {
    line(out, "waveform", toml_string("square"));
    line(out, "amplitude", h.amplitude);
  } else {
    add_harmonics(out, h.harmonics);
  }
  line(out, "damping", h.damping);
}

void add(std::string& out, const LinearPeriodicSystem& l) {
  out += "[linear]\n";
  line(out, "period", l.period);
  line(out, "mass", matrix(l.mass));
  line(out, "stiffness", periodic_matrix(l.stiffness));
  if (l.damping.mean.size() > 0) line(out, "damping", periodic_matrix(l.damping));
}

std::string axis(const Axis& a) {
  std::string text = "{ parameter = " + toml_string(a.parameter) + ", from = " + real(a.from) +
                     ", to = " + real(a.to) + ", points = " + std::to_string(a.points);
  if (a.scale == AxisScale::logarithmic) text += ", scale = \"log\"";
  return text + " }";
}

void add(std::string& out, const ChartTable& chart) {
  out += "\n[chart]\n";
  if (chart.x) line(out, "x", axis(*chart.x));
  if (chart.y) line(out, "y", axis(*chart.y));
  if (chart.layers) {
    std::string names;
    for (const Layer layer : *chart.layers)
      names += (names.empty() ? "" : ", ") + toml_string(to_string(layer));
    line(out, "layers", "[" + names + "]");
  }
  if (chart.tolerance) line(out, "tolerance", *chart.tolerance);
}

}  // namespace

std::string to_toml(const SceneFile& file) {
  const Scene& scene = file.scene;
  std::string out;
  if (scene.pendulum) add(out, *scene.pendulum);
  if (scene.mathieu) add(out, *scene.mathieu);
  if (scene.hill) add(out, *scene.hill);
  if (scene.linear) add(out, *scene.linear);
  if (scene.support) add(out, *scene.support);
  if (scene.moment) add(out, *scene.moment);
  const ChartTable& chart = file.chart;
  if (chart.x || chart.y || chart.layers || chart.tolerance) add(out, chart);
  return out;
}

}  // namespace strutt
