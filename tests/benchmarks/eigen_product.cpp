// Compiled once for each instruction set (CMakeLists.txt), which renames the namespace Eigen and defines
// STRUTT_PRODUCT: inline functions of the same name would be merged.
#include "benchmarks/eigen_product.hpp"

#include <Eigen/Core>

void STRUTT_PRODUCT(const double* left, const double* right, double* result, std::ptrdiff_t n,
                    std::ptrdiff_t rank) {
  const Eigen::Map<const Eigen::MatrixXd> a(left, n, rank), b(right, rank, n);
  Eigen::Map<Eigen::MatrixXd>(result, n, n).noalias() = a * b;
}
