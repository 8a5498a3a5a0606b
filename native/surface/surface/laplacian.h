// The cotan Laplacian, edge lengths and areas (paper, section 4.1; Pinkall and Polthier 1993).
#pragma once

#include "core/api.h"
#include "core/types.h"

#include <vector>

namespace koebe {

/// (F, 3) edge lengths: column k is the edge from corner k to corner (k + 1) mod 3, half-edge 3 f + k.
using EdgeLengths = Eigen::Matrix<double, Eigen::Dynamic, 3, Eigen::RowMajor>;

/// (F, 3) edge lengths in the unit of the positions, which lie in space or in the plane.
KOEBE_API EdgeLengths edge_lengths(const Vertices& vertices, const Triangles& triangles);
KOEBE_API EdgeLengths edge_lengths(const PlanarPoints& points, const Triangles& triangles);

/// (F, 3) half the cotangent of the angle opposite to each half-edge, dimensionless. Computed from lengths by cot =
/// (b^2 + c^2 - a^2) / (4 area) with Kahan's area. A face of zero area gets finite weights.
EdgeLengths half_cotangents(const EdgeLengths& lengths);

/// The stiffness matrix K of the Dirichlet energy: u' K u = integral |grad u|^2, dimensionless, (V, V), positive
/// semidefinite, K 1 = 0, stored with its upper and its lower triangle. K_ij = -(cot alpha + cot beta) / 2
/// (docs/method.md, M2). Unused vertices get an empty row.
SparseMatrix cotan_laplacian(const Triangles& triangles, const EdgeLengths& half_cotangents, Index vertex_count);

/// Knows the places of each half-edge's weights in a Laplacian, so that new weights on the same triangles go in fast.
class LaplacianPlaces {
public:
    /// @param laplacian of these triangles
    LaplacianPlaces(const Triangles& triangles, const SparseMatrix& laplacian);

    /// @param laplacian in: of the same triangles; out: cotan_laplacian of these weights, up to rounding
    void fill(const EdgeLengths& half_cotangents, SparseMatrix& laplacian) const;

private:
    struct Places {
        Index there, back, start, end;  ///< (i, j), (j, i), (i, i) and (j, j) of half-edge i-j
    };
    std::vector<Places> of_;
};

/// (V) a third of the area of the faces around each vertex, in squared units of the positions.
VectorXd vertex_areas(const Triangles& triangles, const EdgeLengths& lengths, Index vertex_count);

/// Area of one triangle from its edge lengths, stable for needles (Kahan 1986); 0 where the inequality fails.
double triangle_area(double a, double b, double c);

}  // namespace koebe
