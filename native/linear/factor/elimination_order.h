// The order in which a sparse factorization eliminates. For the .cpp files of linear/ only.
#pragma once

#include "linear/cholmod_support.h"

#include <vector>

namespace koebe::detail {

/// The order of least degree (AMD) of a symmetric matrix with some rows kept to the end, in the order given.
/// @param matrix of which the lower triangle is read
/// @param postordered whether the others stand in postorder of their own elimination tree
std::vector<Index> elimination_order(const SparseMatrix& matrix, const std::vector<Index>& last, bool postordered,
                                     CholmodCommon& common);

}  // namespace koebe::detail
