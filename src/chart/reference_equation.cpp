#include "chart/reference_equation.hpp"

#include <boost/math/constants/constants.hpp>
#include <utility>

namespace strutt::judge {
namespace {

Real pi() { return boost::math::constants::pi<Real>(); }

Matrix scalar(const Real& x) {
  Matrix result(1, 1);
  result(0, 0) = x;
  return result;
}

/// x'' + damping x' + (mean + sum of harmonics) x = 0 in the phase.
Equation hill(const Real& frequency, const Real& damping, const Real& mean, std::vector<Term> harmonics) {
  Equation result;
  result.angular_frequency = frequency;
  const Real turning = sqrt(abs(mean));
  result.kappa = frequency * (turning > 1 ? turning : Real(1));
  harmonics.push_back({0, scalar(mean), {}});
  result.pieces.push_back({0, 2 * pi(), {{0, scalar(damping), {}}}, std::move(harmonics)});
  return result;
}

/// The same with mean + amplitude sign(cos(theta - shift)).
Equation meissner(const Real& frequency, const Real& damping, const Real& mean, const Real& amplitude,
                  const Real& shift) {
  Equation result = hill(frequency, damping, mean, {});
  const Piece whole = result.pieces.front();
  result.pieces.clear();
  Real from = 0;
  // The jumps shift + pi/2 + k pi that lie in the period.
  for (Real k = ceil(-shift / pi() - Real(0.5));; ++k) {
    Piece piece = whole;
    piece.from = from;
    const Real jump = shift + (k + Real(0.5)) * pi();
    piece.to = jump < whole.to ? jump : whole.to;
    const Real middle = (piece.from + piece.to) / 2;
    piece.stiffness.front().cosine =
        scalar(cos(middle - shift) > 0 ? Real(mean + amplitude) : Real(mean - amplitude));
    if (piece.to > piece.from) result.pieces.push_back(piece);
    from = piece.to;
    if (from == whole.to) return result;
  }
}

/// cos and sin of order theta, with the factor in front.
Term term(int order, const Real& factor, const Real& cosine, const Real& sine) {
  return {order, scalar(factor * cosine), scalar(factor * sine)};
}

Equation equation_of(const MathieuTable& m) {
  if (!m.mathieu_form) return hill(1, m.damping, m.delta, {term(1, 1, m.epsilon, 0)});
  return hill(2, Real(m.damping) / 2, Real(m.delta) / 4, {term(1, Real(-0.5), m.epsilon, 0)});  // t = theta/2
}

Equation equation_of(const HillTable& h) {
  const Real unit = Real(h.period) / (2 * pi()), square = unit * unit;
  if (h.waveform == Waveform::square)
    return meissner(1 / unit, h.damping * unit, h.mean * square, h.amplitude * square, 0);
  std::vector<Term> harmonics;
  for (const auto& x : h.harmonics) harmonics.push_back(term(x.order, square, x.cosine, x.sine));
  return hill(1 / unit, h.damping * unit, h.mean * square, std::move(harmonics));
}

/// The trigonometric interpolation of equidistant values over one turn, without its mean.
std::vector<Term> interpolated(const std::vector<double>& values, const Real& factor) {
  const auto count = static_cast<long>(values.size());
  std::vector<Real> cosines, sines;
  for (long j = 0; j < count; ++j) {
    const Real angle = 2 * pi() * j / count;
    cosines.push_back(cos(angle));
    sines.push_back(sin(angle));
  }
  std::vector<Term> result;
  for (long k = 1; 2 * k <= count; ++k) {
    Real cosine = 0, sine = 0;
    for (long j = 0; j < count; ++j) {
      const auto turn = static_cast<std::size_t>(j * k % count);
      cosine += values[static_cast<std::size_t>(j)] * cosines[turn];
      sine += values[static_cast<std::size_t>(j)] * sines[turn];
    }
    const bool highest = 2 * k == count;
    result.push_back(
        term(static_cast<int>(k), factor * (highest ? 1 : 2) / count, cosine, highest ? Real(0) : sine));
  }
  return result;
}

/// r(theta) without its mean, times `factor`; not for the square wave.
std::vector<Term> motion_of(const SupportTable& s, const Real& factor) {
  if (s.waveform == Waveform::samples) return interpolated(s.samples, factor);
  if (s.waveform == Waveform::sine) {
    const Real phase = s.phase;
    return {term(1, factor * s.amplitude, sin(phase), cos(phase))};
  }
  std::vector<Term> result;
  for (const auto& h : s.harmonics) result.push_back(term(h.order, factor, h.cosine, h.sine));
  return result;
}

Real alpha_squared(const PendulumTable& p) {
  const Real gravity = p.gravity;
  if (p.shape == PendulumTable::Shape::rod) return 3 * gravity / (2 * Real(p.length));
  if (p.shape == PendulumTable::Shape::point_mass) return gravity / p.length;
  return p.mass * gravity * p.centroid / p.inertia;
}

/// Equation (7) about its equilibrium: x'' + c x' +- alpha^2 (1 + r''/g) x = 0.
Equation equation_of(const PendulumTable& p, const std::optional<SupportTable>& support) {
  const Real sign = p.about == Equilibrium::hanging ? 1 : -1, square = alpha_squared(p);
  if (!support) {
    const Real alpha = sqrt(square);
    return hill(alpha, p.damping / alpha, sign, {});
  }
  const Real omega = support->frequency, damping = p.damping / omega, mean = sign * square / (omega * omega);
  const Real swing = -sign * square / p.gravity;  // of r'' = -omega^2 (k^2 r_k)
  if (support->waveform == Waveform::square)
    return meissner(omega, damping, mean, swing * support->amplitude, pi() / 2 - support->phase);
  auto harmonics = motion_of(*support, swing);
  for (auto& h : harmonics) {
    h.cosine(0, 0) *= h.order * h.order;
    h.sine(0, 0) *= h.order * h.order;
  }
  return hill(omega, damping, mean, std::move(harmonics));
}

/// The inverse by Gauss and Jordan, largest pivot of the column.
Matrix inverse(const Eigen::MatrixXd& given) {
  const auto d = static_cast<int>(given.rows());
  Matrix m(d, 2 * d);
  for (int i = 0; i < d; ++i) {
    for (int j = 0; j < d; ++j) m(i, j) = given(i, j);
    m(i, d + i) = 1;
  }
  for (int k = 0; k < d; ++k) {
    int pivot = k;
    for (int i = k + 1; i < d; ++i) pivot = abs(m(i, k)) > abs(m(pivot, k)) ? i : pivot;
    for (int j = 0; j < 2 * d; ++j) std::swap(m(k, j), m(pivot, j));
    const Real divisor = m(k, k);
    for (int j = 0; j < 2 * d; ++j) m(k, j) /= divisor;
    for (int i = 0; i < d; ++i) {
      if (i == k) continue;
      const Real multiple = m(i, k);
      for (int j = 0; j < 2 * d; ++j) m(i, j) -= multiple * m(k, j);
    }
  }
  Matrix result(d, d);
  for (int i = 0; i < d; ++i) {
    for (int j = 0; j < d; ++j) result(i, j) = m(i, d + j);
  }
  return result;
}

/// factor inverse_mass times a periodic matrix.
std::vector<Term> terms_of(const PeriodicMatrix& given, const Matrix& inverse_mass, const Real& factor) {
  const auto product = [&](const Eigen::MatrixXd& m) {
    Matrix wide(static_cast<int>(m.rows()), static_cast<int>(m.cols()));
    for (int i = 0; i < wide.rows; ++i) {
      for (int j = 0; j < wide.columns; ++j) wide(i, j) = factor * m(i, j);
    }
    return m.size() == 0 ? Matrix() : inverse_mass * wide;
  };
  std::vector<Term> result;
  result.push_back({0, product(given.mean), {}});
  for (const auto& h : given.harmonics) result.push_back({h.order, product(h.cosine), product(h.sine)});
  return result;
}

Equation equation_of(const LinearPeriodicSystem& system) {
  Equation result;
  result.degrees_of_freedom = system.degrees_of_freedom();
  const Real unit = Real(system.period) / (2 * pi());
  result.angular_frequency = result.kappa = 1 / unit;
  const Matrix inverse_mass = inverse(system.mass);
  result.pieces.push_back({0, 2 * pi(), terms_of(system.damping, inverse_mass, unit),
                           terms_of(system.stiffness, inverse_mass, unit * unit)});
  return result;
}

}  // namespace

Matrix operator*(const Matrix& a, const Matrix& b) {
  Matrix result(a.rows, b.columns);
  for (int i = 0; i < a.rows; ++i) {
    for (int k = 0; k < a.columns; ++k) {
      for (int j = 0; j < b.columns; ++j) result(i, j) += a(i, k) * b(k, j);
    }
  }
  return result;
}

Equation equation_of(const Scene& scene) {
  if (scene.mathieu) return equation_of(*scene.mathieu);
  if (scene.hill) return equation_of(*scene.hill);
  if (scene.linear) return equation_of(*scene.linear);
  return equation_of(*scene.pendulum, scene.support);
}

}  // namespace strutt::judge
