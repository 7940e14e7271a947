#include "chart/reference_monodromy.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace strutt::judge {
namespace {

constexpr int kOrder = 60;
constexpr double kLogNegligible = -42.0;  // of the last terms against the largest, in decades
constexpr int kMostReferenceSteps = 200'000;

// Bounds of a step before the last terms are looked at: the solution turns or grows by kRadians, the highest
// harmonic turns by kPhase.
constexpr double kRadians = 4.0, kPhase = 1.5;

/// The entries of a matrix that are not zero.
struct Entry {
  int row, column;
  Real value;
};
using Sparse = std::vector<Entry>;

void append(Sparse& entries, const Matrix& matrix, const Real& factor) {
  for (int i = 0; i < matrix.rows; ++i) {
    for (int j = 0; j < matrix.columns; ++j) {
      if (matrix(i, j) != 0 && factor != 0) entries.push_back({i, j, factor * matrix(i, j)});
    }
  }
}

/// Taylor coefficients in s of scale * sum of terms at theta = start + h s.
std::vector<Sparse> series_of(const std::vector<Term>& terms, const Real& start, const Real& h,
                              const Real& scale) {
  const bool constant =
      std::all_of(terms.begin(), terms.end(), [](const Term& term) { return term.order == 0; });
  std::vector<Sparse> result(constant ? 1 : kOrder);
  for (const Term& term : terms) {
    const Real c = cos(term.order * start), s = sin(term.order * start);
    const Real derivatives[4] = {c, -s, -c, s};  // of the cosine, one after the other; the sine lags by one
    Real power = scale;
    const int last = term.order == 0 ? 1 : kOrder;
    for (int j = 0; j < last; ++j) {
      append(result[static_cast<std::size_t>(j)], term.cosine, power * derivatives[j % 4]);
      append(result[static_cast<std::size_t>(j)], term.sine, power * derivatives[(j + 3) % 4]);
      power *= term.order * h / (j + 1);
    }
  }
  return result;
}

/// result += factor * entries * block
void add_product(Matrix& result, const Sparse& entries, const Matrix& block, int factor) {
  for (const auto& [row, column, value] : entries) {
    for (int j = 0; j < block.columns; ++j) result(row, j) += factor * value * block(column, j);
  }
}

/// The series of q in s, from q and h dq/dtheta: order k + 2 by
///   (k+2)(k+1) q_{k+2} = -sum_j [(k-j+1) h C_j q_{k-j+1} + h^2 K_j q_{k-j}].
std::vector<Matrix> solution_series(const std::vector<Sparse>& damping, const std::vector<Sparse>& stiffness,
                                    Matrix value, Matrix slope) {
  std::vector<Matrix> q;
  const int rows = value.rows, columns = value.columns;
  q.push_back(std::move(value));
  q.push_back(std::move(slope));
  for (int k = 0; k < kOrder; ++k) {
    Matrix sum(rows, columns);
    for (int j = 0; j <= k; ++j) {
      const auto index = static_cast<std::size_t>(j), rest = static_cast<std::size_t>(k - j);
      if (index < stiffness.size()) add_product(sum, stiffness[index], q[rest], 1);
      if (index < damping.size()) add_product(sum, damping[index], q[rest + 1], k - j + 1);
    }
    for (Real& x : sum.entries) x /= -(k + 2) * (k + 1);
    q.push_back(std::move(sum));
  }
  return q;
}

/// The share of the step at which the last terms of every column are negligible.
Real usable_share(const std::vector<Matrix>& q) {
  double share = 1.0;
  for (int j = 0; j < q.front().columns; ++j) {
    Real largest = 0, last = 0;
    for (std::size_t k = 0; k < q.size(); ++k) {
      for (int i = 0; i < q[k].rows; ++i) {
        const Real size = abs(q[k](i, j));
        if (size > largest) largest = size;
        if (k + 2 >= q.size() && size > last) last = size;
      }
    }
    if (last == 0) continue;
    const double decades = static_cast<double>(Real(log10(last / largest)));
    share = std::min(share, std::pow(10.0, (kLogNegligible - decades) / kOrder));
  }
  return share;
}

/// How fast the coefficients let a solution change, and how fast they change themselves.
struct Rates {
  double solution = 0.0;
  int highest = 0;
};

double size_of(const std::vector<Term>& terms, int& highest) {
  Real size = 0;
  for (const Term& term : terms) {
    highest = std::max(highest, term.order);
    for (const Matrix* part : {&term.cosine, &term.sine}) {
      for (const Real& x : part->entries) size += abs(x);
    }
  }
  return static_cast<double>(size);
}

Rates rates_of(const Piece& piece) {
  Rates result;
  const double stiffness = std::sqrt(size_of(piece.stiffness, result.highest));
  result.solution = std::max(stiffness, size_of(piece.damping, result.highest));
  return result;
}

/// Carries (q, dq/dtheta), the columns of the fundamental matrix, over one piece.
class Carrier {
 public:
  Carrier(int degrees, const std::atomic<bool>* cancel) : cancel_(cancel), q_(degrees, 2 * degrees), dq_(q_) {
    for (int i = 0; i < degrees; ++i) q_(i, i) = dq_(i, degrees + i) = 1;
  }

  bool over(const Piece& piece) {
    const Rates rates = rates_of(piece);
    const double longest =
        std::min(kRadians / rates.solution, kPhase / rates.highest);  // inf where a rate is 0
    for (Real theta = piece.from; theta < piece.to;) {
      if (++steps_ > kMostReferenceSteps || (cancel_ != nullptr && cancel_->load())) return false;
      const Real rest = piece.to - theta;
      const Real h = rest < longest ? rest : Real(longest);
      const Real share = step(piece, theta, h);
      theta = share == 1 && h == rest ? piece.to : Real(theta + share * h);
    }
    return true;
  }

  const Matrix& value() const { return q_; }
  const Matrix& slope() const { return dq_; }

 private:
  Real step(const Piece& piece, const Real& theta, const Real& h) {
    Matrix slope = dq_;
    for (Real& x : slope.entries) x *= h;
    const auto q = solution_series(series_of(piece.damping, theta, h, h),
                                   series_of(piece.stiffness, theta, h, h * h), q_, std::move(slope));
    const Real share = usable_share(q);
    for (std::size_t e = 0; e < q_.entries.size(); ++e) {
      Real value = 0, rate = 0;  // by Horner
      for (std::size_t k = q.size(); k-- > 0;) value = value * share + q[k].entries[e];
      for (std::size_t k = q.size(); k-- > 1;) rate = rate * share + static_cast<int>(k) * q[k].entries[e];
      q_.entries[e] = value;
      dq_.entries[e] = rate / h;
    }
    return share;
  }

  const std::atomic<bool>* cancel_;
  Matrix q_, dq_;
  int steps_ = 0;
};

}  // namespace

std::optional<Monodromy> monodromy(const Equation& equation, const std::atomic<bool>* cancel) {
  const int d = equation.degrees_of_freedom;
  Carrier carrier(d, cancel);
  for (const Piece& piece : equation.pieces) {
    if (!carrier.over(piece)) return std::nullopt;
  }
  Monodromy result{Matrix(2 * d, 2 * d), equation.kappa};
  const Real ratio = equation.kappa / equation.angular_frequency;
  for (int i = 0; i < d; ++i) {
    for (int j = 0; j < 2 * d; ++j) {
      const Real unit = j < d ? Real(1) : ratio;
      result.matrix(i, j) = carrier.value()(i, j) * unit;
      result.matrix(d + i, j) = carrier.slope()(i, j) * unit / ratio;
    }
  }
  return result;
}

double true_error(const Monodromy& truth, const Stability& result) {
  const int n = truth.matrix.rows, d = n / 2;
  if (result.matrix.rows() != n || !result.matrix.allFinite()) return std::numeric_limits<double>::infinity();
  const Real scale = exp(Real(result.log_scale));
  Real difference = 0, largest = 1, trace = 0;
  const auto raise = [](Real& most, const Real& x) {
    if (abs(x) > most) most = abs(x);
  };
  for (int i = 0; i < n; ++i) {
    trace += truth.matrix(i, i);
    for (int j = 0; j < n; ++j) {
      const Real unit = (i < d) == (j < d) ? Real(1) : i < d ? truth.kappa : Real(1 / truth.kappa);
      raise(largest, truth.matrix(i, j));
      raise(difference, result.matrix(i, j) * scale * unit - truth.matrix(i, j));
    }
  }
  raise(difference, result.discriminant * scale - trace);
  return static_cast<double>(Real(difference / largest));
}

double trace_error(const Monodromy& truth, const Stability& result) {
  if (!std::isfinite(result.discriminant)) return std::numeric_limits<double>::infinity();
  Real largest = 1, trace = 0;
  for (const auto& entry : truth.matrix.entries) largest = std::max(largest, Real(abs(entry)));
  for (int i = 0; i < truth.matrix.rows; ++i) trace += truth.matrix(i, i);
  return static_cast<double>(Real(abs(result.discriminant * exp(Real(result.log_scale)) - trace) / largest));
}

}  // namespace strutt::judge
