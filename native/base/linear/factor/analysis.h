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
    Index first_supernode = 0, last_supernode = 0;  ///< [first, last): one supernode in a separator with rows
    std::vector<Index> interface;                   ///< rows that the part touches above it in the tree, ascending
    std::vector<std::size_t> children;              ///< the child parts
};

/// The supernodes, and the tree of the dissection. A matrix that is not dissected is one piece.
struct Analysis {
    Supernodes supernodes;
    std::vector<FactorPart> parts;  ///< pieces, separators (each after the parts that it separates), the last rows
    std::size_t piece_count = 0;
    std::vector<std::vector<std::size_t>> rounds;  ///< separators; no two separators of a round touch each other
    Index tops = 0;                                ///< first row that belongs to no piece

    /// Bytes that the factorization takes.
    double memory() const;
};

/// Analyzes a matrix as one piece with CHOLMOD, in the order of AMD.
/// @param matrix symmetric: the lower triangle, or both triangles @param last rows that are kept to the end
/// @param by_fill whether the order weighs the fill in the last rows (elimination_order_by_fill)
/// @throws OutOfMemory where the factor would not fit
Analysis analyze(const SparseMatrix& matrix, const std::vector<Index>& last, bool by_fill = false);

/// Analyzes a matrix by nested dissection. @return nothing if the graph cannot be cut
/// @param matrix both triangles @param last rows kept to the end @param piece_rows about the largest size of a piece
std::optional<Analysis> analyze_in_pieces(const SparseMatrix& matrix, const std::vector<Index>& last, Index piece_rows);

}  // namespace koebe::detail
