// The disk D_k that fills a loop in the mesh engine, and its harmonic refill f_k (paper, section 4.4).
#pragma once

#include "core/types.h"
#include "surface/laplacian.h"

namespace koebe {

/// A disk of triangles. Its first vertices are the loop's vertices in the loop's order.
class DiskPatch {
public:
    /// Makes the fan around the mean of the loop's vertices. @param loop (m, 3) positions, the surface on the left
    explicit DiskPatch(const Vertices& loop);

    /// Fills a polygon with flat triangles. A fan is replaced by a Delaunay mesh of the polygon. Later polygons get the
    /// harmonic image of that mesh in its present metric, as long as its triangles stay good.
    /// @param rim (m) points of the unit circle, clockwise, as the loop runs seen from the disk
    /// @param radius of the disk; it scales the lengths
    /// @throws InputError the polygon is not simple
    void refill(const VectorXcd& rim, double radius = 1.0);

    /// Sets another metric on the same triangles.
    void set_lengths(const EdgeLengths& lengths) { lengths_ = lengths; }

    const Triangles& triangles() const { return triangles_; }
    const EdgeLengths& lengths() const { return lengths_; }
    Index rim_size() const { return rim_size_; }
    Index vertex_count() const { return vertex_count_; }

private:
    void mesh(const VectorXcd& rim);
    VectorXcd harmonic_image(const VectorXcd& rim) const;

    Triangles triangles_;
    EdgeLengths lengths_;
    Index rim_size_ = 0, vertex_count_ = 0;
    bool is_fan_ = true;
    double angle_when_meshed_ = 0.0;  // smallest angle, radians
};

/// Lengths of the edges of each face in the plane.
EdgeLengths planar_lengths(const VectorXcd& z, const Triangles& triangles);

}  // namespace koebe
