#include "support/eigen_once.hpp"

namespace Eigen {

template class SelfAdjointEigenSolver<SupportMatrix<3>>;
template class SelfAdjointEigenSolver<SupportMatrix<6>>;
template SelfAdjointEigenSolver<SupportMatrix<3>>& SelfAdjointEigenSolver<SupportMatrix<3>>::compute(
    const EigenBase<SupportMatrix<3>>&, int);
template SelfAdjointEigenSolver<SupportMatrix<6>>& SelfAdjointEigenSolver<SupportMatrix<6>>::compute(
    const EigenBase<SupportMatrix<6>>&, int);

}  // namespace Eigen
