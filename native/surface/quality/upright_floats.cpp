#include "quality/upright_floats.h"

#include "mesh/vertex_faces.h"
#include "quality/stored_uv.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <vector>

namespace koebe {
namespace {

constexpr int rounds_of_moves = 8;
constexpr int most_steps = 4;  // floats between a point and its place

/// The float that lies some steps away.
double stepped(double coordinate, int steps)
{
    const float end = std::copysign(std::numeric_limits<float>::infinity(), static_cast<float>(steps));
    auto value = static_cast<float>(coordinate);
    for (int i = 0; i < std::abs(steps); ++i) value = std::nextafter(value, end);
    return value;
}

/// Faces that are upright in 64 bits, but not as they are rounded.
class TurnedFaces {
public:
    TurnedFaces(const PlanarPoints& points, const Triangles& triangles) : points_(points), triangles_(triangles) {}

    std::vector<Index> all(const PlanarPoints& rounded) const
    {
        std::vector<Index> found;
        for (Index f = 0; f < static_cast<Index>(triangles_.rows()); ++f)
            if (is_turned(rounded, f)) found.push_back(f);
        return found;
    }

    bool is_turned(const PlanarPoints& rounded, Index f) const
    {
        return face(rounded, f).doubtful() && !face(points_, f).flipped();
    }

private:
    StoredFace face(const PlanarPoints& at, Index f) const
    {
        const auto corner = [&](int k) { return StoredPoint{at(triangles_(f, k), 0), at(triangles_(f, k), 1)}; };
        return {corner(0), corner(1), corner(2)};
    }

    const PlanarPoints& points_;
    const Triangles& triangles_;
};

}  // namespace

PlanarPoints upright_floats(const PlanarPoints& points, const Triangles& triangles)
{
    PlanarPoints rounded = points.unaryExpr(&as_stored);
    const TurnedFaces turned(points, triangles);
    std::vector<Index> left = turned.all(rounded);
    if (left.empty()) return rounded;
    const VertexFaces around(triangles, static_cast<Index>(points.rows()));
    const auto turned_around = [&](Index v) {
        return std::ranges::count_if(around[v], [&](Index f) { return turned.is_turned(rounded, f); });
    };
    // Of the floats near its point a vertex takes the nearest one at which the fewest of its faces are turned.
    const auto move = [&](Index v) {
        auto fewest = turned_around(v);
        Eigen::RowVector2d best = rounded.row(v);
        for (int ring = 1; ring <= most_steps && fewest > 0; ++ring)
            for (int i = -ring; i <= ring; ++i)
                for (int j = -ring; j <= ring; ++j) {
                    if (std::max(std::abs(i), std::abs(j)) != ring) continue;
                    rounded.row(v) << stepped(points(v, 0), i), stepped(points(v, 1), j);
                    if (const auto now = turned_around(v); now < fewest) {
                        fewest = now;
                        best = rounded.row(v);
                    }
                }
        rounded.row(v) = best;
    };
    for (int round = 0; round < rounds_of_moves && !left.empty(); ++round, left = turned.all(rounded))
        for (const Index f : left)
            for (int k = 0; k < 3 && turned.is_turned(rounded, f); ++k) move(triangles(f, k));
    return rounded;
}

}  // namespace koebe
