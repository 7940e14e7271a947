#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "commands.hpp"
#include "rows.hpp"
#include "scene_arguments.hpp"
#include "signals.hpp"
#include "strutt/base/error.hpp"
#include "strutt/base/parallel.hpp"
#include "strutt/floquet/characteristic_values.hpp"
#include "terminal.hpp"

namespace strutt::app {
namespace {

constexpr const char* kModel = "x'' + (a - 2 q cos 2t) x = 0";

struct Orders {
  int first = 0;
  int last = 0;
};

Orders orders_of(const std::string& text) {
  const auto parts = split(text, ':');
  if (parts.size() != 2) throw UsageError("--order " + text + ": wanted is A:B, 0 <= A <= B <= 10000");
  const auto first = count_of("--order", parts[0], 0, kLargestCharacteristicOrder);
  const auto last = count_of("--order", parts[1], 0, kLargestCharacteristicOrder);
  if (last < first) throw UsageError("--order " + text + ": B must be A to 10000");
  return {static_cast<int>(first), static_cast<int>(last)};
}

std::vector<double> parameters_of(const std::string& text) {
  std::vector<double> values;
  for (const auto& part : split(text, ',')) {
    const double q = quantity_of("--q", part, "");
    if (!(std::abs(q) <= kLargestCharacteristicParameter))
      throw UsageError("--q " + part + ": must be -1e8 to 1e8");
    values.push_back(q);
  }
  return values;
}

/// The table in parts that take a few milliseconds each, so that a signal is heard soon: a part is a range of
/// orders at one q.
struct Part {
  double q;
  Orders orders;
  std::vector<CharacteristicPair> pairs = {};
};

std::vector<Part> parts_of(const Orders& orders, const std::vector<double>& parameters) {
  constexpr int kOrders = 64;
  std::vector<Part> parts;
  for (const double q : parameters) {
    for (int first = orders.first; first <= orders.last; first += kOrders)
      parts.push_back({q, {first, std::min(first + kOrders - 1, orders.last)}});
  }
  return parts;
}

void write_part(RowWriter& writer, const Part& part) {
  for (const auto& pair : part.pairs) {
    std::vector<Cell> row{static_cast<double>(pair.order), part.q, pair.a.value, {}, pair.a.error, {}};
    if (pair.b) {
      row[3] = pair.b->value;
      row[5] = pair.b->error;
    }
    writer.write(row);
  }
}

}  // namespace

ExitCode run(const CharacteristicArguments& arguments) {
  if (arguments.tolerance)
    throw UsageError("--tolerance is not for characteristic, which computes to full double precision");
  method_of(arguments, "characteristic", {Method::fourier});
  const ParallelOptions options{.threads = threads_of(arguments), .cancel = &cancel_flag()};
  const Orders orders = orders_of(arguments.order);
  const std::vector<double> parameters = parameters_of(arguments.q);
  const auto rows = static_cast<std::size_t>(orders.last - orders.first + 1) * parameters.size();
  if (arguments.dry_run) {
    print_plan(kModel, {fmt::format("rows: {}", rows), "method: fourier",
                        fmt::format("threads: {}", thread_count(options))});
    return ExitCode::done;
  }
  require_memory(arguments, static_cast<double>(rows * sizeof(CharacteristicPair)));
  install_signal_handlers();
  std::vector<Part> parts = parts_of(orders, parameters);
  parallel_for(parts.size(), options, [&](std::size_t i, int) {
    parts[i].pairs = characteristic_values(parts[i].orders.first, parts[i].orders.last, parts[i].q);
  });
  throw_if_interrupted();
  Provenance provenance = make_provenance(arguments.command);
  provenance.emplace_back("model", kModel);
  provenance.emplace_back("method", to_string(Method::fourier));
  RowWriter writer(row_path(arguments), arguments.json,
                   {{"order", "1"}, {"q", "1"}, {"a", "1"}, {"b", "1"}, {"a_error", "1"}, {"b_error", "1"}},
                   provenance);
  for (const Part& part : parts) write_part(writer, part);
  writer.commit();
  return ExitCode::done;
}

}  // namespace strutt::app
