// Laws that every model and every method must obey, each within the error bounds that the results themselves
// state.
#include <Eigen/LU>
#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <numeric>
#include <random>

#include "floquet/every_model.hpp"
#include "support/ratchet.hpp"

namespace strutt::test::laws_test {

namespace {

constexpr double kUnit = 0x1p-53;

/// A value and a bound of its error.
struct Bounded {
  double value = 0.0, error = 0.0;
};

/// Integral of the trace of A over one period: the logarithm of det M.
double log_determinant(const LinearModel& model) {
  if (const auto* equation = std::get_if<HillEquation>(&model))
    return -equation->damping * equation->period();
  const auto& system = std::get<LinearPeriodicSystem>(model);
  return system.has_damping() ? -system.period * (system.mass.inverse() * system.damping.mean).trace() : 0.0;
}

/// The minor of the given rows = columns, with what the entries' errors can change in it: the determinant is
/// a sum of products, so its error is at most perm(|M| + E) - perm(|M|), perm being the permanent.
Bounded principal_minor(const Plain& m, const std::vector<int>& rows) {
  std::vector<int> columns = rows;
  Bounded result;
  double permanent = 0.0;
  do {
    double product = 1.0, least = 1.0, most = 1.0;
    int inversions = 0;
    for (std::size_t i = 0; i < rows.size(); ++i) {
      const double entry = m.value(rows[i], columns[i]);
      product *= entry, least *= std::abs(entry), most *= std::abs(entry) + m.error(rows[i], columns[i]);
      for (std::size_t j = 0; j < i; ++j) inversions += columns[j] > columns[i];
    }
    result.value += inversions % 2 == 0 ? product : -product;
    result.error += most - least;
    permanent += most;
  } while (std::next_permutation(columns.begin(), columns.end()));
  // rounding of up to 24 sums of up to 4 products, and of `most - least`
  result.error += 32.0 * kUnit * permanent;
  return result;
}

/// e_k, k = 1..n: the elementary symmetric functions of the multipliers (trace, ..., determinant).
std::vector<Bounded> symmetric_functions(const BoundedMatrix& matrix) {
  const auto m = plain(matrix);
  const int n = static_cast<int>(m.value.rows());
  std::vector<Bounded> result(static_cast<std::size_t>(n));
  for (unsigned subset = 1; subset < 1U << n; ++subset) {
    std::vector<int> rows;
    for (int i = 0; i < n; ++i) {
      if ((subset >> i & 1U) != 0) rows.push_back(i);
    }
    const auto minor = principal_minor(m, rows);
    result[rows.size() - 1].value += minor.value;
    result[rows.size() - 1].error += minor.error + 8.0 * kUnit * std::abs(minor.value);
  }
  return result;
}

}  // namespace

TEST_CASE("det M is the exponential of the integral of the trace", "[floquet][law][ratchet]") {
  on_every_model([](const ModelCase& entry, Method, const Monodromy& m) {
    const auto determinant = symmetric_functions(m.matrix).back();
    const double expected = std::exp(log_determinant(entry.model));
    CHECK(std::abs(determinant.value - expected) <= determinant.error + 8.0 * kUnit * expected);
    check_within("bound of det M at tolerance 1e-9 (relative)", determinant.error / expected, 1.2e-5);
    check_within("|det - 1| of integrated pieces at tolerance 1e-9", m.determinant_defect, 3e-10);
  });
}

TEST_CASE("Multipliers come in reciprocal pairs where the structure demands it", "[floquet][law]") {
  on_every_model([](const ModelCase& entry, Method, const Monodromy& m) {
    const auto e = symmetric_functions(m.undamped);
    const std::size_t n = e.size();
    bool violated = false;
    for (std::size_t k = 1; k < n; ++k) {
      const auto &a = e[k - 1], &b = e[n - k - 1];
      const double gap = std::abs(a.value - b.value);
      if (entry.reciprocal) CHECK(gap <= a.error + b.error);
      violated = violated || gap > 100.0 * (a.error + b.error);
    }
    CHECK(violated == !entry.reciprocal);
    if (!entry.reciprocal) return;
    const auto multipliers = system_multipliers(m.undamped);
    for (const auto& a : multipliers) {
      CHECK(std::any_of(multipliers.begin(), multipliers.end(), [&](const Multiplier& b) {
        const double allowed = a.log_modulus_error + b.log_modulus_error;
        return std::abs(a.log_modulus + b.log_modulus) <= allowed &&
               (allowed >= 1.0 || std::abs(a.direction * b.direction - 1.0) <= 2.0 * allowed);
      }));
    }
  });
}

TEST_CASE("Multipliers do not depend on where the period begins", "[floquet][law]") {
  std::mt19937_64 random(3);
  std::uniform_real_distribution<double> phase(-4.0, 4.0);
  on_every_model([&](const ModelCase& entry, Method method, const Monodromy& m) {
    const double by = phase(random);
    const auto other = computed(
        std::visit([by](const auto& e) { return LinearModel(shifted(e, by)); }, entry.model), method);
    const auto a = symmetric_functions(m.matrix), b = symmetric_functions(other.matrix);
    for (std::size_t k = 0; k < a.size(); ++k)
      CHECK(std::abs(a[k].value - b[k].value) <= a[k].error + b[k].error);
    if (!is_constant(entry.model) && entry.name.find("tiny") == std::string::npos) {
      CHECK((plain(m.matrix).value - plain(other.matrix).value).cwiseAbs().maxCoeff() >
            1e-4);  // M itself does
    }
  });
}

TEST_CASE("The multipliers' product is det M and their sum the trace", "[floquet][law]") {
  on_every_model([](const ModelCase& entry, Method method, const Monodromy& m) {
    double log_product = 0.0, log_error = 1e-13, sum_error = 0.0;
    std::complex<double> sum = 0.0, direction = 1.0;
    const auto e = symmetric_functions(m.matrix);
    for (const auto& multiplier : system_multipliers(m.matrix)) {
      log_product += multiplier.log_modulus;
      log_error += multiplier.log_modulus_error;
      sum += std::exp(multiplier.log_modulus) * multiplier.direction;
      sum_error += std::exp(multiplier.log_modulus) * multiplier.log_modulus_error;
      direction *= multiplier.direction;
    }
    CHECK(std::abs(log_product - log_determinant(entry.model)) <= log_error);
    CHECK(std::abs(sum - e.front().value) <= sum_error + e.front().error);
    CHECK(std::abs(direction - 1.0) <= log_error);

    // and so are those of the result as a whole, formed by closed forms for 2 x 2
    MonodromyEngine engine;
    const auto s = analyse(engine, entry.model, {.tolerance = 1e-9, .method = method});
    const auto total = std::accumulate(s.multipliers.begin(), s.multipliers.end(), std::complex<double>(0.0));
    const double size = std::max(1.0, plain(m.matrix).value.cwiseAbs().maxCoeff());
    CHECK(std::abs(total - s.discriminant) <=
          1e-13 * size + (s.multipliers.size() > 2 ? sum_error : s.error * size));
    CHECK(std::abs(s.growth - std::log(std::abs(s.multipliers.front()))) <=
          1e-13 * std::max(1.0, std::abs(s.growth)) + (s.multipliers.size() > 2 ? log_error : 0.0));
  });
}

}  // namespace strutt::test::laws_test
