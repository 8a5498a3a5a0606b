// The order in which a sparse factorization eliminates. For the .cpp files of linear/ only.
#pragma once

#include "linear/cholmod_support.h"
#include "linear/sparse_cholesky.h"

#include <vector>

namespace koebe::detail {

/// A fill-reducing order of a symmetric matrix with some rows kept to the end, in the order given.
/// @param matrix of which the lower triangle is read
/// @param postordered whether the others stand in postorder of their own elimination tree
std::vector<Index> elimination_order(const SparseMatrix& matrix, const std::vector<Index>& last, Ordering ordering,
                                     bool postordered, CholmodCommon& common);

}  // namespace koebe::detail
