// Rows of a matrix that can be analyzed as one. For the .cpp files of linear/ only.
#pragma once

#include "linear/factor/supernodes.h"

#include <vector>

namespace koebe::detail {

/// Groups of neighbouring rows with the same pattern, such as the coordinates of a vertex.
struct RowGroups {
    std::vector<Index> first;  ///< the first row of each group, and the end

    Index count() const { return static_cast<Index>(first.size()) - 1; }
};

/// @param matrix symmetric: the lower triangle, or both triangles
RowGroups row_groups(const SparseMatrix& matrix);

/// The lower triangle of the matrix with one row for each group. Its values are 0.
SparseMatrix pattern_of_groups(const SparseMatrix& matrix, const RowGroups& groups);

/// The order, columns and rows of the supernodes of a matrix, from those of pattern_of_groups.
Supernodes expanded(const Supernodes& of_groups, const RowGroups& groups);

}  // namespace koebe::detail
