#include "linear/path_solution.h"

#include <algorithm>

extern "C" {
void dtrsm_(const char* side, const char* uplo, const char* trans, const char* diag, const int* m, const int* n,
            const double* alpha, const double* a, const int* lda, double* b, const int* ldb);
void dgemm_(const char* transa, const char* transb, const int* m, const int* n, const int* k, const double* alpha,
            const double* a, const int* lda, const double* b, const int* ldb, const double* beta, double* c,
            const int* ldc);
}

namespace koebe::detail {

PathSolution path_solution(const SupernodalFactor& l, const SparseMatrix& b)
{
    PathSolution solution;
    std::vector<Index>& place = solution.place;
    place.assign(l.supernode_count(), -1);
    for (Index c = 0; c < static_cast<Index>(b.cols()); ++c)
        for (SparseMatrix::InnerIterator it(b, c); it; ++it)
            for (Index s = l.supernode[l.rank[it.row()]]; place[s] < 0; s = l.parent(s)) {
                place[s] = 0;
                solution.path.push_back(s);
            }
    std::sort(solution.path.begin(), solution.path.end());
    Index length = 0;
    for (const Index s : solution.path) {
        place[s] = length;
        length += l.width(s);
    }

    const int count = static_cast<int>(b.cols());
    MatrixXd& y = solution.y;
    y = MatrixXd::Zero(count, length);
    for (Index c = 0; c < count; ++c)
        for (SparseMatrix::InnerIterator it(b, c); it; ++it) y(c, solution.column(l, l.rank[it.row()])) = it.value();
    MatrixXd update;
    const double one = 1.0, zero = 0.0;
    for (const Index s : solution.path) {
        const int width = l.width(s), height = l.height(s), below = height - width;
        double* block = &y(0, place[s]);
        dtrsm_("R", "L", "T", "N", &count, &width, &one, l.values(s), &height, block, &count);
        if (below == 0) continue;
        update.resize(count, below);
        dgemm_("N", "T", &count, &below, &width, &one, block, &count, l.values(s) + width, &height, &zero,
               update.data(), &count);
        for (Index r = 0; r < below; ++r) y.col(solution.column(l, l.rows(s)[width + r])) -= update.col(r);
    }
    return solution;
}

MatrixXd back_substitution(const SupernodalFactor& l, const PathSolution& solution)
{
    MatrixXd x = solution.y;
    const int count = static_cast<int>(x.rows());
    MatrixXd below_x;
    const double one = 1.0, minus_one = -1.0;
    for (auto s = solution.path.rbegin(); s != solution.path.rend(); ++s) {
        const int width = l.width(*s), height = l.height(*s), below = height - width;
        double* block = &x(0, solution.place[*s]);
        below_x.resize(count, below);
        for (Index r = 0; r < below; ++r) below_x.col(r) = x.col(solution.column(l, l.rows(*s)[width + r]));
        if (below > 0)
            dgemm_("N", "N", &count, &width, &below, &minus_one, below_x.data(), &count, l.values(*s) + width, &height,
                   &one, block, &count);
        dtrsm_("R", "L", "N", "N", &count, &width, &one, l.values(*s), &height, block, &count);
    }
    return x;
}

}  // namespace koebe::detail
