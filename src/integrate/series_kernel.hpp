#pragma once

#include <cstddef>
#include <cstdint>

namespace strutt::detail {

inline constexpr int kMostSeriesTerms = 48;

/// The tables of a HillSeries and the data of a batch, for the kernels.
struct SeriesSweep {
  int steps, terms;  // terms even, at most kMostSeriesTerms
  int functions;
  double radius;         // r, half a step
  const double* series;  // r^(j+2)/j! times the j-th derivative of f at the middle of the step, by step,
                         // function, j
  const unsigned char* odd_only;  // step by step: whether all terms of even order j > 0 vanish
  const double* largest;          // of |f| in the discs of radius r about the real axis
  const double* mean;
  const double* const* weights;
  double* entry[4];  // u1, u2, u1', u2'
  double* error[4];
  long* exponent;
  std::size_t lanes;
};

/// Plans to choose from, cheapest first: row i serves a lane if
///   shares[i (functions + 1)] |mean| + sum_f shares[i (functions + 1) + 1 + f] |weight_f| <= 1.
struct SeriesChoice {
  const double* shares;
  std::size_t rows;
  int functions;
  const double* mean;
  const double* const* weights;
  std::int64_t* row;  // the first that serves, or `rows`
  std::size_t lanes;
};
void choose(const SeriesChoice& choice);

/// Integrates all lanes with the instruction set of this process.
void sweep(const SeriesSweep& batch);

}  // namespace strutt::detail
