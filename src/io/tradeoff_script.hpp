#pragma once

#include <string>

#include "io/figure_format.hpp"
#include "strutt/chart/tradeoff.hpp"

namespace strutt {

/// The rows for gnuplot, one block a method in the order of the rows, `true_error points_per_second tolerance
/// error label` a line, then a block `true_error points_per_second` with the front of Pareto by rising error.
/// Rows without an error are left out; the label is that of every third decade of the tolerance.
inline constexpr const char* kTradeoffFile = "tradeoff.dat";
std::string tradeoff_data(const Tradeoff& tradeoff);

/// The gnuplot script.
std::string tradeoff_script(const Tradeoff& tradeoff, const std::string& title, FigureFormat format);

}  // namespace strutt
