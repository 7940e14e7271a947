#pragma once

#include <boost/multiprecision/cpp_bin_float.hpp>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "strutt/floquet/stability.hpp"

/// Reading of the multi-precision tables in tests/reference, and the true errors of results against them.
namespace reference {

using Real = boost::multiprecision::cpp_bin_float_50;

/// One row of a table: the inputs are exact doubles, the results have 40 digits.
class Row {
 public:
  explicit Row(std::map<std::string, std::string> cells) : cells_(std::move(cells)) {}
  const std::string& text(const std::string& column) const { return cells_.at(column); }
  bool has(const std::string& column) const { return cells_.count(column) > 0; }
  double input(const std::string& column) const;
  Real result(const std::string& column) const { return Real(text(column)); }

 private:
  std::map<std::string, std::string> cells_;
};

std::vector<Row> read(const std::string& table);  ///< "mathieu" -> tests/reference/mathieu.csv

/// The model of a row of mathieu, hill, square, pendulum or linear4.
strutt::LinearModel model(const std::string& table, const Row& row);

/// The scaled error (docs/conventions.md) of a result against its row, in more than double precision.
double true_error(const strutt::LinearModel& model, const strutt::Stability& result, const Row& row);

}  // namespace reference
