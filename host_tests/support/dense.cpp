#include "support/dense.hpp"

#include <Eigen/LU>

namespace support {

Vector solved(const Matrix& A, const Vector& b) { return A.fullPivLu().solve(b); }

double rcond(const Matrix& A) {
  const Eigen::FullPivLU<Matrix> factors(A);
  return factors.isInvertible() ? factors.rcond() : 0;
}

Matrix product(const Matrix& A, const Matrix& B) { return A * B; }

Matrix random_matrix(Random& random, int rows, int columns) {
  Matrix A(rows, columns);
  for (int i = 0; i < rows; ++i)
    for (int j = 0; j < columns; ++j) A(i, j) = random.between(-1, 1);
  return A;
}

Vector random_vector(Random& random, int n) { return random_matrix(random, n, 1); }

double largest(const Vector& x) { return x.size() == 0 ? 0 : x.cwiseAbs().maxCoeff(); }

}  // namespace support
