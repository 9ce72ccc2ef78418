// Included before everything else in tests that check scenes: the eigenvalues of their supports, which take
// seconds to compile, are compiled once, in eigen_once.cpp.
#pragma once

#include <Eigen/Core>
#include <Eigen/Eigenvalues>

namespace Eigen {

template <int Size>
using SupportMatrix = Matrix<double, Size, Size>;

extern template class SelfAdjointEigenSolver<SupportMatrix<3>>;
extern template class SelfAdjointEigenSolver<SupportMatrix<6>>;
extern template SelfAdjointEigenSolver<SupportMatrix<3>>& SelfAdjointEigenSolver<SupportMatrix<3>>::compute(
    const EigenBase<SupportMatrix<3>>&, int);
extern template SelfAdjointEigenSolver<SupportMatrix<6>>& SelfAdjointEigenSolver<SupportMatrix<6>>::compute(
    const EigenBase<SupportMatrix<6>>&, int);

}  // namespace Eigen
