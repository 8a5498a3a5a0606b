// A sparse symmetric matrix cut into pieces that can be eliminated side by side. For the .cpp files of linear/ only.
#pragma once

#include "core/types.h"

#include <vector>

namespace koebe::detail {

/// Nested dissection (George 1973): pieces of the graph of a matrix, no two of which have an entry between them, and
/// the separators that part them. A tree, its nodes in postorder: each separator comes right after the subtrees it
/// parts.
struct Dissection {
    struct Node {
        std::vector<Index> rows;  ///< ascending in a piece
        Index parent = -1;        ///< -1: the root
        bool is_piece = true;     ///< a leaf of the tree
    };
    std::vector<Node> nodes;
};

/// The pieces have up to most_rows rows each, about; separators are level sets of breadth-first searches (George and
/// Liu 1979) near the middle of what they part. Depends on the pattern alone.
/// @param matrix symmetric; the lower triangle, or both
/// @param last rows that are left out, in no node
Dissection dissect(const SparseMatrix& matrix, const std::vector<Index>& last, Index most_rows);

}  // namespace koebe::detail
