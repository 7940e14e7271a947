#include "floquet/undamped_hill.hpp"

#include <algorithm>
#include <numbers>

#include "floquet/assembly.hpp"

namespace strutt {

using std::numbers::pi;

UndampedHill::UndampedHill(const HillEquation& equation)
    : centre(equation.coefficient.even_centre()),
      w(centre ? equation.coefficient.centred(*centre) : equation.coefficient),
      kappa(equation.canonical_kappa()),
      angular_frequency(equation.angular_frequency),
      damping(equation.canonical_damping()),
      coefficient_error(equation.coefficient_error +
                        (centre ? equation.coefficient.asymmetry(*centre) : 0.0)) {
  if (damping != 0.0) w = w.plus(-0.25 * damping * damping);
  // The centre is cut out because M is wanted from t = 0.
  pieces = smooth_pieces(w, 0.0, centre ? pi : 2.0 * pi, centre.value_or(0.0));
}

HillMonodromy UndampedHill::put_together(const std::vector<BoundedMatrix2>& factors,
                                         const std::vector<Segment>& segments) const {
  HillMonodromy result;
  result.kappa = kappa * angular_frequency;
  result.half_damping = damping * pi;
  if (centre) {
    result.half = ordered_product(factors, 2);
    const auto before =
        std::count_if(segments.begin(), segments.end(), [&](const Segment& s) { return s.to <= *centre; });
    result.undamped = period_from_half(factors, static_cast<std::size_t>(before));
  } else {
    result.undamped = ordered_product(factors, 2);
  }
  result.matrix = restore_damping(result.undamped, result.half_damping, 0.5 * damping / kappa);
  return result;
}

HillMonodromy UndampedHill::assembled(const Propagators<Eigen::Matrix2d>& found,
                                      const std::vector<Segment>& segments) const {
  if (found.outcome == Outcome::cancelled || found.outcome == Outcome::step_limit) {
    HillMonodromy nothing;
    nothing.outcome = found.outcome;
    return nothing;
  }
  HillMonodromy result =
      combined(found, [&](const auto& factors) { return put_together(factors, segments); });
  for (const auto& factor : found.factors) {
    result.determinant_defect = std::max(result.determinant_defect, determinant_defect(factor));
  }
  result.error = scaled_error(result.matrix);
  return result;
}

}  // namespace strutt
