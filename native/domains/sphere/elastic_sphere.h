// Bends a triangulated sphere like an elastic skin, and never turns a face over.
#pragma once

#include "core/types.h"
#include "execution/execution.h"
#include "linear/kept_factor.h"
#include "surface/periodic_surface.h"

#include <Eigen/Core>

#include <functional>
#include <vector>

namespace koebe {

/// Residuals (V, k) of vertices on the sphere: half the sum of their squares is added to the energy. With slopes, k
/// times (V, 3), also their derivatives by the place, tangent to the sphere.
using SphereResiduals = std::function<MatrixXd(const Vertices& points, std::vector<Vertices>* slopes)>;

/// The sum over the faces of weight phi(q), q = (s1 / s2 + s2 / s1 - 2) / 2 + theta (s1 s2 + 1 / (s1 s2) - 2) / 2. s1
/// and s2 are the singular values of the map from the wanted shape to the flat face between the corners on the sphere.
/// phi(q) = q, or q + q^2 / (2 (theta + slack)) up to a constant. The square lets single held vertices count on fine
/// meshes, too (foldover_free.h).
struct ElasticSphere {
    const Triangles& triangles;
    std::vector<Eigen::Matrix2d> reference;  ///< (F) columns: edges 0-1 and 0-2 of the wanted shape, of positive area
    VectorXd weight;                         ///< (F)
    double area_weight = 1.0;                ///< theta: of areas against angles
    double slack = 0.0;                      ///< 0: phi(q) = q
    std::vector<char> held = {};             ///< (V) 1: the vertex stays; empty: none does
    SphereResiduals residuals = {};          ///< empty: none
};

struct ElasticRelaxation {
    int steps = 0;         ///< Newton steps taken
    bool settled = false;  ///< whether the energy, or its last decrease, is small enough
};

/// The edges 0-1 and 0-2 of a flat face in its own plane, as columns.
Eigen::Matrix2d flat_edges(const Vertices& points, const Triangles& triangles, Eigen::Index face);

/// Minimizes the energy by Newton's method, on Hessians made positive semidefinite face by face, and Gauss-Newton for
/// the residuals. Vertices move in their tangent planes, and are put back onto the sphere. Each step is halved until
/// all faces are upright in exact arithmetic and the energy falls.
/// @param points (V, 3) in: unit vectors, all faces upright; out: likewise
/// @param settled relative decrease of the energy at which the minimization ends
/// @param factor empty, or as an earlier call with the same triangles and held vertices left it
/// @throws Cancelled
ElasticRelaxation relax_on_sphere(const ElasticSphere& sphere, Vertices& points, int most_steps, double settled,
                                  KeptFactor& factor, const ExecutionContext& context);

/// Whether all faces are upright, in exact arithmetic.
bool all_upright(const Triangles& triangles, const Vertices& points);

/// Minimizes E_t of even/even_map.h, from the surface's faces to the flat faces on the sphere. The surface is scaled to
/// the area of the map. At first sizes are wanted that are near the present ones (Liu, Ye, Ni and Fu 2018). Vertices of
/// loops stay.
/// @param points (V, 3) unit vectors @param even E, above 0 to 1
/// @return false, with the points as they were, if the map has faces that are not upright, or none that moves
/// @throws Cancelled
bool make_sphere_even(const PeriodicSurface& domain, double even, Vertices& points, const ExecutionContext& context);

}  // namespace koebe
