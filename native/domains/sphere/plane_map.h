// Maps a surface of genus 0 to the plane and the point at infinity.
#pragma once

#include "circles/circle_fit.h"
#include "core/warning.h"
#include "ears/ears.h"
#include "execution/execution.h"
#include "quality/report.h"
#include "sphere/sphere_map.h"
#include "surface/periodic_surface.h"

#include <cstddef>
#include <vector>

namespace koebe {

/// A map to the plane and the point at infinity, and its data.
struct PlaneMap {
    VectorXcd z;                       ///< (V) of the domain's vertices
    std::vector<Circle> circles;       ///< of the domain's loops; the outer circle stands for its outside
    std::vector<Roundness> roundness;  ///< of the loops
    std::vector<Index> off_circle;     ///< of the domain, ascending
    std::size_t outer = 0;             ///< number of the outer loop
    std::vector<Ear> ears;             ///< ears on the outer loop
    bool converged = false;
    int sweeps = 0;
    std::vector<double> changes;
    StageSeconds seconds;
    std::vector<Warning> warnings;  ///< with the input's vertices and the domain's loops
};

/// The conformal map of a surface, closed (closed_sphere.h) or with holes (uniformize).
/// @param vertices, triangles of the input @param domain of its faces @param weights (V) area around each vertex
/// @throws the errors of sphere_map
PlaneMap plane_map(const Vertices& vertices, const Triangles& triangles, const PeriodicSurface& domain,
                   const VectorXd& weights, const SphereOptions& options, ExecutionContext& context);

}  // namespace koebe
