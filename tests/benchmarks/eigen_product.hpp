#pragma once

#include <cstddef>

/// Eigen's product of n x rank and rank x n, column by column, compiled for one instruction set.
using EigenProduct = void (*)(const double* left, const double* right, double* result, std::ptrdiff_t n,
                              std::ptrdiff_t rank);
void eigen_product_sse2(const double*, const double*, double*, std::ptrdiff_t, std::ptrdiff_t);
void eigen_product_avx2(const double*, const double*, double*, std::ptrdiff_t, std::ptrdiff_t);
void eigen_product_avx512(const double*, const double*, double*, std::ptrdiff_t, std::ptrdiff_t);
