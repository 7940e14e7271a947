#pragma once

#include <atomic>
#include <optional>
#include <vector>

#include "strutt/base/method.hpp"
#include "strutt/chart/tongues.hpp"
#include "strutt/floquet/verdict.hpp"

namespace strutt {

struct BandOptions {
  double tolerance = 1e-12;  ///< largest error of an end wanted, 1e-13 <= tolerance <= 1e-2
  int samples = 1000;        ///< of the line where no proof is possible, 2 to 1e6
  const std::atomic<bool>* cancel = nullptr;
};

/// An interval of a line that is stable or unstable all through.
struct StabilityBand {
  double from = 0.0, to = 0.0;
  Verdict verdict = Verdict::stable;  ///< unresolved or boundary only of a whole line
  std::optional<int> tongue;          ///< n of an unstable band; nothing for systems
  double from_error =
      0.0;  ///< bound of the error of that end, divided by max(1, |end|); 0 at an end of the line
  double to_error = 0.0;
  Method method = Method::fourier;
  Outcome outcome = Outcome::converged;
};

/// The bands that a line is made of, ascending: the safe frequencies at an amplitude; the amplitudes or
/// frequencies from and up to which shaking holds an inverted pendulum (Kapitza).
///
/// The ends of the unstable bands are those of unstable tongues, found as by stability_margin: by tongues()
/// all of them, however thin (a band narrower than a rounding has from = to); else those seen at `samples`
/// equidistant points and at the minima of the margin between them. Throws InvalidInput for a line that is
/// not finite or not from < to, an unknown parameter, a scene that does not validate at both ends, options
/// out of range.
std::vector<StabilityBand> stability_bands(const Scene& scene, const TongueLine& line,
                                           const BandOptions& options = {});

}  // namespace strutt
