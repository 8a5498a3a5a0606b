// Coordinates that follow from a surface's shape and its numbers alone.
#pragma once

#include "core/types.h"
#include "execution/thread_share.h"
#include "mesh/topology.h"

namespace koebe {

/// A position in space that follows from the shape alone.
struct CanonicalPosition {
    Vertices vertices;  ///< (V, 3) within the unit ball, on a grid
    double thinnest = 0.0;
    Eigen::Matrix3d turn;  ///< its columns are the axes: a direction d of the input, as a row, is d * turn here
};

/// That of a surface whose numbers are canonical already. @throws InputError all vertices lie on one point
CanonicalPosition canonical_position(const Surface& surface, const Vertices& vertices);

/// About 0 and of about unit size, so that no length overflows. @throws as above
Vertices scaled_position(const Surface& surface, const Vertices& vertices);

/// The rest of the way from there: moved, turned and put on the grid. @throws as above
CanonicalPosition turned_position(const Triangles& triangles, Vertices points);

inline constexpr double same_size = 1e-4;  // relative difference of lengths that count as one: more than 32-bit noise
inline constexpr std::size_t rows_at_a_time = 32768;

/// Calls work(first, count) for the rows of a matrix, piece by piece.
template <class Work>
void each_rows(Eigen::Index rows, const Work& work)
{
    in_pieces(static_cast<std::size_t>(rows), rows_at_a_time, [&](std::size_t begin, std::size_t end) {
        work(static_cast<Eigen::Index>(begin), static_cast<Eigen::Index>(end - begin));
    });
}

}  // namespace koebe
