#include "parts/rigid_faces.h"

#include "core/numbering.h"
#include "execution/side_by_side.h"
#include "foldover/convex_polygons.h"
#include "opened/disk_packing.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace koebe {
namespace {

constexpr double rigid_edge = 1e-5;  // in roots of the area: edges of rigid faces keep their length up to this,
constexpr double most_rigid = 1e-3;  // and up to this share of it

/// (V) 1 for vertices of faces that lie true to size, as flat and rolled regions do.
std::vector<char> at_rigid_faces(const FlatPart& part, double noise)
{
    std::vector<char> rigid(part.original.size(), 0);
    for (const auto& face : part.surface.triangles.rowwise()) {
        const auto is_rigid = [&](int k) {
            const Index a = face[k], b = face[(k + 1) % 3];
            const double length = (part.vertices.row(a) - part.vertices.row(b)).norm();
            return std::abs((part.points.row(a) - part.points.row(b)).norm() - length) <=
                   std::min(std::max(rigid_edge, 2.0 * noise), most_rigid * length);
        };
        if (is_rigid(0) && is_rigid(1) && is_rigid(2)) rigid[face[0]] = rigid[face[1]] = rigid[face[2]] = 1;
    }
    return rigid;
}

}  // namespace

std::vector<Index> rigid_vertices(const FlatMesh& mesh)
{
    std::vector<Index> vertices;
    if (mesh.polygon.empty()) return vertices;
    for (const FlatPart& part : mesh.parts) {
        const std::vector<char> rigid = at_rigid_faces(part, mesh.layout.noise);
        for (std::size_t v = 0; v < rigid.size(); ++v)
            if (rigid[v] != 0) vertices.push_back(part.original[v]);
    }
    return vertices;
}

void mend_rims(FlatMesh& mesh, int threads, ExecutionContext& context)
{
    if (mesh.polygon.empty()) return;
    std::vector<char> straight(static_cast<std::size_t>(mesh.layout.vertices.rows()), 0);
    for (const DividedEdge& edge : mesh.divided.edges)
        straight[edge.from] = straight[edge.to] = straight[edge.middle] = 1;
    side_by_side(mesh.parts.size(), threads, context, [&](std::size_t k, ExecutionContext& own) {
        FlatPart& part = mesh.parts[k];
        if (!part.one_to_one) return;
        const std::vector<Index> polygons = values_at(mesh.polygon, part.faces), none_turned;
        SurfacePolygons surface{part.vertices, part.surface.triangles, polygons, none_turned};
        surface.free_rims = true;
        const std::vector<char> rigid = at_rigid_faces(part, mesh.layout.noise);
        for (std::size_t v = 0; v < part.held.size(); ++v)
            if (part.held[v] != 0 || straight[part.original[v]] != 0 || rigid[v] != 0)
                surface.held.push_back(static_cast<Index>(v));
        PlanarPoints moved = part.points;
        if (mend_disk_polygons(surface, moved, own) && lies_one_to_one(part, moved)) part.points = std::move(moved);
    });
}

}  // namespace koebe
