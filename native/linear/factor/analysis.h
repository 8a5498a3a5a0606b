// The symbolic part of a factor: its order, its supernodes, its pieces. For the .cpp files of linear/ only.
#pragma once

#include "linear/factor/supernodes.h"

#include <cstddef>
#include <optional>
#include <vector>

namespace koebe::detail {

/// A piece, a separator, or the rows that are kept to the end, in the factor's order.
struct FactorPart {
    Index begin = 0, end = 0;                       ///< its rows
    Index first_supernode = 0, last_supernode = 0;  ///< [first, last): one in a separator with rows
    std::vector<Index> interface;                   ///< rows that the part touches above it in the tree, ascending
    std::vector<std::size_t> children;              ///< the child parts
};

/// The supernodes, and the tree of the dissection. A matrix that is not dissected is one piece.
struct Analysis {
    Supernodes supernodes;
    std::vector<FactorPart> parts;  ///< pieces, then separators, each after the parts it separates, then the last rows
    std::size_t piece_count = 0;
    std::vector<std::vector<std::size_t>> rounds;  ///< separators; in a round no two touch each other
    Index tops = 0;                                ///< first row that belongs to no piece

    /// Bytes that the factorization takes.
    double memory() const;
};

/// Analyzes a matrix as one piece with CHOLMOD, in the order of AMD.
/// @param matrix symmetric: the lower triangle, or both @param last rows that are kept to the end
/// @throws OutOfMemory where the factor would not fit
Analysis analyze(const SparseMatrix& matrix, const std::vector<Index>& last);

/// Analyzes a matrix by nested dissection. @return nothing where the graph does not come apart
/// @param matrix both triangles @param last rows kept to the end @param piece_rows largest size of a piece, about
std::optional<Analysis> analyze_in_pieces(const SparseMatrix& matrix, const std::vector<Index>& last, Index piece_rows);

}  // namespace koebe::detail
