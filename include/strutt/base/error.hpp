#pragma once

#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

namespace strutt {

/// Misuse: a value that cannot be worked with. The message names the field, the value and the allowed range.
class InvalidInput : public std::invalid_argument {
 public:
  InvalidInput(std::string_view field, std::string_view value, std::string_view allowed);
  explicit InvalidInput(const std::string& message) : std::invalid_argument(message) {}
};

/// The work asked for does not fit into the memory budget; the message names the size and the budget.
class MemoryBudgetExceeded : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// A file cannot be read or written. `error_number` is the errno of the failed call (EPIPE: closed pipe).
class InputOutputError : public std::runtime_error {
 public:
  InputOutputError(const std::string& what, int error_number);
  int error_number() const noexcept { return error_number_; }

 private:
  int error_number_;
};

/// A computation as a whole has no meaningful result (single cells and rows report an Outcome instead).
class NumericalFailure : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Throws InvalidInput(field, value, allowed) unless `valid`. Write the test so that NaN fails it.
void require(bool valid, std::string_view field, double value, std::string_view allowed);

/// Shortest decimal text that reads back to the same double, for messages and files ("nan", "inf", "-inf").
std::string to_text(double value);

/// The candidate with the smallest edit distance to `word`, empty when none is closer than half of its
/// length.
std::string nearest(std::string_view word, const std::vector<std::string>& candidates);

/// "'a', 'b', 'c'"; of a long list the first twelve and the number of all.
std::string quoted_list(const std::vector<std::string>& names);

/// What to say behind an unknown `word`: "; did you mean 'mass'?" with the nearest of those known, else
/// "; known are 'length', 'mass'". Empty if nothing is known.
std::string suggestion(std::string_view word, const std::vector<std::string>& known);

}  // namespace strutt
