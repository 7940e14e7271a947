#pragma once

#include <array>
#include <cstddef>

#include "free_pendulum/double_double.hpp"

namespace strutt {

/// The arithmetic-geometric mean of a >= b > 0 with all its steps, a_{n+1} = (a_n + b_n)/2, b_{n+1} =
/// sqrt(a_n b_n). Everything elliptic of this layer is read off these steps; each has the relative error of a
/// few 2^-104, and the errors do not grow from step to step (the mean is homogeneous and monotonic in both).
class AgmSteps {
 public:
  AgmSteps(DoubleDouble a, DoubleDouble b);

  DoubleDouble mean() const { return a_[last_]; }

  /// The sum over n >= 1 of 2^(n-1) (c_n/c_0)^2, c_0^2 = a_0^2 - b_0^2, c_n = (a_{n-1} - b_{n-1})/2. For a_0
  /// = 1 and b_0 = k' the integral of the second kind is E = K (1 - k^2 (1/2 + sum)): no cancellation for
  /// small k.
  DoubleDouble gap_sum() const;

  /// The part of 4K that passes while the amplitude grows from 0 to acot(cotangent) in [0, pi/2], in turns
  /// (0 to 1/4); a_0 = 1. Descending Landen transformation, R. Bulirsch, Numer. Math. 7 (1965) 78 (el1).
  DoubleDouble turns_of(DoubleDouble cotangent) const;

  struct Amplitude {
    DoubleDouble sn, cn, dn;
  };
  /// The Jacobi functions at 4K `turns`; a_0 = 1. Ascending (Gauss) transformation, Bulirsch (sncndn): every
  /// sum has positive terms only, so that dn keeps its relative accuracy at the quarter period (extremes
  /// N29-N31).
  Amplitude amplitude(DoubleDouble turns) const;

 private:
  static constexpr std::size_t kMost = 26;  // b/a = 1e-308 needs 17
  std::array<DoubleDouble, kMost> a_, b_;
  std::size_t last_ = 0;
};

}  // namespace strutt
