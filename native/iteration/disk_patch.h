// The disk D_k that fills a loop in the mesh engine, and its harmonic refill f_k (paper, section 4.4).
#pragma once

#include "core/types.h"
#include "surface/laplacian.h"

namespace koebe {

struct DiskPatchOptions {
    /// In mean edges of the rim. 1 keeps second order (the paper says nothing of it): the disk of loop 0 may then
    /// have more faces than the surface. With 1.5 the error is up to ten times larger, with 3 it stops falling.
    double longest_edge = 1.0;
    double gradation = 0.25;   ///< growth of the edge length per distance from the rim, dimensionless
    double worst_angle = 0.5;  ///< a mesh whose smallest angle falls below this part of what it was is made anew
};

/// A disk of triangles. Its first vertices are the loop's, in the loop's order.
class DiskPatch {
public:
    /// The fan around the mean of the loop's vertices, on the surface. @param loop (m, 3), the surface on the left
    explicit DiskPatch(const Vertices& loop, const DiskPatchOptions& options = {});

    /// Makes it the flat disk inside a polygon. A fan gives way to a Delaunay mesh of the polygon, which then follows
    /// new polygons by the harmonic map of its present metric, as long as its triangles stay good.
    /// @param rim (m) points of the unit circle, clockwise, as the loop runs seen from the disk
    /// @param radius the disk's, by which the lengths are scaled
    /// @throws InputError the polygon is not simple
    void refill(const VectorXcd& rim, double radius = 1.0);

    /// Another metric on the same triangles.
    void set_lengths(const EdgeLengths& lengths) { lengths_ = lengths; }

    const Triangles& triangles() const { return triangles_; }
    const EdgeLengths& lengths() const { return lengths_; }
    Index rim_size() const { return rim_size_; }
    Index vertex_count() const { return vertex_count_; }

private:
    void mesh(const VectorXcd& rim);
    VectorXcd harmonic_image(const VectorXcd& rim) const;

    DiskPatchOptions options_;
    Triangles triangles_;
    EdgeLengths lengths_;
    Index rim_size_ = 0, vertex_count_ = 0;
    bool is_fan_ = true;
    double angle_when_meshed_ = 0.0;  // smallest angle, radians
};

/// Lengths of the edges of each face in the plane.
EdgeLengths planar_lengths(const VectorXcd& z, const Triangles& triangles);

}  // namespace koebe
