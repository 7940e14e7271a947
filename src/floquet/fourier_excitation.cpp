#include "floquet/fourier_excitation.hpp"

#include <cmath>

#include "strutt/base/error.hpp"

namespace strutt {
namespace {

constexpr double kUnit = 0x1p-53;
constexpr double kLargestNorm = 1e6;

void require_harmonics(const PeriodicFunction& coefficient) {
  if (coefficient.harmonics().empty() && !coefficient.is_constant())
    throw InvalidInput("coefficient", "a square wave or an antiderivative of one", "finitely many harmonics");
}

}  // namespace

FourierExcitation::FourierExcitation(const PeriodicFunction& coefficient) {
  require_harmonics(coefficient);
  const auto centre = coefficient.even_centre();
  even = centre.has_value();
  const PeriodicFunction seen = even ? coefficient.centred(*centre) : coefficient;
  harmonics.resize(static_cast<std::size_t>(seen.highest_order()) + 1, 0.0);
  for (const Harmonic& h : seen.harmonics()) {
    harmonics[static_cast<std::size_t>(h.order)] = 0.5 * std::complex<double>(h.cosine, -h.sine);
    // turned by order x centre, which rounds; the sines that are left are dropped
    if (even && *centre != 0.0)
      change += std::abs(h.cosine) * (coefficient.asymmetry(*centre) + (8.0 + 8.0 * h.order) * kUnit);
  }
  const double norm = matrix(HillBasis::bloch, 0.0).norm();
  require(norm <= kLargestNorm * (1.0 + 1e-9), "sum of the amplitudes of the harmonics", norm, "0 to 1e6");
}

}  // namespace strutt
