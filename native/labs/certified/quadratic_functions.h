// Continuous functions that are quadratic on each triangle, and their Dirichlet energy.
#pragma once

#include "certified/bisected_surface.h"
#include "surface/one_form.h"

#include <array>

namespace koebe {

/// A function has a coefficient for each vertex, its value there, and then one for each edge: by how much its value in
/// the middle of the edge exceeds the mean of the values at the ends. Its gradient is linear on a triangle, so that
/// integrals of squares are exactly the mean over the middles of the three edges (Hammer and Stroud 1956).
class QuadraticFunctions {
public:
    explicit QuadraticFunctions(const BisectedSurface& surface);

    Index size() const { return size_; }
    /// The coefficient of a half-edge's edge.
    Index edge(Index halfedge) const { return edge_[halfedge]; }

    /// (size, size) the matrix of the Dirichlet energy; both triangles stored.
    SparseMatrix energy_matrix(const EdgeLengths& half_cotangents) const;

    /// (size) the derivative of -energy / 2 of a function plus a form that is constant on each face, at 0.
    VectorXd load(const EdgeLengths& half_cotangents, const OneForm& form) const;

    /// The integrals of the gradient in the middle of edge m of face f, plus the form, along the edges that leave
    /// corner 0.
    std::array<Interval, 2> covector(const VectorXd& function, const OneForm* form, Index f, int m) const;

private:
    std::array<Index, 6> coefficients(Index f) const;

    const BisectedSurface& surface_;
    std::vector<Index> edge_;
    Index size_ = 0;
};

}  // namespace koebe
