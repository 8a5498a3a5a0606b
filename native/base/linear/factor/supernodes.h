// The supernodes of a factor A = L L'. For the .cpp files of linear/ only.
#pragma once

#include "core/types.h"

#include <cstddef>
#include <vector>

namespace koebe::detail {

/// A supernode is a run of columns of L with the same rows below them, kept as one dense block (height, width). Its
/// first width rows are the columns' own rows. Places have 64 bits, as there can be more than 2^31 values.
struct Supernodes {
    std::vector<Index> order;                            ///< row of A for each row of L
    std::vector<Index> rank;                             ///< row of L for each row of A
    std::vector<Index> supernode;                        ///< of each row of L
    std::vector<Index> first;                            ///< first column of each supernode, and the end
    std::vector<Index> rows;                             ///< rows of each supernode, one supernode after another
    std::vector<std::ptrdiff_t> row_begin, value_begin;  ///< of each supernode, and the end

    Index size() const { return static_cast<Index>(order.size()); }
    Index count() const { return static_cast<Index>(first.size()) - 1; }
    Index width(Index s) const { return first[s + 1] - first[s]; }
    Index height(Index s) const { return static_cast<Index>(row_begin[s + 1] - row_begin[s]); }
    const Index* rows_of(Index s) const { return rows.data() + row_begin[s]; }
    /// The parent in the elimination tree. The parent of a root is the root itself.
    Index parent(Index s) const { return height(s) == width(s) ? s : supernode[rows_of(s)[width(s)]]; }
};

/// A number that is added to the diagonal of A, from one row of L on.
struct DiagonalShift {
    Index first = 0;
    double number = 0.0;
};

}  // namespace koebe::detail
