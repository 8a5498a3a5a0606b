// A surface with handles in the plane, the two sides of each handle's cut Moebius maps apart: Schottky uniformization.
#pragma once

#include "circles/circle_fit.h"
#include "core/api.h"
#include "core/map_options.h"
#include "core/warning.h"
#include "execution/execution.h"
#include "quality/report.h"
#include "schottky/linear_fractional.h"

#include <array>
#include <vector>

namespace koebe {

/// Which of the maps that automorphisms of the disk lead to each other, where there are holes.
enum class SchottkyNormalization {
    area,     ///< that of the least area distortion
    circles,  ///< the nearest one where equally large circles of each handle are apart, if there is such
};

/// As in the JSON report: the enumerator's name.
KOEBE_API const char* to_string(SchottkyNormalization normalization) noexcept;

/// The tolerance is on the relative change, in a sweep, of the matrices of the disks that fill the loops.
struct SchottkyOptions : SweepOptions {
    SchottkyNormalization normalization = SchottkyNormalization::area;
    std::vector<Index> polygon = {};  ///< (F) faces of one number are not cut apart; empty: each is one by itself

    template <typename Visit>
    static void each_option(Visit&& visit)
    {
        visit("normalization", &SchottkyOptions::normalization);
        SweepOptions::each_option(visit);
        visit("polygon", &SchottkyOptions::polygon);
    }
};

/// A handle: all in the plane of the unit disk, z = 2 (u + i v) - 1 - i.
struct SchottkyHandle {
    std::vector<Index> cut;         ///< the input's vertices on the loop that it was cut along, in its order
    LinearFractional generator;     ///< continues the pattern: from one circle, and side of the cut, to the other
    std::array<Circle, 2> circles;  ///< paired by the generator, the outside of the first with the inside of the second
    bool outer = false;             ///< the inside of the first with the outside of the second
    double misfit = 0.0;            ///< of the sides of the cut before they were made to fit, over their radius
};

/// A hole of the surface.
struct SchottkyHole {
    VertexLoop vertices;  ///< in order, the surface on the left
    Circle circle;        ///< where the UVs have it; of one that the cut of the UVs tears, where the map has it
    Roundness roundness;  ///< of the image before it was put on its circle
    std::vector<Index> off_circle;  ///< vertices that are not on the circle, rising
};

/// Its UVs lie in [0, 1]^2.
struct SchottkyResult : CornerMapReport {
    std::vector<SchottkyHole> holes;      ///< by falling length, the first on the unit circle
    std::vector<SchottkyHandle> handles;  ///< by falling length of their cuts
    bool by_circles = false;  ///< the UVs are cut along the pairs of circles, as exactly as faces can be; else along
                              ///< the edges of the cuts, as the circles meet each other or a hole
    int sweeps = 0;
    std::vector<double> changes;  ///< in each sweep
};

/// Maps a surface of genus 1 and more, with any number of holes, conformally to a fundamental domain of a Schottky
/// group, its holes round: the copies of the UVs under the group fill the plane up to a set of no area, continuing the
/// pattern. Handles are cut along short loops, which decide on the group; their sides differ by its generators
/// [Koebe 1908; Maskit 1988, chapter X.H]. With holes the longest is the unit circle, and the map the one of its
/// automorphisms with the least area distortion, or near it one with room for equal circles. Without holes one handle's
/// generator is z -> lambda z: that for which texel density is most even.
/// @throws InputError, TopologyError genus (no handle, or cuts that touch each other) and those of analyze_surface,
/// SolverError, Cancelled; what is not one to one is reported as not converged
KOEBE_API SchottkyResult schottky_map(const Vertices& vertices, const Triangles& triangles,
                                      const SchottkyOptions& options, ExecutionContext& context);

}  // namespace koebe
