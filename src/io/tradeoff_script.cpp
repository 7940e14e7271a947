#include "io/tradeoff_script.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <vector>

#include "io/gnuplot.hpp"

namespace strutt {
namespace {

constexpr double kLeastError = 1e-17;

/// Okabe and Ito's colours.
const char* colour_of(Method method) {
  switch (method) {
    case Method::propagator:
      return "#0072B2";
    case Method::arkode:
      return "#D55E00";
    case Method::cvode:
      return "#CC79A7";
    case Method::exact:
      return "#009E73";
    case Method::surrogate:
      return "#E69F00";
    case Method::fourier:
      return "#56B4E9";
    case Method::automatic:
      break;
  }
  return "#000000";
}

bool is_drawn(const TradeoffRow& row) { return std::isfinite(row.true_error) && row.points_per_second > 0.0; }

/// The methods that have a row to draw, in the order of the rows.
std::vector<Method> methods_of(const Tradeoff& tradeoff) {
  std::vector<Method> methods;
  for (const auto& row : tradeoff.rows) {
    if (is_drawn(row) && std::find(methods.begin(), methods.end(), row.method) == methods.end())
      methods.push_back(row.method);
  }
  return methods;
}

std::string error_text(double error) {
  return std::isfinite(error) ? fmt::format("{:.6g}", std::max(error, kLeastError)) : "NaN";
}

/// The exponent of 1e-3, 1e-6, ...; an empty text for other tolerances.
std::string exponent_of(double tolerance) {
  const double decade = std::round(std::log10(tolerance));
  const bool labelled =
      std::abs(tolerance / std::pow(10.0, decade) - 1.0) < 1e-9 && std::fmod(decade, 3.0) == 0.0;
  return labelled ? fmt::format("\u2212{:.0f}", -decade) : "";
}

/// So near to each other in the figure that their labels would overlap.
bool are_near(const TradeoffRow& a, const TradeoffRow& b) {
  const auto near = [](double x, double y) { return std::abs(std::log10(x / y)) < 0.5; };
  return near(std::max(a.true_error, kLeastError), std::max(b.true_error, kLeastError)) &&
         near(a.points_per_second, b.points_per_second);
}

/// One label per row, empty for most; rows that lie on each other share the label of the first, with the
/// exponents from first to last.
std::vector<std::string> labels_of(const std::vector<TradeoffRow>& rows) {
  std::vector<std::string> labels(rows.size());
  std::size_t first = rows.size();  // that has a label
  std::string begin;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const std::string own = exponent_of(rows[i].tolerance);
    if (own.empty()) continue;
    const bool shared = first < rows.size() && are_near(rows[first], rows[i]);
    if (!shared) {
      first = i;
      begin = own;
    }
    labels[first] = "10^{" + (shared ? begin + "\u2026" + own : own) + "}";
  }
  return labels;
}

std::string block_of(const std::vector<TradeoffRow>& rows) {
  const auto labels = labels_of(rows);
  std::string text;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    text += fmt::format("{} {:.6g} {:.6g} {} \"{}\"\n", error_text(rows[i].true_error),
                        rows[i].points_per_second, rows[i].tolerance, error_text(rows[i].error), labels[i]);
  }
  return text;
}

/// The whole decades that hold all of `values`; values that are not positive and finite do not count.
struct Decades {
  int from = -1, to = 0;
};
Decades decades_of(const std::vector<double>& values) {
  double least = INFINITY, most = 0.0;
  for (const double value : values) {
    if (!std::isfinite(value) || value <= 0.0) continue;
    least = std::min(least, value);
    most = std::max(most, value);
  }
  if (most == 0.0) return {};
  const int from = static_cast<int>(std::floor(std::log10(least)));
  return {from, std::max(static_cast<int>(std::ceil(std::log10(most))), from + 1)};
}

std::string range_of(char axis, const Decades& decades) {
  const int step = decades.to - decades.from > 8 ? 100 : 10;
  return fmt::format("set {0}range [1e{1}:1e{2}]\nset {0}tics {3}\n", axis, decades.from, decades.to, step);
}

std::string frame(const std::string& title, FigureFormat format) {
  return fmt::format(
      "set encoding utf8\nset terminal {}\nset output '{}'\n"
      "set multiplot title {} noenhanced\n"
      "set border 15 linewidth 0.7 front\nset tics front out nomirror\nset grid linewidth 0.5 linetype 1 "
      "linecolor rgb "
      "'#D0D0D0'\nset logscale xy\nset mxtics 1\nset mytics 1\nset format xy '10^{{%T}}'\nset minussign\n"
      "set bmargin at screen 0.11\nset tmargin at screen 0.86\n",
      gnuplot_terminal(format), kPictureFile, gnuplot_string(title));
}

/// The curves of one panel; `index` counts the blocks of the data.
template <typename Curve>
std::string plot_of(const std::vector<Method>& methods, std::vector<std::string> curves, const Curve& curve) {
  for (std::size_t index = 0; index < methods.size(); ++index) curve(curves, index, methods[index]);
  return fmt::format("plot {}\n", fmt::join(curves, ", "));
}

/// The rings of `automatic`, with their labels above; next to the left edge of the panel, to the right.
std::string rings(std::size_t index, const Decades& across) {
  const double edge = std::pow(10.0, across.from + 0.06 * (across.to - across.from));
  return fmt::format(
      "'{0}' index {1} using 1:2 with points pointtype 6 pointsize 2.4 linewidth 1.2 linecolor rgb '{2}' "
      "title 'auto, at its tolerance', "
      "'{0}' index {1} using ($1 < {3:.3g} ? NaN : $1):2:5 with labels center offset 0,1 notitle, "
      "'{0}' index {1} using ($1 < {3:.3g} ? $1 : NaN):2:5 with labels left offset -0.3,1.2 notitle",
      kTradeoffFile, index, colour_of(Method::automatic), edge);
}

std::string speed_panel(const Tradeoff& tradeoff, const std::vector<Method>& methods) {
  std::vector<double> errors, rates;
  for (const auto& row : tradeoff.rows) {
    if (!is_drawn(row)) continue;
    errors.push_back(std::max(row.true_error, kLeastError));
    rates.push_back(row.points_per_second);
  }
  const Decades across = decades_of(errors);
  Decades up = decades_of(rates);
  up.to += std::max((up.to - up.from + 1) / 3, 1);  // room for the key
  std::string text =
      "set title 'Speed of one thread'\nset xlabel 'largest true error'\nset ylabel 'points per second' "
      "offset 1,0\n"
      "set lmargin at screen 0.085\nset rmargin at screen 0.48\nset key at graph 0.03,0.98 left top Left "
      "reverse samplen 2 spacing 1.15\n" +
      range_of('x', across) + range_of('y', up);
  const std::string front = fmt::format(
      "'{}' index {} using 1:2 with steps linewidth 9 linecolor rgb '#D8D8D8' title 'front of Pareto'",
      kTradeoffFile, methods.size());
  return text + plot_of(methods, {front}, [&](auto& curves, std::size_t index, Method method) {
           if (method == Method::automatic) return curves.push_back(rings(index, across));
           curves.push_back(
               fmt::format("'{}' index {} using 1:2 with linespoints linewidth 1.5 pointtype 7 pointsize 0.9 "
                           "linecolor rgb "
                           "'{}' title '{}'",
                           kTradeoffFile, index, colour_of(method), to_string(method)));
         });
}

std::string error_panel(const Tradeoff& tradeoff, const std::vector<Method>& methods) {
  std::vector<double> errors, tolerances;
  for (const auto& row : tradeoff.rows) {
    if (!is_drawn(row)) continue;
    errors.insert(errors.end(), {std::max(row.true_error, kLeastError), row.error, row.tolerance});
    tolerances.push_back(row.tolerance);
  }
  std::string text =
      "set title 'What a tolerance brings'\nset xlabel 'tolerance asked for'\n"
      "set ylabel 'largest error: true (solid), bound (dashed)' offset 0.5,0\n"
      "set lmargin at screen 0.595\nset rmargin at screen 0.97\nset key at graph 0.03,0.98\n" +
      range_of('x', decades_of(tolerances)) + range_of('y', decades_of(errors));
  return text +
         plot_of(methods, {"x with lines linewidth 1 linecolor rgb '#808080' title 'error = tolerance'"},
                 [](auto& curves, std::size_t index, Method method) {
                   if (method == Method::automatic) return;  // one of the others
                   curves.push_back(fmt::format(
                       "'{0}' index {1} using 3:1 with linespoints linewidth 1.5 pointtype 7 pointsize 0.9 "
                       "linecolor rgb '{2}' title '{3}', '{0}' index {1} using 3:4 with lines linewidth 1.5 "
                       "dashtype (8,5) linecolor rgb '{2}' notitle",
                       kTradeoffFile, index, colour_of(method), to_string(method)));
                 });
}

}  // namespace

std::string tradeoff_data(const Tradeoff& tradeoff) {
  const auto chosen = [&](const auto& condition) {
    std::vector<TradeoffRow> rows;
    std::copy_if(tradeoff.rows.begin(), tradeoff.rows.end(), std::back_inserter(rows),
                 [&](const TradeoffRow& row) { return is_drawn(row) && condition(row); });
    return rows;
  };
  std::string text;
  for (const Method method : methods_of(tradeoff)) {
    text += block_of(chosen([&](const TradeoffRow& row) { return row.method == method; })) + "\n\n";
  }
  auto front = chosen([](const TradeoffRow& row) { return row.pareto; });
  std::sort(front.begin(), front.end(),
            [](const auto& a, const auto& b) { return a.true_error < b.true_error; });
  for (const auto& row : front)
    text += fmt::format("{} {:.6g}\n", error_text(row.true_error), row.points_per_second);
  // Any larger error is had as fast as the last one.
  if (!front.empty()) text += fmt::format("1 {:.6g}\n", front.back().points_per_second);
  return text;
}

std::string tradeoff_script(const Tradeoff& tradeoff, const std::string& title, FigureFormat format) {
  const auto methods = methods_of(tradeoff);
  return frame(title, format) + speed_panel(tradeoff, methods) + error_panel(tradeoff, methods) +
         "unset multiplot\nunset output\n";
}

}  // namespace strutt
