// A surface of genus 0 on the unit sphere, its holes round caps.
#pragma once

#include "circles/circle_fit.h"
#include "core/api.h"
#include "core/map_options.h"
#include "core/warning.h"
#include "execution/execution.h"
#include "quality/report.h"
#include "sphere/spherical_points.h"

#include <vector>

namespace koebe {

/// How the sphere becomes UVs.
enum class SphereLayout {
    equirectangular,  ///< u the longitude from -pi to pi, v the latitude from -pi/2 to pi/2
    octahedral,       ///< the octahedron's upper half as the middle of a square, its lower faces folded out
};

/// As in the JSON report: the enumerator's name.
KOEBE_API const char* to_string(SphereLayout layout) noexcept;

/// Of a closed surface the tolerance is on the points' change.
struct SphereOptions : SweepOptions {
    SphereLayout layout = SphereLayout::equirectangular;
    std::vector<Index> polygon = {};  ///< (F) faces of one number are not cut apart; empty: each is one by itself

    template <typename Visit>
    static void each_option(Visit&& visit)
    {
        visit("layout", &SphereOptions::layout);
        SweepOptions::each_option(visit);
        visit("polygon", &SphereOptions::polygon);
    }
};

/// A loop on the sphere.
struct SphereLoop {
    VertexLoop vertices;            ///< in order, the surface on the left
    Cap cap;                        ///< the hole
    Roundness roundness;            ///< of the image in the disk before it was put on its circle
    std::vector<Index> off_circle;  ///< vertices that are not on the cap's circle, rising
};

/// What there is to know of the UVs: faces all.
struct SphereLayoutReport {
    SphereLayout kind = SphereLayout::equirectangular;
    std::vector<Index> crossing;  ///< with corners beyond the layout's edge, where the pattern continues
    /// Round a pole of the longitudes, or round the middle of a side of the square: no UVs fit to all their neighbours.
    std::vector<Index> torn;
    std::vector<Index> flipped;           ///< of no positive area as 32-bit floats
    std::vector<Index> below_resolution;  ///< those of them whose longest edge is under uv_resolution
};

/// angle_error_deg and the like are of the flat faces between their corners on the sphere; the verdict, with what is
/// flipped and below resolution, is on the UVs.
struct SphereResult : CornerMapReport {
    Vertices points;                ///< (V, 3) unit vectors in the input's order; vertices of no face are at (0, 0, 1)
    std::vector<SphereLoop> loops;  ///< by falling length
    double mean_point =
        0.0;  ///< length of the mean of the surface's points, by area: 0 but for what was moved after the balance
    int sweeps = 0;
    std::vector<double> changes;  ///< in each sweep, with holes in each of its steps
    /// Faces that are not upright on the sphere in exact arithmetic, and those of them whose longest edge there is
    /// under sphere_resolution.
    std::vector<Index> flipped_on_sphere, below_sphere_resolution;
    SphereLayoutReport layout;
};

/// Maps a surface of genus 0, closed or with any number of holes, conformally to the unit sphere, its holes round caps.
/// Seen from outside the sphere the faces are counter-clockwise as on the surface. Of all such maps, which Moebius maps
/// of the ball lead to each other, this is the one of spherical_balance.h, turned as the surface is: of all rotations
/// the one that brings the points nearest to their directions from the surface's middle.
///
/// Closed: closed_sphere.h. With holes: uniformize, and the stereographic projection; the outer circle becomes a cap
/// like the others.
/// @throws InputError, TopologyError genus and those of analyze_surface, SolverError, Cancelled; what is not one to one
/// is reported as not converged
KOEBE_API SphereResult sphere_map(const Vertices& vertices, const Triangles& triangles, const SphereOptions& options,
                                  ExecutionContext& context);

}  // namespace koebe
