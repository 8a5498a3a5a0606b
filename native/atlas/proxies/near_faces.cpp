#include "proxies/near_faces.h"

#include "core/connectivity.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace koebe {
namespace {

constexpr std::size_t many_around = 64;  // faces: round such a vertex they are looked at only if there are no others

Eigen::RowVector3d middle_of(const CornersInSpace& at) { return (at[0] + at[1] + at[2]) / 3.0; }

}  // namespace

CornersInSpace corners_of(const Vertices& vertices, const Triangles& triangles, Index f)
{
    return {vertices.row(triangles(f, 0)), vertices.row(triangles(f, 1)), vertices.row(triangles(f, 2))};
}

NearFaces::NearFaces(const Proxy& proxy) : proxy_(proxy), around_(proxy.coarse.vertex.size())
{
    for (Index c = 0; c < static_cast<Index>(proxy.surface.triangles.size()); ++c)
        around_[proxy.surface.triangles(c / 3, c % 3)].push_back(c / 3);
}

Index NearFaces::nearest(Index fine) const
{
    const CutSurface& whole = proxy_.fine.whole;
    const Eigen::RowVector3d middle = middle_of(corners_of(whole.vertices, whole.surface.triangles, fine));
    std::pair<double, Index> best{std::numeric_limits<double>::infinity(), -1};
    for (const bool among_many : {false, true})
        for (int k = 0; k < 3 && (!among_many || best.second < 0); ++k) {
            const std::vector<Index>& faces = around_[proxy_.coarse.vertex_at[whole.surface.triangles(fine, k)]];
            if ((faces.size() > many_around) != among_many) continue;
            for (const Index face : faces) best = std::min(best, {squared_distance(middle, face), face});
        }
    return best.second;
}

std::vector<Index> NearFaces::of_piece(const FlatPart& piece, const CoarseNet& net, const FlatPart& part,
                                       int number) const
{
    const std::vector<char> outside = boundary_mask(part.surface);
    std::vector<Index> near(piece.faces.size(), -1), queue;
    const auto take = [&](Index f, Index face) {
        near[f] = face;
        queue.push_back(f);
    };
    // Begin at faces that are surely on the right side of all cuts; at any face, if there are none.
    for (const bool anywhere : {false, true})
        for (Index f = 0; f < static_cast<Index>(near.size()) && (!anywhere || queue.empty()); ++f) {
            const Index face = nearest(piece.faces[f]);
            if (face < 0 || net.place[face].part != number) continue;
            const auto row = part.surface.triangles.row(net.place[face].face);
            if (anywhere || !(outside[row[0]] || outside[row[1]] || outside[row[2]])) take(f, face);
        }
    for (std::size_t i = 0; i < queue.size(); ++i)
        for (Index h = 3 * queue[i]; h < 3 * queue[i] + 3; ++h)
            if (const Index t = piece.surface.twin[h]; t != no_twin && near[face_of(t)] < 0) {
                const CornersInSpace at = corners_of(piece.vertices, piece.surface.triangles, face_of(t));
                take(face_of(t), walk(middle_of(at), net, part, near[queue[i]]));
            }
    return near;
}

/// Squared distance of a place from a coarse face.
double NearFaces::squared_distance(const Eigen::RowVector3d& place, Index coarse) const
{
    const CornersInSpace at = corners_of(proxy_.coarse.vertices, proxy_.surface.triangles, coarse);
    const Eigen::RowVector3d normal = (at[1] - at[0]).cross(at[2] - at[0]);
    double least = std::numeric_limits<double>::infinity();
    bool is_inside = normal.squaredNorm() > 0.0;
    for (int k = 0; k < 3; ++k) {
        const Eigen::RowVector3d edge = at[(k + 1) % 3] - at[k], arm = place - at[k];
        is_inside = is_inside && normal.dot(edge.cross(arm)) >= 0.0;
        const double share = std::clamp(arm.dot(edge) / std::max(edge.squaredNorm(), 1e-300), 0.0, 1.0);
        least = std::min(least, (arm - share * edge).squaredNorm());
    }
    if (is_inside) least = std::min(least, std::pow(normal.dot(place - at[0]), 2) / normal.squaredNorm());
    return least;
}

/// Goes on in a part from face to face, as long as that is nearer to a place.
Index NearFaces::walk(const Eigen::RowVector3d& place, const CoarseNet& net, const FlatPart& part, Index face) const
{
    double least = squared_distance(place, face);
    for (bool is_nearer = true; std::exchange(is_nearer, false);) {
        const Index here = net.place[face].face;
        for (Index h = 3 * here; h < 3 * here + 3; ++h)
            if (const Index t = part.surface.twin[h]; t != no_twin)
                if (const double own = squared_distance(place, part.faces[face_of(t)]); own < least) {
                    least = own;
                    face = part.faces[face_of(t)];
                    is_nearer = true;
                }
    }
    return face;
}

}  // namespace koebe
