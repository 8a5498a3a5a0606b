// Cuts a sparse symmetric matrix into pieces that can be eliminated side by side. For the .cpp files of linear/ only.
#pragma once

#include "core/types.h"

#include <vector>

namespace koebe::detail {

/// Nested dissection (George 1973): pieces of the graph of a matrix, and separators. There is no entry between any two
/// pieces. Pieces and separators form a tree with its nodes in postorder: each separator comes right after the subtrees
/// that it separates.
struct Dissection {
    struct Node {
        std::vector<Index> rows;  ///< ascending in a piece
        Index parent = -1;        ///< -1 at the root
        bool is_piece = true;     ///< a leaf of the tree
    };
    std::vector<Node> nodes;
};

/// Makes pieces of up to about most_rows rows. Separators are level sets of breadth-first searches (George and Liu
/// 1979) near the middle of the part they cut. The result depends on the pattern alone.
/// @param matrix symmetric; the lower triangle, or both triangles
/// @param last rows that no node gets
Dissection dissect(const SparseMatrix& matrix, const std::vector<Index>& last, Index most_rows);

}  // namespace koebe::detail
