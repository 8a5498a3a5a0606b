#include "lift/raised.h"

#include "core/connectivity.h"

namespace koebe {
namespace {

/// Half-edges of raised faces whose other side is on the ground.
std::vector<Index> feet_of_walls(const Triangles& triangles, const std::vector<Index>& up, Index vertex_count)
{
    const std::vector<Index> twin = pair_halfedges(triangles, vertex_count);
    std::vector<Index> feet;
    for (Index h = 0; h < static_cast<Index>(twin.size()); ++h)
        if (twin[h] != no_twin && up[face_of(h)] && !up[face_of(twin[h])]) feet.push_back(h);
    return feet;
}

}  // namespace

RaisedSheet raise_faces(const Triangles& triangles, const std::vector<Complex>& uv, const std::vector<Index>& up,
                        Index vertex_count, double height)
{
    const std::vector<Index> feet = feet_of_walls(triangles, up, vertex_count);
    RaisedSheet raised;
    std::vector<Index> above(vertex_count, -1);  // the vertex at the height over a foot
    for (Index v = 0; v < vertex_count; ++v) raised.source.push_back(v);
    const auto raise = [&](Index v) {
        if (above[v] >= 0) return;
        above[v] = static_cast<Index>(raised.source.size());
        raised.source.push_back(v);
    };
    for (const Index h : feet) raise(origin(triangles, h));
    for (const Index h : feet) raise(target(triangles, h));  // where a wall ends at a loop
    raised.height = VectorXd::Zero(static_cast<Eigen::Index>(raised.source.size()));
    raised.height.tail(raised.height.size() - vertex_count).setConstant(height);

    const Eigen::Index faces = triangles.rows();
    raised.triangles.resize(faces + 2 * static_cast<Eigen::Index>(feet.size()), 3);
    raised.triangles.topRows(faces) = triangles;
    raised.uv = uv;
    for (Eigen::Index f = 0; f < faces; ++f) {
        raised.patch.push_back(up[f] ? 1 : 0);
        if (!up[f]) continue;
        for (int k = 0; k < 3; ++k) {
            Index& v = raised.triangles(f, k);
            if (above[v] >= 0)
                v = above[v];
            else
                raised.height[v] = height;
        }
    }
    Eigen::Index wall = faces;
    for (const Index h : feet) {
        const Index a = origin(triangles, h), b = target(triangles, h);
        const Complex at_a = uv[h], at_b = uv[next_halfedge(h)];
        raised.triangles.row(wall++) << a, b, above[b];
        raised.triangles.row(wall++) << a, above[b], above[a];
        raised.uv.insert(raised.uv.end(), {at_a, at_b, at_b, at_a, at_b, at_a});
        raised.patch.insert(raised.patch.end(), 2, 2);
    }
    return raised;
}

}  // namespace koebe
