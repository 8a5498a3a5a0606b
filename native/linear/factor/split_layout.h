// Where the pieces and the separators of a dissected matrix stand in its factor. For the .cpp files of linear/ only.
#pragma once

#include "core/types.h"

#include <cstddef>
#include <vector>

namespace koebe::detail {

/// A node of the dissection, or the rows that are kept to the end, in the factor's order.
struct SplitPart {
    Index begin = 0, end = 0;                       ///< its rows
    Index first_supernode = 0, last_supernode = 0;  ///< [first, last): of a separator one, none if it has no rows
    std::vector<Index> interface;                   ///< rows above it in the tree that it touches, ascending
    std::vector<std::size_t> children;              ///< parts
};

/// Supernodes as CHOLMOD has them, but for 64-bit places.
struct SupernodeLayout {
    std::vector<Index> order;                            ///< row of the matrix for each row of L
    std::vector<Index> rank;                             ///< the inverse
    std::vector<Index> first;                            ///< column of each supernode, and the end
    std::vector<Index> rows;                             ///< of all supernodes
    std::vector<std::ptrdiff_t> row_begin, value_begin;  ///< of each supernode, and the end

    Index width(Index s) const { return first[s + 1] - first[s]; }
    Index height(Index s) const { return static_cast<Index>(row_begin[s + 1] - row_begin[s]); }
    const Index* rows_of(Index s) const { return rows.data() + row_begin[s]; }
};

}  // namespace koebe::detail
