#include <array>
#include <charconv>
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "io/text.hpp"
#include "strutt/base/error.hpp"
#include "strutt/io/scene_file.hpp"
#include "strutt/io/table.hpp"

namespace strutt {
namespace {

/// A unit as a multiple of the SI unit: factor * 10^shift. Powers of ten are shifted in the decimal text, so
/// that "7 cm" is the double nearest to 0.07.
struct Unit {
  std::string_view name;
  std::string_view dimension;
  int shift = 0;
  long double factor = 1.0L;
};

constexpr long double kLongPi = std::numbers::pi_v<long double>;

constexpr std::array kUnits{
    Unit{"m", "m"},
    Unit{"km", "m", 3},
    Unit{"cm", "m", -2},
    Unit{"mm", "m", -3},
    Unit{"um", "m", -6},
    Unit{"nm", "m", -9},
    Unit{"in", "m", 0, 0.0254L},
    Unit{"ft", "m", 0, 0.3048L},
    Unit{"rad/s", "rad/s"},
    Unit{"krad/s", "rad/s", 3},
    Unit{"Hz", "rad/s", 0, 2 * kLongPi},
    Unit{"kHz", "rad/s", 3, 2 * kLongPi},
    Unit{"mHz", "rad/s", -3, 2 * kLongPi},
    Unit{"rpm", "rad/s", 0, kLongPi / 30},
    Unit{"1/min", "rad/s", 0, kLongPi / 30},
    Unit{"deg/s", "rad/s", 0, kLongPi / 180},
    Unit{"1/s", "1/s"},
    Unit{"s^-1", "1/s"},
    Unit{"1/ms", "1/s", 3},
    Unit{"rad", "rad"},
    Unit{"mrad", "rad", -3},
    Unit{"deg", "rad", 0, kLongPi / 180},
    Unit{"\u00B0", "rad", 0, kLongPi / 180},
    Unit{"kg", "kg"},
    Unit{"g", "kg", -3},
    Unit{"mg", "kg", -6},
    Unit{"t", "kg", 3},
    Unit{"kg m^2", "kg m^2"},
    Unit{"g m^2", "kg m^2", -3},
    Unit{"kg cm^2", "kg m^2", -4},
    Unit{"g cm^2", "kg m^2", -7},
    Unit{"kg mm^2", "kg m^2", -6},
    Unit{"m/s^2", "m/s^2"},
    Unit{"cm/s^2", "m/s^2", -2},
    Unit{"mm/s^2", "m/s^2", -3},
    Unit{"N m", "N m"},
    Unit{"Nm", "N m"},
    Unit{"kN m", "N m", 3},
    Unit{"mN m", "N m", -3},
    Unit{"N cm", "N m", -2},
    Unit{"N mm", "N m", -3},
    Unit{"kNm", "N m", 3},
    Unit{"mNm", "N m", -3},
    Unit{"s", "s"},
    Unit{"ms", "s", -3},
    Unit{"us", "s", -6},
    Unit{"min", "s", 0, 60.0L},
    Unit{"h", "s", 0, 3600.0L},
};

void replace_all(std::string& text, std::string_view from, std::string_view to) {
  for (auto at = text.find(from); at != std::string::npos; at = text.find(from, at + to.size())) {
    text.replace(at, from.size(), to);
  }
}

/// Other ways to write the same unit: m² for m^2, N*m and N·m for N m, µ for u.
std::string normalised(std::string_view unit) {
  std::string text(unit);
  replace_all(text, "\u00B2", "^2");
  replace_all(text, "\u00B7", " ");
  replace_all(text, "\u22C5", " ");
  replace_all(text, "\u00B5", "u");
  replace_all(text, "\u03BC", "u");
  replace_all(text, "*", " ");
  std::string result;
  for (const char c : text) {
    if (c != ' ' || (!result.empty() && result.back() != ' ')) result += c;
  }
  return std::string(trimmed(result));
}

/// Length of the number at the beginning of the text.
std::size_t number_length(std::string_view text) {
  std::size_t at = text.find_first_not_of("+-.0123456789");
  if (at == std::string_view::npos) return text.size();
  const bool exponent = text[at] == 'e' || text[at] == 'E';
  if (!exponent || at + 1 == text.size()) return at;
  const std::size_t digits = text[at + 1] == '+' || text[at + 1] == '-' ? at + 2 : at + 1;
  const std::size_t end = text.find_first_not_of("0123456789", digits);
  if (digits < text.size() && end != digits) at = end == std::string_view::npos ? text.size() : end;
  return at;
}

/// The decimal text times 10^shift, as text.
std::string shifted(const std::string& number, int shift) {
  if (shift == 0) return number;
  const auto mark = number.find_first_of("eE");
  if (mark == std::string::npos) return number + "e" + std::to_string(shift);
  const auto sign = number[mark + 1] == '+' ? mark + 2 : mark + 1;
  long exponent = 0;
  const auto [stop, error] = std::from_chars(number.data() + sign, number.data() + number.size(), exponent);
  if (error != std::errc{}) return number;  // so large that the shift does not matter
  return number.substr(0, mark) + "e" + std::to_string(exponent + shift);
}

std::string units_of(std::string_view dimension) {
  std::string list;
  for (const auto& unit : kUnits) {
    if (unit.dimension == dimension) list += (list.empty() ? "" : ", ") + std::string(unit.name);
  }
  return list;
}

const Unit& find_unit(const std::string& name, std::string_view text, std::string_view dimension) {
  const Unit* other = nullptr;
  std::vector<std::string> candidates;
  for (const auto& unit : kUnits) {
    if (unit.name == name && unit.dimension == dimension) return unit;
    if (unit.name == name) other = &unit;
    if (unit.dimension == dimension) candidates.emplace_back(unit.name);
  }
  const std::string start = "'" + printable(text) + "': ";
  if (dimension.empty()) throw InvalidInput(start + "the value has no dimension and takes no unit");
  const std::string wanted = "wanted is one of " + units_of(dimension);
  if (other != nullptr) {
    throw InvalidInput(start + "the unit '" + name + "' has the wrong dimension; " + wanted);
  }
  throw InvalidInput(start + "unknown unit '" + printable(name) + "'; " + wanted);
}

}  // namespace

double parse_quantity(std::string_view text, std::string_view dimension) {
  const auto all = trimmed(text);
  const std::string number(all.substr(0, number_length(all)));
  const std::string name = normalised(all.substr(number.size()));
  double value = 0.0;
  if (!parse_number(number, value)) {
    throw InvalidInput("'" + printable(text) + "' is not a finite decimal number" +
                       (dimension.empty() ? "" : ", alone or with a unit such as " + std::string(dimension)));
  }
  if (name.empty()) return value;
  const Unit& unit = find_unit(name, text, dimension);
  if (!parse_number(shifted(number, unit.shift), value)) value = HUGE_VAL;
  if (unit.factor != 1.0L) value = static_cast<double>(static_cast<long double>(value) * unit.factor);
  if (!std::isfinite(value)) throw InvalidInput("'" + printable(text) + "' is beyond the range of double");
  return value;
}

}  // namespace strutt
