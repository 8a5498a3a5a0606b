#include "linear/front.h"

#include "core/errors.h"
#include "core/thread_share.h"
#include "linear/dense_blas.h"
#include "linear/kernel_buffer.h"

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
    for (Index p = 0; p < width; p += front_block) {
        const int block = std::min(front_block, width - p);
        int info = 0;
        dpotrf_("L", &block, at(p, p), &height, &info);
        if (info != 0) throw SolverError("sparse factorization: the matrix is not positive definite");
        const Index begin = p + block;
        in_pieces(height - begin, front_rows, [&](std::size_t from, std::size_t until) {
            const KernelBuffer buffer;
            const int rows = static_cast<int>(until - from);
            dtrsm_("R", "L", "T", "N", &rows, &block, &one, at(p, p), &height, at(begin + static_cast<Index>(from), p),
                   &height);
        });
        in_pieces(width - begin, front_block, [&](std::size_t from, std::size_t until) {
            const KernelBuffer buffer;
            const Index c = begin + static_cast<Index>(from);
            lower_product(height - c, static_cast<int>(until - from), block, -1.0, at(c, p), height, 1.0, at(c, c),
                          height);
        });
    }
    const Index others = height - width;
    in_pieces(others, front_block, [&](std::size_t from, std::size_t until) {
        const KernelBuffer buffer;
        const Index c = static_cast<Index>(from);
        lower_product(others - c, static_cast<int>(until - from), width, -1.0, at(width + c, 0), height, 1.0,
                      rest + c + static_cast<std::ptrdiff_t>(c) * others, others);
    });
}

}  // namespace koebe::detail
