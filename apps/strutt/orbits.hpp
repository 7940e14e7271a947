#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "arguments.hpp"
#include "strutt/free_pendulum/period_formulas.hpp"

namespace strutt::app {

/// What an orbit is told by: the column, the flag, and the library's functions.
struct Input {
  const char* column;
  const char* flag;
  const char* unit;
  std::optional<std::string> PeriodArguments::*argument;
  Period (*period)(double, const Eigenfrequency&);
  Period (CheapestPeriod::*cheapest)(double, const Eigenfrequency&) const;
  FormulaError (*formula)(PeriodMethod, double);
  double (*amplitude)(double);  // rad, to the precision of a figure; NaN for rotations
};
extern const std::array<Input, 3> kInputs;

/// The orbits asked for: the columns as they were read, and where the two that matter stand.
struct Orbits {
  const Input* input = nullptr;
  std::vector<std::string> columns;
  std::vector<std::vector<double>> rows;
  std::size_t orbit_column = 0;
  std::optional<std::size_t> alpha_column;

  Eigenfrequency alpha(const std::vector<double>& row, const Eigenfrequency& otherwise) const {
    return alpha_column ? Eigenfrequency{row[*alpha_column], 0.0} : otherwise;
  }
  Period period(const std::vector<double>& row, const Eigenfrequency& alpha) const {
    return input->period(row[orbit_column], alpha);
  }
};

/// Reads and checks all of them before anything is written. Exactly one of the flags must be given.
Orbits orbits_of(const PeriodArguments& arguments, const Eigenfrequency& alpha);

}  // namespace strutt::app
