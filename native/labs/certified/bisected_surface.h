// A polyhedral surface whose faces are cut ever finer, while the surface stays exactly the same.
#pragma once

#include "certified/interval.h"
#include "mesh/topology.h"
#include "surface/laplacian.h"

#include <array>
#include <vector>

namespace koebe {

/// A triangulation of a polyhedral surface. Every triangle lies in a face of the input, and its corners are exact:
/// their coordinates in the face are fractions with a power of two below. Only the input's own metric is rounded, and
/// intervals enclose it.
///
/// Faces are cut in two by newest vertex bisection (Mitchell 1989), which makes four shapes of triangles at most from
/// each face. The edge to cut is the one from corner 0 to corner 1.
class BisectedSurface {
public:
    /// @param surface all loops are numbered as here
    /// @throws InputError faces without area, up to rounding (listed)
    BisectedSurface(const Vertices& vertices, const Surface& surface);

    const Triangles& triangles() const { return triangles_; }
    const std::vector<Index>& twin() const { return twin_; }
    Index vertex_count() const { return static_cast<Index>(loop_of_.size()); }
    Index face_count() const { return static_cast<Index>(triangles_.rows()); }
    /// (V) the loop that holds each vertex, -1 inside.
    const std::vector<int>& loop_of() const { return loop_of_; }
    int loop_count() const { return loop_count_; }

    /// (F, 3) in a power of two times the input's unit, rounded.
    EdgeLengths lengths() const;

    /// Integral over face f of the squared length of a constant covector, from its integrals along the edges that leave
    /// corner 0.
    Interval energy(Index f, const Interval& to_corner_1, const Interval& to_corner_2) const;

    /// Cuts the marked faces in four, and further faces until all edges match. @param marked (F)
    void refine(const std::vector<char>& marked);

private:
    using Corners = std::array<double, 6>;  // (x, y) of the corners 0, 1, 2: the place is origin + x a + y b
    struct Plane {
        std::array<Interval, 3> a, b;  // the input face's edges that leave its corner 0
        Interval per_energy;           // 1 / |a x b| / 2
    };

    Triangles triangles_;
    std::vector<Index> twin_;
    std::vector<int> loop_of_;
    std::vector<Corners> corners_;
    std::vector<std::uint8_t> depth_;  // the area is 2^-depth of the input face's
    std::vector<Index> input_face_;
    std::vector<Plane> planes_;
    int loop_count_ = 0;
};

}  // namespace koebe
