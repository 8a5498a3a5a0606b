#include "surface/ambient_visibility.h"

#include "core/numbering.h"
#include "core/silent_cgal.h"
#include "surface/face_vectors.h"
#include "surface/triangle_tree.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

namespace koebe {
namespace {

constexpr double most_directions = 32.0, fewest_directions = 8.0;
constexpr double most_rays =
    1e5;  // in all: of the vertices of a large mesh, which has no coarser one, fewer directions
constexpr Eigen::Index most_starts = 40000;         // vertices from which rays start
constexpr double golden_angle = 2.399963229728653;  // the turn from one direction to the next: they spread evenly
constexpr double off_surface = 1e-3;                // start of a ray, over the extent
constexpr int most_looks = 500;                     // at boxes and faces, for a ray: needles that cross have no tree
constexpr double least_way = 1e-200;                // of a ray in a direction, so that it has an inverse
constexpr double wider = 1.0 + 1e-12;               // share by which rounding may make a box narrower

/// A ray for CGAL's tests of faces, and for a quicker one of boxes.
struct SightRay {
    SightRay(const Eigen::RowVector3d& start, const Eigen::RowVector3d& to)
        : ray({start[0], start[1], start[2]}, TreeKernel::Vector_3(to[0], to[1], to[2]))
    {
        for (int k = 0; k < 3; ++k) {
            from[k] = start[k];
            inverse[k] = 1.0 / (std::abs(to[k]) > least_way ? to[k] : least_way);
        }
    }

    /// Whether it may meet a box: that is where it is between both sides of each direction at once.
    bool meets(const CGAL::Bbox_3& box) const
    {
        double enters = 0.0, leaves = std::numeric_limits<double>::infinity();
        for (int k = 0; k < 3; ++k) {
            const double a = (box.min(k) - from[k]) * inverse[k], b = (box.max(k) - from[k]) * inverse[k];
            enters = std::max(enters, std::min(a, b));
            leaves = std::min(leaves, std::max(a, b));
        }
        return enters <= wider * leaves;
    }

    TreeKernel::Ray_3 ray;
    std::array<double, 3> from, inverse;
};

/// Looks for a face in the way of a ray; the parts are those that CGAL's traversal of a tree asks for.
class WayOfRay {
public:
    bool go_further() const { return !is_blocked_ && looks_ < most_looks; }
    void intersection(const SightRay& sight, const NumberedTriangle& face)
    {
        ++looks_;
        if (is_blocked_) return;
        const TreeKernel::Triangle_3 corners = face.datum();
        is_blocked_ = sight.meets(corners.bbox()) && TreeKernel().do_intersect_3_object()(sight.ray, corners);
    }
    template <typename Node>
    bool do_intersect(const SightRay& sight, const Node& node)
    {
        ++looks_;
        return sight.meets(node.bbox());
    }
    bool is_blocked() const { return is_blocked_; }

private:
    int looks_ = 0;
    bool is_blocked_ = false;
};

/// Normals of vertices, weighted by area, towards the outer side. Each has the length of twice the area round it.
Vertices outward_normals(const Vertices& vertices, const Triangles& triangles)
{
    Vertices normals = Vertices::Zero(vertices.rows(), 3);
    for (Eigen::Index f = 0; f < triangles.rows(); ++f)
        for (const Index v : triangles.row(f)) normals.row(v) += twice_area_vector(vertices, triangles, f);
    return outer_side(vertices, triangles) * normals;
}

/// The first neighbour that a face gives a vertex: with the normal it makes a frame that turns with the surface.
std::vector<Index> first_neighbours(const Vertices& vertices, const Triangles& triangles)
{
    std::vector<Index> neighbour(static_cast<std::size_t>(vertices.rows()), -1);
    for (const auto row : triangles.rowwise())
        for (int k = 0; k < 3; ++k)
            if (neighbour[row[k]] < 0) neighbour[row[k]] = row[(k + 1) % 3];
    return neighbour;
}

/// Fills in the entries below 0: each gets the mean of neighbours that have one.
void spread(const Triangles& triangles, VectorXd& seen)
{
    for (bool any = true; std::exchange(any, false);)
        for (const auto face : triangles.rowwise())
            for (int k = 0; k < 3; ++k) {
                const double a = seen[face[(k + 1) % 3]], b = seen[face[(k + 2) % 3]];
                if (seen[face[k]] >= 0.0 || std::max(a, b) < 0.0) continue;
                seen[face[k]] = std::min(a, b) < 0.0 ? std::max(a, b) : 0.5 * (a + b);
                any = true;
            }
}

}  // namespace

VectorXd ambient_visibility(const Vertices& vertices, const Triangles& triangles)
{
    const SilentCgal silent;
    std::vector<Index> faces = numbers_below(triangles.rows());
    const TriangleTree tree(faces.cbegin(), faces.cend(), vertices, triangles);
    const Vertices normals = outward_normals(vertices, triangles);
    const std::vector<Index> neighbour = first_neighbours(vertices, triangles);
    const double extent = (vertices.colwise().maxCoeff() - vertices.colwise().minCoeff()).norm();
    const auto stride = static_cast<Index>((vertices.rows() + most_starts - 1) / most_starts);
    const int directions = static_cast<int>(
        std::clamp(most_rays * stride / static_cast<double>(vertices.rows()), fewest_directions, most_directions));
    VectorXd seen = VectorXd::Constant(vertices.rows(), -1.0);
    for (Index v = 0; v < static_cast<Index>(vertices.rows()); v += stride) {
        seen[v] = 1.0;
        if (!(normals.row(v).norm() > 0.0)) continue;
        const Eigen::RowVector3d up = normals.row(v).normalized();
        const Eigen::RowVector3d across = up.cross(vertices.row(neighbour[v]) - vertices.row(v)).normalized();
        const Eigen::RowVector3d along = across.cross(up), start = vertices.row(v) + off_surface * extent * up;
        int free = 0;  // of rays with the density of the cosine: on Vogel's spiral, projected up
        for (int k = 0; k < directions; ++k) {
            const double share = (k + 0.5) / directions, angle = golden_angle * k;
            const Eigen::RowVector3d to =
                std::sqrt(share) * (std::cos(angle) * along + std::sin(angle) * across) + std::sqrt(1.0 - share) * up;
            WayOfRay way;
            tree.traversal(SightRay(start, to), way);
            free += !way.is_blocked();
        }
        seen[v] = static_cast<double>(free) / directions;
    }
    if (stride > 1) spread(triangles, seen);
    return seen;
}

}  // namespace koebe
