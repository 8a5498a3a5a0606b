// Maps a surface of genus 0 to the unit sphere, with round caps as holes.
#pragma once

#include "circles/mapped_loop.h"
#include "core/api.h"
#include "core/map_options.h"
#include "core/warning.h"
#include "execution/execution.h"
#include "quality/report.h"
#include "sphere/spherical_points.h"

#include <vector>

namespace koebe {

/// The layout of the sphere in UVs.
enum class SphereLayout {
    equirectangular,  ///< u the longitude from -pi to pi, v the latitude from -pi/2 to pi/2
    octahedral,       ///< the octahedron's upper half as the middle of a square, its lower faces folded out
};

/// The enumerator's name, as in the JSON report.
KOEBE_API const char* to_string(SphereLayout layout) noexcept;

/// For a closed surface the tolerance is on the change of the points.
struct SphereOptions : CutDomainOptions {
    SphereLayout layout = SphereLayout::equirectangular;
    double even = 0.0;  ///< 0: conformal, 1: true to size (even/even_map.h)
    int threads = 0;    ///< at most; 0: all cores. The result is the same for any number
};

/// A loop on the sphere. Its roundness is measured in the disk.
struct SphereLoop : MappedLoop {
    Cap cap;  ///< the hole
};

/// Faces with special UVs, ascending.
struct SphereLayoutReport {
    SphereLayout kind = SphereLayout::equirectangular;
    std::vector<Index> crossing;  ///< with corners beyond the layout's edge, where the pattern continues
    std::vector<Index> moved;     ///< with corners that have other UVs than their points, so that no face is flipped
    std::vector<Index> torn;      ///< their UVs do not fit all their neighbours
    std::vector<Index> flipped;   ///< without positive area as 32-bit floats
    std::vector<Index> below_resolution;  ///< flipped faces whose longest edge is under uv_resolution
};

/// angle_error_deg and similar measures are of flat faces between the corners on the sphere. The verdict, with flipped
/// and below_resolution, is on the UVs. With holes the changes are those of each step.
struct SphereResult : SweptMapReport {
    Vertices points;                ///< (V, 3) unit vectors in the input's order; unused vertices at (0, 0, 1)
    std::vector<SphereLoop> loops;  ///< by falling length
    /// Length of the area-weighted mean of the points: 0 except for moves after the balance, and for `even`.
    double mean_point = 0.0;
    /// Faces that are not upright on the sphere in exact arithmetic; among them those whose longest edge is under
    /// sphere_resolution.
    std::vector<Index> flipped_on_sphere, below_sphere_resolution;
    SphereLayoutReport layout;
};

/// Maps a surface of genus 0, closed or with any number of holes, conformally to the unit sphere, with round caps as
/// holes. Seen from outside the sphere, faces are counter-clockwise as on the surface. Moebius maps of the ball lead to
/// many such maps; this is the balanced one (spherical_balance.h), rotated so that its points are as near as possible
/// to their directions from the surface's middle.
///
/// A closed surface is mapped by closed_sphere.h. A surface with holes is mapped by uniformize and stereographic
/// projection; the outer circle becomes a cap like the others. `even` then moves the vertices that are on no loop.
/// @throws InputError, TopologyError genus and the errors of analyze_surface, SolverError, Cancelled; a map that is not
/// one to one is reported as not converged
KOEBE_API SphereResult sphere_map(const Vertices& vertices, const Triangles& triangles, const SphereOptions& options,
                                  ExecutionContext& context);

}  // namespace koebe
