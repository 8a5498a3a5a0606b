// Coordinates that follow from a surface's shape and its numbers alone.
#pragma once

#include "core/types.h"
#include "execution/thread_share.h"
#include "mesh/topology.h"

namespace koebe {

/// A position in space that follows from the shape alone.
struct CanonicalPosition {
    Vertices vertices;  ///< (V, 3) within the unit ball, rounded to a grid
    double thinnest = 0.0;
    Eigen::Matrix3d turn;  ///< its columns are the axes: a direction d of the input, a row vector, becomes d * turn
};

/// The position of a surface with canonical numbers. @throws InputError all vertices lie at one point
CanonicalPosition canonical_position(const Surface& surface, const Vertices& vertices);

/// Moves the surface to 0 and scales it to about unit size, so that no length overflows. @throws as above
Vertices scaled_position(const Surface& surface, const Vertices& vertices);

/// Moves, turns and rounds the result of scaled_position. @throws as above
CanonicalPosition turned_position(const Triangles& triangles, Vertices points);

inline constexpr double same_size = 1e-4;  // lengths count as equal within this relative difference, above 32-bit noise
inline constexpr std::size_t rows_at_a_time = 32768;

/// Calls work(first, count) for the rows of a matrix in blocks.
template <class Work>
void each_rows(Eigen::Index rows, const Work& work)
{
    in_pieces(static_cast<std::size_t>(rows), rows_at_a_time, [&](std::size_t begin, std::size_t end) {
        work(static_cast<Eigen::Index>(begin), static_cast<Eigen::Index>(end - begin));
    });
}

}  // namespace koebe
