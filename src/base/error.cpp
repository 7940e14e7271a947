#include "strutt/base/error.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstring>
#include <numeric>

namespace strutt {

InvalidInput::InvalidInput(std::string_view field, std::string_view value, std::string_view allowed)
    : std::invalid_argument(std::string(field) + " = " + std::string(value) + " is not allowed: it must be " +
                            std::string(allowed)) {}

InputOutputError::InputOutputError(const std::string& what, int error_number)
    : std::runtime_error(error_number == 0 ? what : what + ": " + std::strerror(error_number)),
      error_number_(error_number) {}

void require(bool valid, std::string_view field, double value, std::string_view allowed) {
  if (!valid) throw InvalidInput(field, to_text(value), allowed);
}

std::string to_text(double value) {
  if (std::isnan(value)) return "nan";
  char buffer[32];
  const auto end = std::to_chars(buffer, buffer + sizeof buffer, value).ptr;
  return {buffer, end};
}

namespace {

std::size_t edit_distance(std::string_view a, std::string_view b) {
  std::vector<std::size_t> row(b.size() + 1);
  std::iota(row.begin(), row.end(), std::size_t{0});
  for (std::size_t i = 1; i <= a.size(); ++i) {
    std::size_t diagonal = row[0];
    row[0] = i;
    for (std::size_t j = 1; j <= b.size(); ++j) {
      const std::size_t substitution = diagonal + (a[i - 1] == b[j - 1] ? 0 : 1);
      diagonal = row[j];
      row[j] = std::min({row[j] + 1, row[j - 1] + 1, substitution});
    }
  }
  return row.back();
}

}  // namespace

std::string nearest(std::string_view word, const std::vector<std::string>& candidates) {
  std::string best;
  std::size_t best_distance = word.size() / 2 + 1;
  for (const auto& candidate : candidates) {
    const std::size_t distance = edit_distance(word, candidate);
    if (distance < best_distance) {
      best_distance = distance;
      best = candidate;
    }
  }
  return best;
}

std::string quoted_list(const std::vector<std::string>& names) {
  constexpr std::size_t most = 12;
  std::string list;
  for (std::size_t i = 0; i < std::min(names.size(), most); ++i)
    list += (i == 0 ? "'" : ", '") + names[i] + "'";
  return names.size() > most ? list + ", ... (" + std::to_string(names.size()) + " in all)" : list;
}

std::string suggestion(std::string_view word, const std::vector<std::string>& known) {
  const std::string close = nearest(word, known);
  if (!close.empty()) return "; did you mean '" + close + "'?";
  return known.empty() ? "" : "; known are " + quoted_list(known);
}

}  // namespace strutt
