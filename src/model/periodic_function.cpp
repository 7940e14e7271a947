#include "strutt/model/periodic_function.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "model/harmonic_orders.hpp"
#include "strutt/base/error.hpp"

namespace strutt {
namespace {

using std::numbers::pi;

/// theta brought to [-pi, pi].
double wrapped(double theta) { return std::remainder(theta, 2.0 * pi); }

/// s_n(tau) of the header: sign(cos), triangle, parabolic arcs.
double square_antiderivative(int n, double tau) {
  const double t = wrapped(tau);
  const bool near = std::abs(t) <= pi / 2.0;  // the half period in which sign(cos) = +1
  if (n == 0) return near ? 1.0 : -1.0;
  const double u = near ? t : std::copysign(pi - std::abs(t), t);
  if (n == 1) return u;
  const double arc = (u * u - pi * pi / 4.0) / 2.0;
  return near ? arc : -arc;
}

constexpr double square_bound(int n) { return n == 0 ? 1.0 : n == 1 ? pi / 2.0 : pi * pi / 8.0; }

}  // namespace

PeriodicFunction PeriodicFunction::constant(double mean) { return fourier(mean, {}); }

PeriodicFunction PeriodicFunction::fourier(double mean, std::vector<Harmonic> harmonics) {
  require_orders("order", harmonics);
  std::erase_if(harmonics, [](const Harmonic& h) { return h.cosine == 0.0 && h.sine == 0.0; });
  std::sort(harmonics.begin(), harmonics.end(),
            [](const auto& a, const auto& b) { return a.order < b.order; });
  PeriodicFunction result;
  result.mean_ = mean;
  result.harmonics_ = std::move(harmonics);
  return result;
}

PeriodicFunction PeriodicFunction::square(double mean, double amplitude, double shift, int antiderivative) {
  require(antiderivative >= 0 && antiderivative <= 2, "antiderivative", antiderivative, "0, 1 or 2");
  require(std::isfinite(shift), "shift", shift, "finite");
  PeriodicFunction result;
  result.mean_ = mean;
  if (amplitude == 0.0) return result;
  result.form_ = Form::square;
  result.amplitude_ = amplitude;
  result.shift_ = shift;
  result.antiderivative_ = antiderivative;
  return result;
}

PeriodicFunction PeriodicFunction::samples(std::span<const double> values) {
  const auto count = static_cast<int>(values.size());
  require(count >= 1, "number of samples", count, "at least 1");
  // A direct discrete Fourier transform: done once a scene, and the phase (j k mod N)/N is exact for every N.
  const auto coefficient = [&](int k, double (*wave)(double)) {
    double sum = 0.0;
    for (int j = 0; j < count; ++j) {
      const auto turn = static_cast<double>(static_cast<long long>(j) * k % count) / count;
      sum += values[static_cast<std::size_t>(j)] * wave(2.0 * pi * turn);
    }
    return sum / count;
  };
  constexpr auto cosine = [](double x) { return std::cos(x); };
  constexpr auto sine = [](double x) { return std::sin(x); };
  std::vector<Harmonic> harmonics;
  for (int k = 1; 2 * k <= count; ++k) {
    const bool highest = 2 * k == count;
    harmonics.push_back(
        {k, (highest ? 1.0 : 2.0) * coefficient(k, cosine), highest ? 0.0 : 2.0 * coefficient(k, sine)});
  }
  return fourier(coefficient(0, cosine), std::move(harmonics));
}

double PeriodicFunction::operator()(double theta) const {
  if (form_ == Form::square)
    return mean_ + amplitude_ * square_antiderivative(antiderivative_, theta - shift_);
  double sum = mean_;
  for (const auto& h : harmonics_) {
    const double angle = h.order * theta;
    sum += h.cosine * std::cos(angle);
    if (h.sine != 0.0) sum += h.sine * std::sin(angle);
  }
  return sum;
}

PeriodicFunction PeriodicFunction::derivative() const {
  if (form_ == Form::square) {
    if (antiderivative_ == 0) throw InvalidInput("a square wave has no derivative");
    return square(0.0, amplitude_, shift_, antiderivative_ - 1);
  }
  auto harmonics = harmonics_;
  for (auto& h : harmonics) h = {h.order, h.order * h.sine, -h.order * h.cosine};
  return fourier(0.0, std::move(harmonics));
}

namespace {

double amplitude_sum(std::span<const Harmonic> harmonics) {
  double sum = 0.0;
  for (const auto& h : harmonics) sum += std::hypot(h.cosine, h.sine);
  return sum;
}

}  // namespace

double PeriodicFunction::deviation() const {
  return form_ == Form::square ? std::abs(amplitude_) * square_bound(antiderivative_)
                               : amplitude_sum(harmonics_);
}

double PeriodicFunction::square_amplitude() const { return amplitude_; }

double PeriodicFunction::bound() const { return std::abs(mean_) + deviation(); }

double PeriodicFunction::lower_bound() const { return mean_ - deviation(); }

bool PeriodicFunction::is_constant() const { return form_ == Form::fourier && harmonics_.empty(); }

bool PeriodicFunction::is_piecewise_constant() const {
  return is_constant() || (form_ == Form::square && antiderivative_ == 0);
}

int PeriodicFunction::highest_order() const {
  if (form_ == Form::square) return 1;
  return harmonics_.empty() ? 0 : harmonics_.back().order;
}

namespace {

/// The harmonic seen from theta0: a' cos(k tau) + b' sin(k tau), tau = theta - theta0.
Harmonic shifted_harmonic(const Harmonic& h, double theta0) {
  const double c = std::cos(h.order * theta0), s = std::sin(h.order * theta0);
  return {h.order, h.cosine * c + h.sine * s, h.sine * c - h.cosine * s};
}

/// An angle brought to [0, pi): centres come in pairs pi apart.
double folded(double theta0) {
  const double t = std::fmod(theta0, pi);
  return t < 0.0 ? t + pi : t;
}

}  // namespace

std::optional<double> PeriodicFunction::even_centre() const {
  if (form_ == Form::square) {
    // s_1 is odd about the centre of the square wave and even a quarter period later
    return folded(antiderivative_ == 1 ? shift_ + pi / 2.0 : shift_);
  }
  if (std::all_of(harmonics_.begin(), harmonics_.end(), [](const Harmonic& h) { return h.sine == 0.0; }))
    return 0.0;
  // A centre makes every term a pure cosine, so it is among the 2k extrema of the lowest harmonic, of order
  // k.
  const auto& lowest = harmonics_.front();
  const double first = std::atan2(lowest.sine, lowest.cosine) / lowest.order;
  for (int j = 0; j < 2 * lowest.order; ++j) {
    const double centre = folded(first + j * pi / lowest.order);
    const bool even = std::all_of(harmonics_.begin(), harmonics_.end(), [&](const Harmonic& h) {
      const double size = std::hypot(h.cosine, h.sine);
      return std::abs(shifted_harmonic(h, centre).sine) <= 1e-15 * (1.0 + h.order) * size;
    });
    if (even) return centre;
  }
  return std::nullopt;
}

double PeriodicFunction::asymmetry(double theta0) const {
  double largest = 0.0;
  for (const auto& h : harmonics_) {
    largest = std::max(largest, std::abs(shifted_harmonic(h, theta0).sine) / std::hypot(h.cosine, h.sine));
  }
  return largest;
}

PeriodicFunction PeriodicFunction::shifted(double theta0) const {
  PeriodicFunction result = *this;
  result.shift_ -= theta0;
  for (auto& h : result.harmonics_) h = shifted_harmonic(h, theta0);
  return result;
}

PeriodicFunction PeriodicFunction::centred(double theta0) const {
  PeriodicFunction result = *this;
  if (form_ == Form::square) {
    // only multiples of pi/2 are left between the wave and its own centre: keep them exact
    result.shift_ = std::round((shift_ - theta0) / (pi / 2.0)) * (pi / 2.0);
    return result;
  }
  for (auto& h : result.harmonics_) {
    const double sign = std::copysign(1.0, shifted_harmonic(h, theta0).cosine);
    h = {h.order, h.sine == 0.0 && theta0 == 0.0 ? h.cosine : sign * std::hypot(h.cosine, h.sine), 0.0};
  }
  return result;
}

PeriodicFunction PeriodicFunction::scaled(double factor) const {
  if (form_ == Form::square) return square(factor * mean_, factor * amplitude_, shift_, antiderivative_);
  auto harmonics = harmonics_;
  for (auto& h : harmonics) h = {h.order, factor * h.cosine, factor * h.sine};
  return fourier(factor * mean_, std::move(harmonics));
}

PeriodicFunction PeriodicFunction::plus(double constant) const {
  PeriodicFunction result = *this;
  result.mean_ += constant;
  return result;
}

std::vector<double> PeriodicFunction::breakpoints(double from, double to) const {
  std::vector<double> result;
  if (form_ == Form::fourier || antiderivative_ != 0) return result;
  const double first = shift_ + pi / 2.0;  // jumps at first + j pi
  for (auto j = std::ceil((from - first) / pi); first + j * pi < to; ++j) {
    if (first + j * pi > from) result.push_back(first + j * pi);
  }
  return result;
}

PeriodicFunction PeriodicFunction::piece(double interior) const {
  if (form_ == Form::fourier || antiderivative_ != 0) return *this;
  return constant((*this)(interior));
}

}  // namespace strutt
