// Schottky uniformization: a surface with handles in the plane; Moebius maps take one side of each cut to the other.
#pragma once

#include "circles/mapped_loop.h"
#include "core/api.h"
#include "core/map_options.h"
#include "core/warning.h"
#include "execution/execution.h"
#include "quality/report.h"
#include "schottky/linear_fractional.h"

#include <array>
#include <vector>

namespace koebe {

/// Which of the maps to take that differ by automorphisms of the disk, for a surface with holes.
enum class SchottkyNormalization {
    area,     ///< the one of least area distortion
    circles,  ///< the nearest one where equally large circles of each handle are apart, if any
};

/// The tolerance is on the relative change, in a sweep, of the matrices of the disks that fill the loops.
struct SchottkyOptions : CutDomainOptions {
    SchottkyNormalization normalization = SchottkyNormalization::area;
};

/// A handle, in the plane of the unit disk, z = 2 (u + i v) - 1 - i.
struct SchottkyHandle {
    std::vector<Index> cut;         ///< the input's vertices on the loop along which it was cut, in order
    LinearFractional generator;     ///< continues the pattern: takes one circle, and side of the cut, to the other
    std::array<Circle, 2> circles;  ///< the generator takes the outside of the first to the inside of the second
    bool outer = false;             ///< the generator takes the inside of the first to the outside of the second
    double misfit = 0.0;            ///< of the cut's sides before they were fitted, over their radius
};

/// A hole of the surface.
struct SchottkyHole : MappedLoop {
    Circle circle;  ///< in the UVs; in the map if the cut of the UVs tears it
};

/// The UVs lie in [0, 1]^2.
struct SchottkyResult : SweptMapReport {
    std::vector<SchottkyHole> holes;      ///< by falling length, the first on the unit circle
    std::vector<SchottkyHandle> handles;  ///< by falling length of their cuts
    bool by_circles = false;  ///< the UVs are cut along the pairs of circles, as closely as faces allow; else along the
                              ///< edges of the cuts, as the circles meet each other or a hole
};

/// Maps a surface of genus at least 1 with any number of holes conformally to a fundamental domain of a Schottky group,
/// with round holes. Copies of the UVs under the group continue the pattern and fill the plane up to a set of no area.
/// Handles are cut along short loops, which determine the group; generators take one side of a cut to the other [Koebe
/// 1908; Maskit 1988, chapter X.H]. With holes the longest loop is the unit circle. Automorphisms of the disk give many
/// such maps. The map of least area distortion is taken, or a map near it with room for equal circles. Without holes
/// one handle's generator is z -> lambda z; it is the handle that makes texel density most even.
/// @throws InputError, TopologyError genus (no handle, or cuts that touch each other) and the errors of
/// analyze_surface, SolverError, Cancelled; a map that is not one to one is reported as not converged
KOEBE_API SchottkyResult schottky_map(const Vertices& vertices, const Triangles& triangles,
                                      const SchottkyOptions& options, ExecutionContext& context);

}  // namespace koebe
