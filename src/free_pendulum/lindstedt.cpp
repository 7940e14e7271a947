#include "free_pendulum/lindstedt.hpp"

namespace strutt {
namespace {

/// A cosine sum c_0 + c_1 cos tau + c_2 cos 2 tau + ...
using Cosines = std::vector<Exact>;

/// Adds a b to the sum: cos i cos j = (cos(i - j) + cos(i + j))/2.
void add_product(Cosines& sum, const Cosines& a, const Cosines& b) {
  if (sum.size() < a.size() + b.size()) sum.resize(a.size() + b.size());
  for (std::size_t i = 0; i < a.size(); ++i) {
    for (std::size_t j = 0; j < b.size(); ++j) {
      const Exact half = a[i] * b[j] / 2;
      if (half == 0) continue;
      sum[i + j] += half;
      sum[i > j ? i - j : j - i] += half;
    }
  }
}

/// phi and its powers, order by order in A.
class Expansion {
 public:
  Expansion(const Series& force, int order)
      : force_(force),
        squared_(static_cast<std::size_t>(order) + 1),
        powers_(force.size(), std::vector<Cosines>(static_cast<std::size_t>(order) + 2)) {
    squared_[0] = 1;
    powers_[1][1] = {0, 1};
  }

  /// Order n + 1 of omega^2 phi'' + phi + f(phi) = 0 (' = d/dtau) reads
  /// phi_(n+1)'' + phi_(n+1) = -squared_[n] phi_1'' - sum_(m=2..n) squared_[n+1-m] phi_m'' - f_(n+1).
  void advance(std::size_t n) {
    Cosines right = known_terms(n);
    right.resize(std::max<std::size_t>(right.size(), 2));
    squared_[n] = -right[1];  // -squared_[n] phi_1'' = squared_[n] cos tau removes the resonance
    Cosines& phi = powers_[1][n + 1];
    phi.assign(right.size(), 0);
    for (std::size_t k = 0; k < right.size(); ++k) {
      if (k == 1) continue;
      phi[k] = right[k] / (1 - static_cast<long>(k * k));
      phi[1] -= phi[k];  // phi_(n+1)(0) = 0
    }
  }

  const Series& frequency_squared() const { return squared_; }

 private:
  Cosines known_terms(std::size_t n) {
    Cosines right;
    for (std::size_t m = 2; m <= n; ++m) {
      const Cosines& phi = powers_[1][m];
      if (right.size() < phi.size()) right.resize(phi.size());
      for (std::size_t k = 0; k < phi.size(); ++k) right[k] += squared_[n + 1 - m] * phi[k] * (k * k);
    }
    for (std::size_t p = 2; p <= n + 1 && p < force_.size(); ++p) {
      update_power(p, n + 1);
      const Cosines& power = powers_[p][n + 1];
      if (right.size() < power.size()) right.resize(power.size());
      for (std::size_t k = 0; k < power.size(); ++k) right[k] -= force_[p] * power[k];
    }
    return right;
  }

  /// Order `total` of phi^p = phi phi^(p-1).
  void update_power(std::size_t p, std::size_t total) {
    for (std::size_t m = 1; m + p - 1 <= total; ++m)
      add_product(powers_[p][total], powers_[1][m], powers_[p - 1][total - m]);
  }

  const Series& force_;
  Series squared_;
  std::vector<std::vector<Cosines>> powers_;  // [p][m]: order m of phi^p
};

}  // namespace

Series lindstedt_frequency_squared(const Series& force, int order) {
  Expansion expansion(force, order);
  for (std::size_t n = 1; n <= static_cast<std::size_t>(order); ++n) expansion.advance(n);
  return expansion.frequency_squared();
}

}  // namespace strutt
