// Maps a surface with holes to a given circle domain: circles at given places, of given sizes.
#pragma once

#include "core/api.h"
#include "execution/execution.h"
#include "fit/circle_template.h"
#include "pipeline/result.h"

#include <string>
#include <vector>

namespace koebe {

struct FitOptions {
    UniformizeOptions map;  ///< of the conformal map that is bent; no balance, center, point, polish, even
    /// Least largest |mu|, nearly: minimizes high powers of the distortion, up to the 16th.
    bool extremal = false;
};

/// |mu| of a map.
struct FitBeltrami {
    double mean = 0.0, max = 0.0;
    double root_mean_square = 0.0;  ///< of faces weighed by their areas on the surface
    double dilatation = 1.0;        ///< largest K = (1 + |mu|) / (1 - |mu|)
};

/// `loops` are the template's circles in their order, the unit circle first. None is the surface's own circle, unless
/// the template is its conformal domain. `conformal` has the surface's own circles in the same order.
struct FitResult : UniformizeResult {
    std::vector<std::string> names;  ///< of the holes, or empty
    std::vector<int> ranks;          ///< for each of `loops` its number in Surface::loops
    VectorXd mu;                     ///< (F) |mu| of each face from the surface to the template; 1: without area
    FitBeltrami of_faces;            ///< of these
    FitBeltrami bending;             ///< from the conformal domain to the template
    double residual = 0.0;           ///< largest distance of a rim's vertex from its circle, disk units
    bool straight = true;            ///< whether centres went straight; else on bows, which chose the isotopy class
    int bending_steps = 0, newton_steps = 0;
};

/// The map to the template of least sum of a_f 4 |mu_f|^2 / (1 - |mu_f|^2) over the faces: a_f is a face's area on the
/// surface, mu_f its Beltrami coefficient from the conformal circle domain.
///
/// The surface is uniformized. An automorphism of the disk lays its circles over the template's (align_domains). If
/// no loops are given, loops and circles are matched by the nearest conformal modules, and afterwards by the nearest
/// circles. From there circles move to their places without meeting (paths_between), and the map follows, one to one
/// all the way (bend_along). There are many such maps that no continuous motion on the template takes to each other:
/// how often holes wind around each other is chosen by the path. Straight paths are taken where they leave room.
/// @param vertices (V, 3) @param triangles (F, 3)
/// @throws InputError a template that is not feasible (require_feasible), has another number of circles than the
/// surface has holes, names loops or vertices that the surface lacks, or pins a vertex of another loop; TopologyError;
/// SolverError no such map was found (circles listed, counted from 0); Cancelled
KOEBE_API FitResult fit_circles(const Vertices& vertices, const Triangles& triangles, const CircleTemplate& wanted,
                                const FitOptions& options, ExecutionContext& context);

}  // namespace koebe
