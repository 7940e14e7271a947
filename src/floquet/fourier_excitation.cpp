#include "floquet/fourier_excitation.hpp"

#include <cmath>
#include <numeric>

#include "base/constants.hpp"
#include "strutt/base/error.hpp"

namespace strutt {
namespace {

constexpr double kLargestNorm = 1e6;

void require_harmonics(const PeriodicFunction& coefficient) {
  if (coefficient.harmonics().empty() && !coefficient.is_constant())
    throw InvalidInput("coefficient", "an antiderivative of a square wave, or one where harmonics are needed",
                       "finitely many harmonics");
}

}  // namespace

FourierExcitation::FourierExcitation(const PeriodicFunction& coefficient, double relative_error) {
  require_harmonics(coefficient);
  const auto centre = coefficient.even_centre();
  even = centre.has_value();
  const PeriodicFunction seen = even ? coefficient.centred(*centre) : coefficient;
  harmonics.resize(static_cast<std::size_t>(seen.highest_order()) + 1, 0.0);
  errors.resize(harmonics.size(), 0.0);
  for (const Harmonic& h : seen.harmonics()) {
    const auto m = static_cast<std::size_t>(h.order);
    harmonics[m] = 0.5 * std::complex<double>(h.cosine, -h.sine);
    errors[m] = relative_error * std::abs(harmonics[m]) * (1.0 + 4.0 * kUnit);
    if (!even || *centre == 0.0) continue;
    // turned by order x centre, which rounds; the sines that are left are dropped
    const double turning =
        std::abs(h.cosine) * (coefficient.asymmetry(*centre) + (8.0 + 8.0 * h.order) * kUnit);
    change += turning;
    errors[m] += 0.5 * turning;
  }
  const double norm = matrix(HillBasis::bloch, 0.0).norm();
  require(norm <= kLargestNorm * (1.0 + 1e-9), "sum of the amplitudes of the harmonics", norm, "0 to 1e6");
}

double FourierExcitation::uncertainty() const {
  return 2.0 * std::accumulate(errors.begin(), errors.end(), 0.0) *
         (1.0 + static_cast<double>(errors.size()) * kUnit);
}

}  // namespace strutt
