#include "flat/straight_middles.h"

#include "planar/boundary_crossings.h"
#include "planar/planar_predicates.h"

#include <algorithm>
#include <map>
#include <set>
#include <utility>

namespace koebe {
namespace {

constexpr int most_passes = 100;         // one edge's middle may be another one's end
constexpr double still_straight = 1e-9;  // in roots of the surface's area

/// A divided edge, by the vertices of a part.
struct PlacedEdge {
    const DividedEdge* edge;
    Index from, to, middle;
};

/// Moves the middles of a part's divided edges. @return the edges that cannot be straight
std::vector<const DividedEdge*> edges_not_straight(const std::vector<PlacedEdge>& edges, FlatPart& part)
{
    PlanarPoints& points = part.points;
    const PlanarPoints before = points;
    const auto off = [&](const PlacedEdge& own) -> Eigen::RowVector2d {
        return (1.0 - own.edge->share) * points.row(own.from) + own.edge->share * points.row(own.to) -
               points.row(own.middle);
    };
    double most = 1.0;
    for (int pass = 0; pass < most_passes && most > 0.1 * still_straight; ++pass) {
        most = 0.0;
        for (const PlacedEdge& own : edges) {
            const Eigen::RowVector2d step = off(own);
            points.row(own.middle) += step;
            most = std::max(most, step.norm());
        }
    }
    // No face may turn over for it, and the outline must not cross itself.
    std::set<Index> stuck;
    for (Eigen::Index f = 0; f < part.surface.triangles.rows(); ++f)
        if (!(signed_area(points, part.surface.triangles, f) > 0.0) &&
            signed_area(before, part.surface.triangles, f) > 0.0)
            for (const Index v : part.surface.triangles.row(f)) stuck.insert(v);
    if (loops_cross(part.surface.loops, points, 0.0) && !loops_cross(part.surface.loops, before, 0.0))
        for (const VertexLoop& loop : part.surface.loops) stuck.insert(loop.begin(), loop.end());
    std::vector<const DividedEdge*> bent;
    for (const PlacedEdge& own : edges)
        if (!(off(own).norm() < still_straight) ||
            (stuck.contains(own.middle) && points.row(own.middle) != before.row(own.middle)))
            bent.push_back(own.edge);
    return bent;
}

}  // namespace

std::vector<std::array<Index, 2>>
lay_middles_straight(const DividedFaces& faces, const std::vector<LeftOutFace>& left_out, std::vector<FlatPart>& parts)
{
    // The part of each piece, and the vertices of divided faces.
    std::vector<Index> part(faces.face.size(), -1);
    std::map<std::pair<Index, Index>, Index> vertex;  // of a face, by that of the input
    std::set<Index> divided, torn;
    for (const DividedEdge& edge : faces.edges) divided.insert(edge.face);
    for (std::size_t k = 0; k < parts.size(); ++k)
        for (std::size_t i = 0; i < parts[k].faces.size(); ++i) {
            const Index f = parts[k].faces[i], face = faces.face[f];
            part[f] = static_cast<Index>(k);
            if (divided.contains(face))
                for (const Index v : parts[k].surface.triangles.row(static_cast<Eigen::Index>(i)))
                    vertex[{face, parts[k].original[v]}] = v;
        }
    for (std::size_t f = 0; f < part.size(); ++f)
        if (part[f] != part[faces.face[f]]) torn.insert(faces.face[f]);
    for (const LeftOutFace& own : left_out)
        for (const Index f : {own.face, own.like})
            if (f >= 0) torn.insert(faces.face[f]);
    // The edges of each part.
    std::vector<std::array<Index, 2>> kept;
    std::map<Index, std::vector<PlacedEdge>> edges;
    for (const DividedEdge& edge : faces.edges) {
        const auto at = [&](Index v) { return vertex.at({edge.face, v}); };
        if (torn.contains(edge.face))
            kept.push_back({edge.from, edge.to});
        else if (part[edge.face] >= 0)
            edges[part[edge.face]].push_back({&edge, at(edge.from), at(edge.to), at(edge.middle)});
    }
    for (const auto& [k, own] : edges)
        for (const DividedEdge* const edge : edges_not_straight(own, parts[k])) kept.push_back({edge->from, edge->to});
    return kept;
}

}  // namespace koebe
