// What is known of a factor before there are numbers: its order, its supernodes, its pieces. For the .cpp files of
// linear/ only.
#pragma once

#include "linear/factor/supernodes.h"

#include <cstddef>
#include <optional>
#include <vector>

namespace koebe::detail {

/// A piece, a separator, or the rows that are kept to the end, in the factor's order.
struct FactorPart {
    Index begin = 0, end = 0;                       ///< its rows
    Index first_supernode = 0, last_supernode = 0;  ///< [first, last): of a separator one, none if it has no rows
    std::vector<Index> interface;                   ///< rows above it in the tree that it touches, ascending
    std::vector<std::size_t> children;              ///< parts
};

/// The supernodes, and the tree of the dissection. A matrix that is not dissected is one piece.
struct Analysis {
    Supernodes supernodes;
    std::vector<FactorPart> parts;  ///< the pieces, then the separators, each after those it parts, then what is last
    std::size_t piece_count = 0;
    std::vector<std::vector<std::size_t>> rounds;  ///< separators: those of a round touch none of the others
    Index tops = 0;                                ///< first row that belongs to no piece

    /// Bytes that the factorization takes.
    double memory() const;
};

/// As CHOLMOD has it, in the order of AMD.
/// @param matrix symmetric: the lower triangle, or both @param last rows that are kept to the end
/// @throws OutOfMemory where the factor would not fit
Analysis analyze(const SparseMatrix& matrix, const std::vector<Index>& last);

/// By nested dissection. @return none where the graph does not come apart
/// @param matrix both triangles @param last rows that are kept to the end @param piece_rows of a piece at most, about
std::optional<Analysis> analyze_in_pieces(const SparseMatrix& matrix, const std::vector<Index>& last, Index piece_rows);

}  // namespace koebe::detail
