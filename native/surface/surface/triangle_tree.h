// The triangles of a mesh in CGAL's tree of bounding boxes.
#pragma once

#include "core/types.h"

#include <CGAL/AABB_traits.h>
#include <CGAL/AABB_tree.h>
#include <CGAL/Simple_cartesian.h>

#include <vector>

namespace koebe {

using TreeKernel = CGAL::Simple_cartesian<double>;

/// A triangle of the mesh with its number; planar triangles have z = 0.
struct NumberedTriangle {
    using Id = Index;
    using Point = TreeKernel::Point_3;
    using Datum = TreeKernel::Triangle_3;

    NumberedTriangle(std::vector<Index>::const_iterator number, const Vertices& of_corners, const Triangles& of_faces)
        : face(*number), corners(&of_corners), triangles(&of_faces)
    {
    }

    Id id() const { return face; }
    /// Boxes are divided by it: by a corner, those of long triangles would overlap more.
    Point reference_point() const { return CGAL::centroid(corner(0), corner(1), corner(2)); }
    Datum datum() const { return {corner(0), corner(1), corner(2)}; }
    Point corner(int k) const
    {
        const Index v = (*triangles)(face, k);
        return {(*corners)(v, 0), (*corners)(v, 1), (*corners)(v, 2)};
    }

    Index face;
    const Vertices* corners;
    const Triangles* triangles;
};

using TriangleTree = CGAL::AABB_tree<CGAL::AABB_traits<TreeKernel, NumberedTriangle>>;

}  // namespace koebe
