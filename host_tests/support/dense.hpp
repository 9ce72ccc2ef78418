// Dense algebra by Eigen, compiled once: what the factorizations of the core are compared with.
#pragma once

#include <Eigen/Core>

#include "support/random.hpp"

namespace support {

using Matrix = Eigen::MatrixXd;
using Vector = Eigen::VectorXd;

/// A^-1 b, by full pivoting.
Vector solved(const Matrix& A, const Vector& b);
/// The reciprocal condition number, estimated; 0 if A is singular.
double rcond(const Matrix& A);
/// A B.
Matrix product(const Matrix& A, const Matrix& B);
/// Entries between -1 and 1.
Matrix random_matrix(Random& random, int rows, int columns);
Vector random_vector(Random& random, int n);
double largest(const Vector& x);

}  // namespace support
