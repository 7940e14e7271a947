#pragma once

#include <cstddef>
#include <cstdint>

namespace strutt::detail {

inline constexpr int kFewestSeriesTerms = 4, kMostSeriesTerms = 20;
inline constexpr double kValueShare = 0.125;  // see HillSeries::tail

/// Which coefficients v_j of a series occur besides v_0: those of even j, of odd j, or all.
enum class Parity : unsigned char { even, odd, neither };

/// The tables of a HillSeries and the data of a batch, for the kernels.
struct SeriesSweep {
  int nodes, terms;  // the ends among the nodes, at least two; kFewestSeriesTerms ... kMostSeriesTerms
  int functions;
  double radius;          // r, half the distance of the nodes
  double span;            // r times the highest order of a harmonic
  const double* series;   // r^(j+2)/j! times the j-th derivative of f at a node, by node, function, j
  const Parity* parity;   // node by node
  const double* largest;  // of |f| in the discs of radius r about the real axis
  const double* mean;
  const double* const* weights;
  const double* tail;  // see HillSeries::tail
  double* entry[4];    // u1, u2, u1', u2'
  double* error[4];
  long* exponent;
  std::size_t lanes;
};

/// Integrates all lanes with the instruction set of this process.
void sweep(const SeriesSweep& batch);

// Classes of equations by the size of X = |mean| + sum_f largest_f |weight_f| and of parts of it, for which
// the functions are put into columns: Y_c = sum_f share_f |weight_f| over the functions of column c, share_f
// <= largest_f. With i the row and j_c the columns,
//   2^e (1 + i/8) <= X <= 2^e (1 + (i + 1)/8),   2^e j_c/8 <= Y_c <= 2^e (j_c + 1)/8.
// The lowest row begins at 0; the last one holds what is too large or not a number. Its number is i, j_0, j_1
// ..., four bits each j_c.
inline constexpr int kClassBits = 3, kShares = 1 << kClassBits;
inline constexpr int kSmallestOctave = -6, kOctaves = 40;
inline constexpr int kFirstClass = (1023 + kSmallestOctave) << kClassBits;
inline constexpr int kClassRows = (kOctaves << kClassBits) + 1, kColumnBits = kClassBits + 1,
                     kMostColumns = 12;

struct SeriesClasses {
  int functions, columns;
  const double *largest, *share;  // of each function
  const int* column;              // of each function, from 0 to columns - 1, rising
  const double* mean;
  const double* const* weights;
  std::int64_t* number;
  std::size_t lanes;
};
void classify(const SeriesClasses& classes);

}  // namespace strutt::detail
