#include "flatten/less_stretch.h"

#include "core/errors.h"
#include "even/even_map.h"
#include "flatten/stretch.h"
#include "flow/flat_layout.h"

namespace koebe {
namespace {

constexpr int most_relaxations = 12;         // of further relaxation,
constexpr double worth_a_relaxation = 0.97;  // of the stretch
constexpr double negligible = 1e-9;          // stretch

PlanarPoints laid_face_by_face(const FlatPart& part)
{
    const Triangles& triangles = part.surface.triangles;
    const EdgeLengths lengths = edge_lengths(part.vertices, triangles);
    const VectorXcd z = positions_from_edges(triangles, lengths, unfolded_edges(triangles, lengths, part.surface.twin),
                                             part.surface.vertex_count);
    PlanarPoints points(z.size(), 2);
    points << z.real(), z.imag();
    return points;
}

}  // namespace

void stretch_less(FlatPart& part, ExecutionContext& context)
{
    double before = mean_stretch(part);
    FlatPart other = part;
    try {
        other.points = laid_face_by_face(part);
    } catch (const SolverError&) {  // faces without area
        other.points.setZero();
    }
    if (lies_one_to_one(other, other.points))
        if (const double now = mean_stretch(other); now < before) {
            part = std::move(other);
            before = now;
        }
    std::vector<RoundLoop> none;
    for (int round = 0; round < most_relaxations && before > negligible; ++round) {
        make_even({part.vertices, part.surface.triangles, part.surface.loops, part.points, none}, 1.0, packed_side,
                  context);
        const double now = mean_stretch(part);
        if (!(now < worth_a_relaxation * before)) return;
        before = now;
    }
}

}  // namespace koebe
