#include "orbits.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>
#include <string_view>

#include "exit_code.hpp"
#include "rows.hpp"
#include "scene_arguments.hpp"
#include "strutt/base/error.hpp"

namespace strutt::app {

const std::array<Input, 3> kInputs{
    {{"amplitude", "--amplitude", "rad", &PeriodArguments::amplitude, period_of_amplitude,
      &CheapestPeriod::of_amplitude, formula_of_amplitude, [](double a) { return a; }},
     {"from_top", "--from-top", "rad", &PeriodArguments::from_top, period_of_from_top,
      &CheapestPeriod::of_from_top, formula_of_from_top,
      [](double from_top) { return std::numbers::pi - from_top; }},
     {"separatrix_excess", "--separatrix-excess", "", &PeriodArguments::separatrix_excess, period_of_excess,
      &CheapestPeriod::of_excess, formula_of_excess,
      [](double e) { return 2.0 * std::acos(0.5 * std::sqrt(-e)); }}}};

namespace {

Orbits orbit_of_flag(const Input& input, const std::string& text, const Eigenfrequency& alpha) {
  Orbits orbits;
  orbits.input = &input;
  orbits.columns = {input.column};
  orbits.rows = {{quantity_of(input.flag, text, input.unit)}};
  try {
    orbits.period(orbits.rows[0], alpha);
  } catch (const InvalidInput& error) {
    throw UsageError(std::string(input.flag) + ": " + error.what());
  }
  return orbits;
}

/// The kind of orbit that the columns of a file tell.
const Input& input_of(const NumericTable& table) {
  const Input* found = nullptr;
  for (const Input& input : kInputs) {
    if (std::find(table.columns.begin(), table.columns.end(), input.column) == table.columns.end()) continue;
    if (found != nullptr) {
      throw FileError(
          table.file, 0, 0,
          std::string("the columns ") + found->column + " and " + input.column + " exclude each other");
    }
    found = &input;
  }
  if (found == nullptr)
    throw FileError(table.file, 0, 0, "wanted is a column amplitude, from_top or separatrix_excess");
  return *found;
}

/// Checks every row before anything is written.
Orbits orbits_of_file(const std::string& path, const Eigenfrequency& alpha) {
  NumericTable table =
      read_table(path, {.required = {},
                        .optional = {"amplitude", "from_top", "separatrix_excess", "alpha"},
                        .units = {{"amplitude", "rad"}, {"from_top", "rad"}, {"alpha", "rad/s"}}});
  Orbits orbits;
  orbits.input = &input_of(table);
  orbits.orbit_column = table.column(orbits.input->column);
  if (std::find(table.columns.begin(), table.columns.end(), "alpha") != table.columns.end())
    orbits.alpha_column = table.column("alpha");
  for (std::size_t i = 0; i < table.rows.size(); ++i) {
    try {
      orbits.period(table.rows[i], orbits.alpha(table.rows[i], alpha));
    } catch (const InvalidInput& error) {
      const bool is_alpha = orbits.alpha_column && std::string_view(error.what()).starts_with("alpha");
      throw table.error_at(i, is_alpha ? *orbits.alpha_column : orbits.orbit_column, error.what());
    }
  }
  orbits.columns = std::move(table.columns);
  orbits.rows = std::move(table.rows);
  return orbits;
}

}  // namespace

Orbits orbits_of(const PeriodArguments& arguments, const Eigenfrequency& alpha) {
  if (arguments.points) return orbits_of_file(*arguments.points, alpha);
  for (const Input& input : kInputs) {
    if (const auto& text = arguments.*input.argument) return orbit_of_flag(input, *text, alpha);
  }
  throw std::logic_error("the flags were not checked");
}

}  // namespace strutt::app
