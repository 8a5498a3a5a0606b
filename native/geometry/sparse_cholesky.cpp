#include "geometry/sparse_cholesky.h"

#include "geometry/cholmod_support.h"

namespace koebe {

using namespace detail;

struct SparseCholesky::Impl {
    CholmodCommon common;
    Factor factor;
};

SparseCholesky::SparseCholesky(const SparseMatrix& matrix, Ordering ordering) : impl_(std::make_unique<Impl>())
{
    CholmodCommon& common = impl_->common;
    common->nmethods = 1;
    common->method[0].ordering = ordering == Ordering::amd ? CHOLMOD_AMD : CHOLMOD_METIS;
    cholmod_sparse lower = view(matrix, -1);
    impl_->factor = own(cholmod_analyze(&lower, common.get()), common);
    common.require(impl_->factor != nullptr, "symbolic analysis");
    refactorize(matrix);
}

void SparseCholesky::refactorize(const SparseMatrix& matrix)
{
    cholmod_sparse lower = view(matrix, -1);
    const int done = cholmod_factorize(&lower, impl_->factor.get(), impl_->common.get());
    impl_->common.require(done != 0, "numeric factorization (matrix not positive definite)");
}

SparseCholesky::~SparseCholesky() = default;
SparseCholesky::SparseCholesky(SparseCholesky&&) noexcept = default;
SparseCholesky& SparseCholesky::operator=(SparseCholesky&&) noexcept = default;

MatrixXd SparseCholesky::solve(const MatrixXd& right_hand_side) const
{
    cholmod_dense b = view(right_hand_side);
    CholmodCommon& common = impl_->common;
    const Dense x = own(cholmod_solve(CHOLMOD_A, impl_->factor.get(), &b, common.get()), common);
    common.require(x != nullptr, "back-substitution");
    return to_eigen(*x);
}

DirichletSolver::DirichletSolver(const SparseMatrix& laplacian, const std::vector<char>& fixed)
{
    std::vector<Index> rank(fixed.size());
    for (std::size_t v = 0; v < fixed.size(); ++v) {
        std::vector<Index>& part = fixed[v] ? fixed_ : free_;
        rank[v] = static_cast<Index>(part.size());
        part.push_back(static_cast<Index>(v));
    }
    if (free_.empty()) return;
    SparseMatrix inner(free_.size(), free_.size());
    inner.reserve(laplacian.nonZeros());
    std::vector<Eigen::Triplet<double, Index>> coupling;
    for (std::size_t c = 0; c < free_.size(); ++c) {
        inner.startVec(c);
        for (SparseMatrix::InnerIterator it(laplacian, free_[c]); it; ++it) {
            if (fixed[it.row()])
                coupling.emplace_back(static_cast<Index>(c), rank[it.row()], it.value());
            else
                inner.insertBack(rank[it.row()], c) = it.value();
        }
    }
    inner.finalize();
    coupling_.resize(free_.size(), fixed_.size());
    coupling_.setFromTriplets(coupling.begin(), coupling.end());
    cholesky_ = std::make_unique<SparseCholesky>(inner);
}

MatrixXd DirichletSolver::solve(const MatrixXd& values) const
{
    MatrixXd result = values;
    if (free_.empty()) return result;
    const MatrixXd inner = cholesky_->solve(-(coupling_ * values(fixed_, Eigen::all)));
    result(free_, Eigen::all) = inner;
    return result;
}

}  // namespace koebe
