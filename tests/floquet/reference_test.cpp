// Accuracy against tables made in 100 digits by two independent methods (tests/reference).
#include <algorithm>
#include <catch2/catch.hpp>

#include "support/ratchet.hpp"
#include "support/reference.hpp"

namespace strutt::test::reference_test {

using strutt::test::check_within;

namespace {

struct Case {
  std::string table;
  Method method;
  double tolerance;
};

struct Tally {
  std::size_t rows = 0, sharp = 0, converged = 0;
};

/// Checks every row of a table and counts.
Tally check(const Case& c) {
  Tally tally;
  MonodromyEngine engine;
  // the remainders of power series are proven for all signs of their terms, those of SUNDIALS are estimates
  const double slack = c.method == Method::propagator || c.method == Method::automatic ? 4000.0 : 100.0;
  for (const auto& row : reference::read(c.table)) {
    const auto model = reference::model(c.table, row);
    const auto result = analyse(engine, model, {.tolerance = c.tolerance, .method = c.method});
    INFO(c.table << " row " << tally.rows << " " << to_string(c.method) << " tolerance " << c.tolerance);
    REQUIRE(result.matrix.size() > 0);
    const double truth = reference::true_error(model, result, row);
    CHECK(truth <= result.error);
    if (truth > 0.0)
      check_within("true error of M over its bound in table " + c.table, truth / result.error, 1.0);
    CHECK((result.outcome != Outcome::converged || result.error <= c.tolerance));
    CHECK((result.outcome == Outcome::converged || result.outcome == Outcome::tolerance_not_reached));
    tally.sharp += result.error <= slack * std::max(truth, 1e-15);
    tally.converged += result.outcome == Outcome::converged;
    ++tally.rows;
    if (!row.has("margin")) continue;

    const auto margin = row.result("margin");
    if (result.margin > kLowestMargin) {
      const auto error = static_cast<double>(reference::Real(abs(margin - result.margin)));
      CHECK(error <= result.margin_error);
      if (error > 0.0)
        check_within("true error of a margin over its bound", error / result.margin_error, 1.0);
    }
    const auto verdict = margin > 0 ? Verdict::stable : margin < 0 ? Verdict::unstable : Verdict::boundary;
    CHECK((result.verdict == verdict || result.verdict == Verdict::unresolved));
    CHECK((result.verdict == Verdict::unresolved) ==
          (std::abs(result.margin) <= result.margin_error && result.margin_error > 0.0));
  }
  return tally;
}

}  // namespace

TEST_CASE("The error bound is above the true error and sharp on the reference tables",
          "[floquet][reference][ratchet]") {
  const auto c = GENERATE(values<Case>({
      {"mathieu", Method::arkode, 1e-3},      {"mathieu", Method::arkode, 1e-6},
      {"mathieu", Method::arkode, 1e-9},      {"mathieu", Method::arkode, 1e-12},
      {"mathieu", Method::cvode, 1e-6},       {"mathieu", Method::propagator, 1e-2},
      {"mathieu", Method::propagator, 1e-4},  {"mathieu", Method::propagator, 1e-7},
      {"mathieu", Method::propagator, 1e-9},  {"mathieu", Method::automatic, 1e-12},
      {"mathieu", Method::automatic, 1e-13},  {"hill", Method::arkode, 1e-2},
      {"hill", Method::arkode, 1e-9},         {"hill", Method::arkode, 1e-12},
      {"hill", Method::cvode, 1e-6},          {"hill", Method::propagator, 1e-3},
      {"hill", Method::propagator, 1e-9},     {"hill", Method::automatic, 1e-12},
      {"square", Method::automatic, 1e-13},   {"square", Method::arkode, 1e-9},
      {"square", Method::propagator, 1e-9},   {"pendulum", Method::arkode, 1e-3},
      {"pendulum", Method::arkode, 1e-9},     {"pendulum", Method::arkode, 1e-12},
      {"pendulum", Method::cvode, 1e-6},      {"pendulum", Method::propagator, 1e-5},
      {"pendulum", Method::propagator, 1e-9}, {"pendulum", Method::automatic, 1e-12},
      {"linear4", Method::automatic, 1e-6},   {"linear4", Method::automatic, 1e-9},
      {"linear4", Method::cvode, 1e-6},       {"linear4", Method::arkode, 1e-6},
      {"linear4", Method::arkode, 1e-9},      {"linear4", Method::propagator, 1e-2},
      {"linear4", Method::propagator, 1e-4},  {"linear4", Method::propagator, 1e-7},
      {"linear4", Method::propagator, 1e-12},
  }));
  const auto tally = check(c);
  CAPTURE(c.table, to_string(c.method), c.tolerance);
  CHECK(tally.rows >= 16);
  CHECK(2 * tally.sharp >= tally.rows);
  // what is expected to reach the tolerance: everything but long phases at the finest tolerances
  const std::size_t share = c.tolerance >= 1e-9 ? 10 : c.tolerance >= 1e-12 ? 8 : 1;
  CHECK(tally.converged >= share * tally.rows / 10);
}

TEST_CASE("Trace of the Mathieu equation at (1, 0.5)", "[floquet][reference][ratchet]") {
  MonodromyEngine engine;
  const double trace = 2.021314397416841636175261493894996;  // tests/reference/mathieu.csv, first row
  for (const Method method : {Method::arkode, Method::cvode, Method::propagator}) {
    const auto result =
        analyse(engine, mathieu_delta_epsilon(1.0, 0.5), {.tolerance = 1e-12, .method = method});
    CHECK(std::abs(result.discriminant - trace) <=
          result.error * std::max(1.0, result.matrix.cwiseAbs().maxCoeff()));
    if (method != Method::cvode) {
      CHECK(result.outcome == Outcome::converged);
      check_within("D of Mathieu's equation at (1 0.5) by ARKODE and Taylor series at tolerance 1e-12",
                   std::abs(result.discriminant - trace), 8e-15);
    }
  }
}

}  // namespace strutt::test::reference_test
