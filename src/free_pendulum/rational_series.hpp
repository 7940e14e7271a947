#pragma once

#include <boost/multiprecision/cpp_int.hpp>
#include <vector>

namespace strutt {

using Exact = boost::multiprecision::cpp_rational;

/// Coefficients 0 ... order of a power series. All operations keep the order of their first argument.
using Series = std::vector<Exact>;

Series product(const Series& a, const Series& b);
Series reciprocal(const Series& a);                            ///< a[0] != 0
Series power(const Series& a, const Exact& exponent);          ///< a[0] = 1
Series composition(const Series& outer, const Series& inner);  ///< outer(inner(x)), inner[0] = 0
Exact binomial_central(int n);                                 ///< binomial(2n, n)/4^n

}  // namespace strutt
