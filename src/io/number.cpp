#include <charconv>
#include <cmath>

#include "io/text.hpp"
#include "strutt/io/table.hpp"

namespace strutt {
namespace {

/// What the grammar [+-] digits [. digits] [e [+-] digits] finds in a text.
struct Decimal {
  bool valid = false;
  long magnitude =
      0;  ///< of the first digit that is not 0, as a power of ten; meaningless if all digits are 0
  bool zero = true;
};

constexpr long kExponentCap = 1'000'000'000;

/// The exponent part at `p`; returns false if it is malformed.
bool scan_exponent(const char* p, const char* end, long& exponent) {
  const bool negative = p != end && *p == '-';
  if (p != end && (*p == '-' || *p == '+')) ++p;
  if (p == end) return false;
  for (; p != end; ++p) {
    if (!is_digit(*p)) return false;
    if (exponent < kExponentCap) exponent = 10 * exponent + (*p - '0');
  }
  if (negative) exponent = -exponent;
  return true;
}

Decimal scan(const char* p, const char* end) {
  Decimal result;
  long digits = 0, before_point = -1, first = -1;  // first: index of the first digit that is not 0
  for (; p != end && *p != 'e' && *p != 'E'; ++p) {
    if (*p == '.' && before_point < 0) {
      before_point = digits;
      continue;
    }
    if (!is_digit(*p)) return result;
    if (*p != '0' && first < 0) first = digits;
    ++digits;
  }
  if (digits == 0) return result;
  long exponent = 0;
  if (p != end && !scan_exponent(p + 1, end, exponent)) return result;
  result.valid = true;
  result.zero = first < 0;
  result.magnitude = (before_point < 0 ? digits : before_point) - first + exponent;
  return result;
}

}  // namespace

bool parse_number(const std::string& text, double& value) {
  const char* begin = text.data();
  const char* const end = begin + text.size();
  const bool negative = begin != end && *begin == '-';
  if (begin != end && (*begin == '-' || *begin == '+')) ++begin;
  const Decimal decimal = scan(begin, end);
  if (!decimal.valid) return false;
  double result = 0.0;
  if (!decimal.zero) {
    const auto [stop, error] = std::from_chars(begin, end, result);
    if (error == std::errc::result_out_of_range) {
      // Libraries differ in what they store here; only an overflow is an error, an underflow rounds to 0.
      if (decimal.magnitude > 0) return false;
      result = 0.0;
    } else if (error != std::errc{} || stop != end || !std::isfinite(result)) {
      return false;
    }
  }
  value = negative ? -result : result;
  return true;
}

}  // namespace strutt
