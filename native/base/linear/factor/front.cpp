#include "linear/factor/front.h"

#include "core/errors.h"
#include "execution/thread_share.h"
#include "linear/dense_blas.h"

#include <algorithm>

namespace koebe::detail {
namespace {

constexpr Index front_block = 128;  // columns
constexpr Index front_rows = 512;   // rows of a triangular solve

}  // namespace

void eliminate(double* columns, Index height, Index width, double* rest)
{
    const double one = 1.0;
    const auto at = [&](Index row, Index column) {
        return columns + row + static_cast<std::ptrdiff_t>(column) * height;
    };
    // Right-looking, by blocks: L_pp L_pp' = A_pp, L_rp = A_rp L_pp^-T, and A_rr -= L_rp L_rp' among the columns.
    for (Index p = 0; p < width; p += front_block) {
        const int block = std::min(front_block, width - p);
        int info = 0;
        dpotrf_("L", &block, at(p, p), &height, &info);
        if (info != 0) throw SolverError("sparse factorization: the matrix is not positive definite");
        const Index begin = p + block;
        in_pieces(height - begin, front_rows, [&](std::size_t from, std::size_t until) {
            const int rows = static_cast<int>(until - from);
            dtrsm_("R", "L", "T", "N", &rows, &block, &one, at(p, p), &height, at(begin + static_cast<Index>(from), p),
                   &height);
        });
        in_pieces(width - begin, front_block, [&](std::size_t from, std::size_t until) {
            const Index c = begin + static_cast<Index>(from);
            lower_product(height - c, static_cast<int>(until - from), block, -1.0, at(c, p), height, 1.0, at(c, c),
                          height);
        });
    }
    // The other columns see all blocks at once.
    const Index others = height - width;
    in_pieces(others, front_block, [&](std::size_t from, std::size_t until) {
        const Index c = static_cast<Index>(from);
        lower_product(others - c, static_cast<int>(until - from), width, -1.0, at(width + c, 0), height, 1.0,
                      rest + c + static_cast<std::ptrdiff_t>(c) * others, others);
    });
}

void substitute_forward(const double* block, Index height, Index width, Index first, MatrixXd& x, MatrixXd& update)
{
    const int count = static_cast<int>(x.cols()), stride = static_cast<int>(x.rows()), below = height - width;
    const double one = 1.0, minus_one = -1.0, zero = 0.0;
    double* own = &x(first, 0);
    update = MatrixXd(below, count);  // resize() would free it twice when memory runs out
    dtrsm_("L", "L", "N", "N", &width, &count, &one, block, &height, own, &stride);
    if (below > 0)
        dgemm_("N", "N", &below, &count, &width, &minus_one, block + width, &height, own, &stride, &zero, update.data(),
               &below);
}

void substitute_backward(const double* block, Index height, Index width, Index first, const Index* rows, MatrixXd& x)
{
    const int count = static_cast<int>(x.cols()), stride = static_cast<int>(x.rows()), below = height - width;
    const double one = 1.0, minus_one = -1.0;
    double* own = &x(first, 0);
    if (below > 0) {
        MatrixXd above(below, count);
        for (Index r = 0; r < below; ++r) above.row(r) = x.row(rows[r]);
        dgemm_("T", "N", &width, &count, &below, &minus_one, block + width, &height, above.data(), &below, &one, own,
               &stride);
    }
    dtrsm_("L", "L", "T", "N", &width, &count, &one, block, &height, own, &stride);
}

}  // namespace koebe::detail
