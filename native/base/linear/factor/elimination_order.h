// The elimination order of a sparse factorization. For the .cpp files of linear/ only.
#pragma once

#include "linear/cholmod_support.h"

#include <vector>

namespace koebe::detail {

/// The order of least degree (AMD) of a symmetric matrix, with some rows kept to the end in the given order.
/// @param matrix its lower triangle is read
/// @param postordered whether all other rows stand in postorder of their own elimination tree
std::vector<Index> elimination_order(const SparseMatrix& matrix, const std::vector<Index>& last, bool postordered,
                                     CholmodCommon& common);

/// The order of least degree of all rows, from which the last ones are moved to the end. The fill in them counts: where
/// each of many last rows touches a few others, a chain of eliminations would fill them all.
std::vector<Index> elimination_order_by_fill(const SparseMatrix& matrix, const std::vector<Index>& last,
                                             CholmodCommon& common);

}  // namespace koebe::detail
