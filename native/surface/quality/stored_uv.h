// UVs as Blender stores them: u = (1 + x) / 2, v = (1 + y) / 2, rounded to 32-bit floats.
#pragma once

#include "core/types.h"
#include "core/uv_resolution.h"

#include <algorithm>
#include <cmath>

namespace koebe {

struct StoredPoint {
    double u, v;
};

/// Rounds to a 32-bit float, through memory: GCC 12 leaves the rounding out where it rounds two numbers at once.
inline double as_stored(double coordinate)
{
    const volatile float stored = static_cast<float>(coordinate);
    return stored;
}

inline StoredPoint stored_point(const PlanarPoints& points, Index vertex)
{
    return {as_stored(0.5 * (1.0 + points(vertex, 0))), as_stored(0.5 * (1.0 + points(vertex, 1)))};
}

/// A face as stored; area and edge are computed in 64 bits.
struct StoredFace {
    StoredFace(const StoredPoint& first, const StoredPoint& second, const StoredPoint& third)
        : a(first), b(second), c(third)
    {
    }
    /// @param first the corner where the area is computed from; its last digits depend on it
    StoredFace(const Triangles& triangles, const PlanarPoints& points, Eigen::Index f, int first = 0)
        : a(stored_point(points, triangles(f, first))),
          b(stored_point(points, triangles(f, (first + 1) % 3))),
          c(stored_point(points, triangles(f, (first + 2) % 3)))
    {
    }

    double area() const { return area_from(a, b, c); }
    double longest_edge() const
    {
        return std::max(
            {std::hypot(a.u - b.u, a.v - b.v), std::hypot(b.u - c.u, b.v - c.v), std::hypot(c.u - a.u, c.v - a.v)});
    }
    /// Whether the area is not positive, computed at the first corner.
    bool flipped() const { return !(area() > 0.0); }
    /// Whether the area is not positive at any corner. No reader may see a flip, whichever corner it starts from.
    bool doubtful() const { return flipped() || !(area_from(b, c, a) > 0.0) || !(area_from(c, a, b) > 0.0); }
    bool below_resolution() const { return longest_edge() < uv_resolution; }

    StoredPoint a, b, c;

private:
    static double area_from(const StoredPoint& p, const StoredPoint& q, const StoredPoint& r)
    {
        return 0.5 * ((q.u - p.u) * (r.v - p.v) - (r.u - p.u) * (q.v - p.v));
    }
};

}  // namespace koebe
