// Compares what the methods found and writes the CSV files. Usage: merge WORK TARGET [KIND]
//
// Every case needs at least two answers and all of them have to agree. Nothing is written
// unless every case of every kind passes.
#include <iostream>
#include "common.hpp"

namespace {

struct Kind {
  std::string name, equation, columns;
  size_t entries;  // leading answers that are compared on the scale of the largest of them
  Real tolerance;
  int written = 40;  // digits
};

const std::vector<std::string> kMethods{"taylor", "fourier", "collocation", "sturm", "fraction"};

// An exact zero, such as sin(2 pi), comes out as the rounding error of 100 digits. The smallest
// true entry and margin of these cases is far above this, so less than this is written as 0.
const Real kZero("1e-60");

const std::vector<Kind>& kinds() {
  static const Real linear("1e-30"), nonlinear("1e-25");
  static const std::string m2 = ",m11,m12,m21,m22,trace,margin";
  static const std::vector<Kind> list{
      {"mathieu", "x'' + damping x' + (delta + epsilon cos t) x = 0, period 2 pi",
       "family,delta,epsilon,damping" + m2, 5, linear},
      {"hill", "x'' + damping x' + (mean + sum_k cosk cos(k w t) + sink sin(k w t)) x = 0, w = 2 pi / period",
       "period,mean,cos1,sin1,cos2,sin2,cos3,sin3,damping" + m2, 5, linear},
      {"square", "x'' + damping x' + (mean + amplitude sign(cos(2 pi t / period))) x = 0",
       "period,mean,amplitude,damping" + m2, 5, linear},
      {"pendulum",
       "x'' + damping x' + s alpha^2 (1 + r''/gravity) x = 0, alpha^2 = 3 gravity / (2 length), "
       "r = amplitude sin(frequency t + phase), s = 1 hanging, -1 inverted, period 2 pi / frequency",
       "about,length,gravity,amplitude,frequency,phase,damping" + m2, 5, linear},
      {"linear4",
       "q'' + c q' + ([[k1,k12],[k12,k2]] + cos(t) [[p11,p12],[p12,p22]]) q = 0, period 2 pi, "
       "state (q1,q2,q1',q2')",
       "c,k1,k2,k12,p11,p12,p22,m11,m12,m13,m14,m21,m22,m23,m24,m31,m32,m33,m34,m41,m42,m43,m44", 16, linear},
      {"motion",
       "phi'' + damping phi' + alpha^2 (1 + r''/gravity) sin phi = 0, alpha^2 = 3 gravity / (2 length), "
       "r = amplitude sin(frequency t), phi(0) = angle0, phi'(0) = velocity0",
       "length,gravity,amplitude,frequency,damping,angle0,velocity0,t,angle,velocity", 2, nonlinear},
      {"long_motion",
       "the equation of motion.csv; s is the largest |entry| of "
       "d(phi, phi'/alpha)/d(phi0, phi0'/alpha), at least 1",
       "length,gravity,amplitude,frequency,damping,angle0,velocity0,t,angle,velocity,s", 3, nonlinear},
      {"characteristic", "x'' + (value - 2 q cos 2t) x = 0: a_n(q), b_n(q)", "kind,order,q,value", 1, linear,
       25},
      {"mathieu_box", "cells of a chart of x'' + (delta + epsilon cos t) x = 0, 2048 x 2048 points",
       "column,row,delta,epsilon,trace", 1, linear, 25},
      {"pendulum_box",
       "cells of a chart of the hanging rod (pendulum.csv), length 1, gravity 9.81, phase and damping 0, "
       "2048 x 2048 points",
       "column,row,frequency,amplitude,trace", 1, linear, 25}};
  return list;
}

std::vector<Real> numbers(const Row& row) {
  std::vector<Real> values;
  if (row != Row{"-"})
    for (const auto& field : row) values.emplace_back(field);
  return values;
}

struct Outcome {
  std::string text;       // the CSV rows
  Real worst = 0;         // largest difference against max(1, largest entry)
  Real worst_single = 0;  // largest difference of a number relative to itself
  size_t rows = 0;
  std::vector<size_t> answers = std::vector<size_t>(kMethods.size());
  bool agree = true;
};

void compare_row(const Kind& kind, const std::string& name, const std::vector<std::vector<Real>>& found,
                 Outcome& out) {
  const std::vector<Real>& first = found[0];
  Real scale = 1;
  for (size_t i = 0; i < kind.entries; ++i) scale = std::max(scale, Real(abs(first[i])));
  Real worst = 0;
  for (size_t other = 1; other < found.size(); ++other) {
    if (found[other].size() != first.size()) throw std::runtime_error("answers differ in length: " + name);
    for (size_t i = 0; i < first.size(); ++i) {
      const Real difference = abs(found[other][i] - first[i]);
      const Real own = i < kind.entries ? scale : std::max(Real(1), Real(abs(first[i])));
      worst = std::max(worst, Real(difference / own));
      if (abs(first[i]) > kZero)
        out.worst_single = std::max(out.worst_single, Real(difference / abs(first[i])));
    }
  }
  out.worst = std::max(out.worst, worst);
  if (found.size() < 2 || worst > kind.tolerance) {
    out.agree = false;
    std::cerr << kind.name << ": " << name << ": " << found.size() << " answers, difference "
              << digits(worst, 3) << '\n';
  }
}

Outcome compare(const Kind& kind, const std::string& work) {
  Outcome out;
  const auto cases = read_rows(work + "/" + kind.name + ".in");
  std::vector<std::vector<Row>> answers;
  for (const auto& method : kMethods) {
    const std::string file = work + "/" + kind.name + "." + method;
    answers.push_back(std::ifstream(file) ? read_rows(file) : std::vector<Row>(cases.size(), Row{"-"}));
    if (answers.back().size() != cases.size()) throw std::runtime_error("wrong number of rows in " + file);
  }
  for (size_t i = 0; i < cases.size(); ++i) {
    std::string line;
    for (const auto& field : cases[i]) line += (line.empty() ? "" : ",") + field;
    std::vector<std::vector<Real>> found;
    for (size_t m = 0; m < kMethods.size(); ++m)
      if (auto values = numbers(answers[m][i]); !values.empty()) {
        found.push_back(values);
        ++out.answers[m];
      }
    if (found.empty()) throw std::runtime_error(kind.name + ": no answer for " + line);
    compare_row(kind, line, found, out);
    for (const Real& value : found[0]) line += "," + (abs(value) < kZero ? "0" : digits(value, kind.written));
    out.text += line + "\n";
    ++out.rows;
  }
  return out;
}

}  // namespace

int main(int argc, char** argv) try {
  const std::string work = argc > 1 ? argv[1] : ".", target = argc > 2 ? argv[2] : ".";
  const std::string only = argc > 3 ? argv[3] : "";
  std::vector<std::pair<std::string, std::string>> files;
  bool agree = true;
  for (const Kind& kind : kinds()) {
    if (!only.empty() && only != kind.name) continue;
    const Outcome out = compare(kind, work);
    agree = agree && out.agree;
    std::ostringstream head;
    head << "# " << kind.equation << '\n'
         << "# Inputs are exact IEEE doubles (read them with strtod); results have " << kind.written
         << " digits.\n"
         << "# Made by tests/reference/make.sh in 100-digit arithmetic. Rows answered:";
    for (size_t m = 0; m < kMethods.size(); ++m)
      if (out.answers[m]) head << ' ' << kMethods[m] << ' ' << out.answers[m] << ',';
    head << " of " << out.rows
         << ".\n# Largest difference between methods / max(1, largest result of the row): "
         << digits(out.worst, 2) << ".\n";
    std::cout << kind.name << ": " << out.rows << " rows, largest difference " << digits(out.worst, 2)
              << ", of a single number " << digits(out.worst_single, 2) << '\n';
    files.emplace_back(kind.name, head.str() + kind.columns + "\n" + out.text);
  }
  if (!agree) throw std::runtime_error("the methods do not agree; nothing written");
  for (const auto& [name, text] : files) {
    std::ofstream out(target + "/" + name + ".csv");
    if (!(out << text).flush()) throw std::runtime_error("cannot write " + name + ".csv");
  }
} catch (const std::exception& error) {
  std::cerr << "merge: " << error.what() << '\n';
  return 1;
}
