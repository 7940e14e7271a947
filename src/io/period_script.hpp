#pragma once

#include <string>
#include <vector>

#include "io/figure_format.hpp"
#include "strutt/io/period_figure.hpp"

namespace strutt {

/// The samples for gnuplot, `amplitude exact krylov error krylov_squared error` a line, in the order given.
inline constexpr const char* kPeriodFile = "period.dat";
std::string period_data(const std::vector<PeriodSample>& samples);

/// The decades of the axis of errors: all errors but those of exactly 0, at most from 1e-10 to 10.
struct Decades {
  int from = -1;
  int to = 0;
};
Decades error_decades(const std::vector<PeriodSample>& samples);

/// The gnuplot script.
std::string period_script(const std::vector<PeriodSample>& samples, FigureFormat format);

}  // namespace strutt
