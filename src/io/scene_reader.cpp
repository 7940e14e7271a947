#include "io/scene_reader.hpp"

#include <algorithm>
#include <array>

#include "io/text.hpp"
#include "strutt/base/error.hpp"

namespace strutt {
namespace {

constexpr int kHighestOrder = 10000;

/// Goes over a list of harmonics: checks the keys and the order, and hands each table to `take(table,
/// order)`.
template <typename Take>
void read_harmonic_list(const TomlTable& owner, const Take& take) {
  if (!owner.has("harmonics")) return;
  const auto& document = owner.document();
  const std::string path = owner.path_of("harmonics");
  std::vector<int> seen;
  for (const auto* node : read_list(document, *owner.find("harmonics"), path)) {
    const TomlTable table(document, *node, path);
    table.allow_only({"order", "cos", "sin"});
    const auto& order_node = table.require("order");
    const int order =
        static_cast<int>(document.integer(order_node, table.path_of("order"), 1, kHighestOrder));
    if (std::find(seen.begin(), seen.end(), order) != seen.end()) {
      document.fail(order_node, path + " has order " + std::to_string(order) + " twice");
    }
    seen.push_back(order);
    take(TomlTable(document, *node, path + "." + std::to_string(order)), order);
  }
}

std::vector<Harmonic> read_harmonics(const TomlTable& owner, std::string_view dimension) {
  std::vector<Harmonic> result;
  read_harmonic_list(owner, [&](const TomlTable& table, int order) {
    result.push_back({order, table.number_or("cos", dimension, 0.0), table.number_or("sin", dimension, 0.0)});
  });
  return result;
}

PendulumTable read_pendulum(const TomlTable& table) {
  table.allow_only({"shape", "mass", "length", "inertia", "centroid", "gravity", "damping", "about"});
  using Shape = PendulumTable::Shape;
  constexpr std::array shapes{Shape::rod, Shape::point_mass, Shape::body};
  PendulumTable p;
  p.shape = shapes[table.choice("shape", {"rod", "point_mass", "body"}, true)];
  p.about = table.choice("about", {"hanging", "inverted"}, true) == 0 ? Equilibrium::hanging
                                                                      : Equilibrium::inverted;
  p.mass = table.number_or("mass", "kg", p.mass, Range::positive);
  p.gravity = table.number_or("gravity", "m/s^2", p.gravity, Range::positive);
  p.damping = table.number_or("damping", "1/s", p.damping, Range::not_negative);
  if (p.shape == Shape::body) {
    p.inertia = table.number("inertia", "kg m^2", Range::positive);
    p.centroid = table.number("centroid", "m", Range::positive);
    p.length = table.number_or("length", "m", p.length, Range::positive);  // allowed, not used
    return p;
  }
  for (const auto* key : {"inertia", "centroid"}) {
    if (table.has(key)) table.fail(key, table.path_of(key) + " goes with shape = \"body\" only");
  }
  p.length = table.number("length", "m", Range::positive);
  return p;
}

/// One period of equidistant values: the column `r` of a CSV file, or a list of numbers.
std::vector<double> read_samples(const TomlTable& table, const std::filesystem::path& directory) {
  const auto& document = table.document();
  const auto& node = table.require("samples");
  std::vector<double> values;
  if (node.is_array()) {
    for (const auto* value : read_list(document, node, table.path_of("samples"))) {
      const std::string path = table.path_of("samples") + "." + std::to_string(values.size());
      values.push_back(document.number(*value, path, "m"));
    }
    if (values.empty()) document.fail(node, table.path_of("samples") + " is empty");
    return values;
  }
  const std::string file = table.text("samples");
  if (file.empty()) document.fail(node, table.path_of("samples") + " must be the name of a CSV file");
  const auto samples =
      read_table(directory / file, {.required = {"r"}, .optional = {}, .units = {{"r", "m"}}});
  for (const auto& row : samples.rows) values.push_back(row[0]);
  return values;
}

SupportTable read_support(const TomlTable& table, const std::filesystem::path& directory) {
  table.allow_only({"amplitude", "frequency", "phase", "harmonics", "waveform", "samples"});
  for (const auto* form : {"harmonics", "samples"}) {
    for (const auto* key : {"amplitude", "phase", "waveform"}) table.exclude(form, key);
  }
  table.exclude("harmonics", "samples");
  SupportTable s;
  s.frequency = table.number("frequency", "rad/s", Range::positive);
  if (table.has("harmonics")) {
    s.waveform = Waveform::harmonics;
    s.harmonics = read_harmonics(table, "m");
    return s;
  }
  if (table.has("samples")) {
    s.waveform = Waveform::samples;
    s.samples = read_samples(table, directory);
    return s;
  }
  if (table.has("waveform")) {
    table.choice("waveform", {"square_acceleration"}, false);
    s.waveform = Waveform::square;
  }
  s.amplitude = table.number_or("amplitude", "m", 0.05);
  s.phase = table.number_or("phase", "rad", s.phase);
  return s;
}

MomentTable read_moment(const TomlTable& table, const std::optional<SupportTable>& support) {
  table.allow_only({"constant", "harmonics", "frequency"});
  MomentTable m;
  m.constant = table.number_or("constant", "N m", m.constant);
  m.harmonics = read_harmonics(table, "N m");
  if (table.has("frequency")) m.frequency = table.number("frequency", "rad/s", Range::positive);
  if (support && m.frequency && *m.frequency != support->frequency) {
    table.fail("frequency", "moment.frequency = " + to_text(*m.frequency) +
                                " must equal support.frequency = " + to_text(support->frequency) +
                                ", or be left out");
  }
  if (support)
    m.frequency.reset();  // one value, not two: the moment follows when support.frequency is varied
  if (!support && !m.frequency && !m.harmonics.empty()) {
    table.fail("moment.frequency is missing: there are harmonics and no [support]");
  }
  return m;
}

MathieuTable read_mathieu(const TomlTable& table) {
  table.allow_only({"delta", "epsilon", "a", "q", "damping"});
  for (const auto* standard : {"delta", "epsilon"}) {
    for (const auto* other : {"a", "q"}) table.exclude(standard, other);
  }
  MathieuTable m;
  m.mathieu_form = table.has("a") || table.has("q");
  m.delta = m.mathieu_form ? table.number("a", "") : table.number_or("delta", "", 1.0);
  m.epsilon = m.mathieu_form ? table.number("q", "") : table.number_or("epsilon", "", 0.5);
  m.damping = table.number_or("damping", "", m.damping, Range::not_negative);
  return m;
}

HillTable read_hill(const TomlTable& table) {
  table.allow_only({"period", "mean", "harmonics", "waveform", "amplitude", "damping"});
  for (const auto* key : {"waveform", "amplitude"}) table.exclude("harmonics", key);
  if (table.has("amplitude") && !table.has("waveform")) {
    table.fail("amplitude", "hill.amplitude goes with waveform = \"square\" only");
  }
  HillTable h;
  h.period = table.number("period", "", Range::positive);
  h.mean = table.number_or("mean", "", 1.0);
  h.damping = table.number_or("damping", "", h.damping, Range::not_negative);
  h.harmonics = read_harmonics(table, "");
  if (table.has("waveform")) {
    table.choice("waveform", {"square"}, false);
    h.waveform = Waveform::square;
    h.amplitude = table.number_or("amplitude", "", 0.5);
  }
  return h;
}

/// A matrix of `size` rows (0: any), zero if the key is missing.
Eigen::MatrixXd read_sized_matrix(const TomlTable& table, std::string_view key, Eigen::Index size) {
  if (!table.has(key)) return Eigen::MatrixXd::Zero(size, size);
  auto matrix = read_matrix(table.document(), *table.find(key), table.path_of(key));
  if (size == 0 || matrix.rows() == size) return matrix;
  table.fail(key, table.path_of(key) + " has " + std::to_string(matrix.rows()) +
                      " rows, the other matrices have " + std::to_string(size));
}

PeriodicMatrix read_periodic_matrix(const TomlTable& table, Eigen::Index size) {
  table.allow_only({"mean", "harmonics"});
  PeriodicMatrix result;
  result.mean = read_sized_matrix(table, "mean", size);
  read_harmonic_list(table, [&](const TomlTable& harmonic, int order) {
    const auto rows = result.mean.rows();
    result.harmonics.push_back(
        {order, read_sized_matrix(harmonic, "cos", rows), read_sized_matrix(harmonic, "sin", rows)});
  });
  return result;
}

LinearPeriodicSystem read_linear(const TomlTable& table) {
  table.allow_only({"period", "mass", "stiffness", "damping"});
  const auto& document = table.document();
  LinearPeriodicSystem system;
  system.period = table.number("period", "", Range::positive);
  const TomlTable stiffness(document, table.require("stiffness"), table.path_of("stiffness"));
  stiffness.require("mean");
  system.stiffness = read_periodic_matrix(stiffness, 0);
  const auto size = system.stiffness.mean.rows();
  system.mass =
      table.has("mass") ? read_sized_matrix(table, "mass", size) : Eigen::MatrixXd::Identity(size, size);
  if (table.has("damping")) {
    system.damping =
        read_periodic_matrix({document, table.require("damping"), table.path_of("damping")}, size);
  }
  return system;
}

void check_tables(const TomlDocument& document) {
  const std::vector<std::string> known{"pendulum", "support", "moment", "mathieu", "hill", "linear", "chart"};
  for (const auto& [key, node] : document.root()) {
    if (std::find(known.begin(), known.end(), key.str()) != known.end()) continue;
    const std::string close = nearest(key.str(), known);
    std::string what = node.is_table() ? "unknown table [" : "unknown key '";
    what += printable(key.str()) + (node.is_table() ? "]" : "' outside the tables");
    what += close.empty() ? "; the tables are " + quoted_list(known) : "; did you mean [" + close + "]?";
    document.fail(key.source(), what);
  }
  std::string model;
  for (const auto* name : {"pendulum", "mathieu", "hill", "linear"}) {
    const auto* node = document.root().get(name);
    if (node == nullptr) continue;
    if (!model.empty())
      document.fail(*node, "[" + model + "] and [" + name + "] exclude each other: a scene has one model");
    model = name;
  }
  if (model.empty())
    document.fail(document.root(), "there is no model: one of [pendulum], [mathieu], [hill], [linear]");
  for (const auto* name : {"support", "moment"}) {
    const auto* node = document.root().get(name);
    if (node != nullptr && model != "pendulum") {
      document.fail(*node, std::string("[") + name + "] goes with [pendulum] only");
    }
  }
}

}  // namespace

Scene read_scene_tables(const TomlDocument& document, const std::filesystem::path& directory) {
  check_tables(document);
  const auto table = [&](const char* name) -> std::optional<TomlTable> {
    const auto* node = document.root().get(name);
    return node == nullptr ? std::nullopt : std::optional(TomlTable(document, *node, name));
  };
  Scene scene;
  if (const auto t = table("pendulum")) scene.pendulum = read_pendulum(*t);
  if (const auto t = table("support")) scene.support = read_support(*t, directory);
  if (const auto t = table("moment")) scene.moment = read_moment(*t, scene.support);
  if (const auto t = table("mathieu")) scene.mathieu = read_mathieu(*t);
  if (const auto t = table("hill")) scene.hill = read_hill(*t);
  if (const auto t = table("linear")) scene.linear = read_linear(*t);
  return scene;
}

}  // namespace strutt
