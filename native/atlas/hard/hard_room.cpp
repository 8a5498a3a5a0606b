#include "hard/hard_room.h"

#include "core/connectivity.h"
#include "core/numbering.h"
#include "cost/costs.h"
#include "cost/tolerances.h"
#include "cut/disjoint_sets.h"
#include "darts/dart_rounds.h"
#include "darts/through_rounds.h"
#include "packing/packing.h"
#include "surface/face_vectors.h"

#include <cmath>
#include <cstddef>
#include <utility>

namespace koebe {
namespace {

constexpr std::size_t fewest_parts = 4;  // fewer, such as the cross of a box, stay unless cuts bring much
constexpr double usual_margin = 0.004;   // of the square, with which islands are compared

}  // namespace

std::vector<FlatPart> cut_between_planes(const CutSurface& surface, const FlatCharts& charts,
                                         const std::vector<FlatPart>& parts, ExecutionContext& context)
{
    // Faces of a region, or of a polygon, are not cut apart.
    const auto normal = [&](Index f) {
        return twice_area_vector(surface.vertices, surface.surface.triangles, f).stableNormalized().eval();
    };
    DisjointSets uncut(static_cast<std::size_t>(surface.areas.size()));
    for (Index h = 0; h < charts.net.halfedge_count(); ++h)
        if (const Index t = charts.net.twin[h];
            t != no_twin && (charts.net.whole[h] || charts.region[face_of(h)] == charts.region[face_of(t)] ||
                             normal(face_of(h)).dot(normal(face_of(t))) > tolerance::straight))
            uncut.join(face_of(h), face_of(t));
    std::vector<HeldPart> held;
    for (const FlatPart& part : parts) {
        FlatPart& own = held.emplace_back(HeldPart{part, {}}).flat;
        own.polygon.clear();
        for (const Index f : part.faces) own.polygon.push_back(uncut.find(f));
    }

    // The pieces have the polygons of the surface again.
    std::vector<FlatPart> pieces;
    if (!cut_parts_for_room(held, hard_room_price, 1, context)) return pieces;
    for (HeldPart& part : held) {
        FlatPart& piece = pieces.emplace_back(std::move(part.flat));
        piece.polygon = values_at(surface.polygon, piece.faces);
    }
    return pieces;
}

bool are_worth_their_number(const std::vector<FlatPart>& roomier, const std::vector<FlatPart>& parts)
{
    if (roomier.size() <= parts.size()) return false;
    const double count = static_cast<double>(roomier.size()) / static_cast<double>(parts.size());
    const double larger = quickly_packed_scale(roomier) / quickly_packed_scale(parts);
    return larger > (parts.size() < fewest_parts ? tuning::worth_apart : std::pow(count, tuning::larger_by_count));
}

double quickly_packed_scale(const std::vector<FlatPart>& parts)
{
    std::vector<Outline> outlines;
    for (const FlatPart& part : parts) outlines.push_back({part.points, part.surface.loops});
    return pack_around(outlines, usual_margin, {}).scale;
}

}  // namespace koebe
