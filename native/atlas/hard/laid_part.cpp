#include "hard/laid_part.h"

#include "core/connectivity.h"
#include "core/errors.h"
#include "core/numbering.h"
#include "darts/dart_rounds.h"
#include "darts/darts.h"
#include "flat/flat_repair.h"
#include "planar/boundary_crossings.h"
#include "surface/loop_edges.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

namespace koebe {
namespace {

constexpr std::size_t longest_crack = 100;  // vertices round a crack between faces that meet in T-junctions
constexpr double narrow_gap = 1e-3;         // where a chart touches itself, over the least height of a face there

/// Whether a loop encloses nothing, where faces meet in T-junctions.
bool is_crack(const FlatPart& part, const VertexLoop& loop, double near)
{
    const double length = loop_edges(part.vertices, loop).sum();
    return loop.size() <= longest_crack && std::abs(enclosed_area(loop, part.points)) < near * length;
}

/// Whether a vertex of a loop lies on an edge of it elsewhere: a face has it, and the face beside it has not.
bool lies_on_edge(const FlatPart& part, const VertexLoop& loop, Index v, double near)
{
    for (std::size_t i = 0; i < loop.size(); ++i) {
        const Index a = loop[i], b = loop[(i + 1) % loop.size()];
        if (a == v || b == v) continue;
        const Eigen::RowVector2d edge = part.points.row(b) - part.points.row(a),
                                 arm = part.points.row(v) - part.points.row(a);
        const double along = arm.dot(edge), square = edge.squaredNorm();
        if (along > 0.0 && along < square && (arm - along / square * edge).norm() < near) return true;
    }
    return false;
}

/// (V) 1 for boundary vertices where the surface touches itself: holes may meet at a point, and cracks have no width.
/// The two sides of a cut are one vertex of the surface. They stay if they lie in two places.
std::vector<char> touching(const FlatPart& part, double near)
{
    std::map<std::array<double, 3>, Index> first;
    std::vector<char> touches(static_cast<std::size_t>(part.surface.vertex_count), 0);
    for (const VertexLoop& loop : part.surface.loops) {
        const bool crack = is_crack(part, loop, near);
        for (const Index v : loop) {
            const auto found =
                first.try_emplace({part.vertices(v, 0), part.vertices(v, 1), part.vertices(v, 2)}, v).first;
            const Index other = found->second;
            if (other != v && (part.original[v] != part.original[other] ||
                               (part.points.row(v) - part.points.row(other)).norm() < near))
                touches[v] = touches[other] = 1;
            if (crack && lies_on_edge(part, loop, v, near)) touches[v] = 1;
        }
    }
    return touches;
}

}  // namespace

std::optional<FlatPart> laid_part(const CutSurface& surface, const FlatCharts& charts, const std::vector<Index>& faces)
{
    const auto number = [&](Index f) { return static_cast<Index>(std::ranges::lower_bound(faces, f) - faces.begin()); };
    SeamedMesh mesh;
    mesh.corners = charts.net.corners(faces, Eigen::all);
    for (const Index f : faces)
        for (Index h = 3 * f; h < 3 * f + 3; ++h) {
            const Index t = charts.net.twin[h];
            mesh.twin.push_back(t == no_twin ? no_twin : 3 * number(face_of(t)) + t % 3);
        }
    number_fans(mesh);
    FlatPart part;
    part.faces = faces;
    part.original.resize(mesh.fan_count);
    part.points.resize(mesh.fan_count, 2);
    // Up to tolerances corners of one vertex lie in one place. The largest plane stays exact.
    std::vector<double> plane(static_cast<std::size_t>(mesh.fan_count), -1.0);
    for (Index h = 0; h < mesh.halfedge_count(); ++h) {
        const Index v = origin(mesh.fans, h), f = faces[face_of(h)];
        if (!(charts.plane[f] > plane[v])) continue;
        const Complex z = charts.at[3 * f + h % 3];
        plane[v] = charts.plane[f];
        part.original[v] = origin(mesh.corners, h);
        part.points.row(v) << z.real(), z.imag();
    }
    part.vertices = surface.vertices(part.original, Eigen::all);
    try {
        part.surface = require_bordered_genus_zero(mesh.fans, mesh.fan_count);
    } catch (const TopologyError&) {  // two islands that close a ring meet in one vertex
        return {};
    }
    if (!lies_one_to_one(part, part.points)) {
        if (charts.noise > 0.0)
            mend_noise(part, charts.noise);
        else
            raise_slivers(part);
    }
    if (!lies_one_to_one(part, part.points) && !draw_apart(part, touching(part, charts.near), narrow_gap)) return {};
    if (!survives_storing(part)) return {};
    part.rims.assign(part.surface.loops.begin(), part.surface.loops.end());
    part.held.assign(mesh.fan_count, 0);
    for (const VertexLoop& loop : part.surface.loops) part.loops.push_back(values_at(part.original, loop));
    for (Index v = 0; v < mesh.fan_count; ++v)
        if (charts.tips.contains(part.original[v]) && std::ranges::count(part.original, part.original[v]) == 1)
            part.tips.push_back(v);
    part.polygon = values_at(surface.polygon, faces);
    return part;
}

}  // namespace koebe
