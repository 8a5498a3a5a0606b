#include "pipeline/convex_disk.h"

#include "canonical/canonical_mesh.h"
#include "foldover/convex_polygons.h"
#include "quality/distortion.h"

#include <utility>

namespace koebe {
namespace {

/// Mends in canonical numbers, so that the map follows from the shape alone.
bool mend_canonical(const SurfacePolygons& given, PlanarPoints& points, const ExecutionContext& context)
{
    const CanonicalMesh mesh = canonical_mesh(given.vertices, given.triangles);
    const std::vector<Index> polygon = mesh.of_faces(given.polygon);
    std::vector<char> is_turned(static_cast<std::size_t>(given.triangles.rows()), 0);
    for (const Index f : given.turned) is_turned[static_cast<std::size_t>(f)] = 1;
    std::vector<Index> turned, held;
    for (std::size_t f = 0; f < mesh.original_faces.size(); ++f)
        if (is_turned[static_cast<std::size_t>(mesh.original_faces[f])] != 0) turned.push_back(static_cast<Index>(f));
    for (const Index v : given.held) held.push_back(mesh.vertex(v));
    PlanarPoints own = points(mesh.original_vertices, Eigen::all);
    if (!mend_disk_polygons({mesh.vertices, mesh.triangles, polygon, turned, held}, own, context)) return false;
    points(mesh.original_vertices, Eigen::all) = own;
    return true;
}

/// The triangles in the orientation of the map.
Triangles oriented(Triangles triangles, const std::vector<Index>& turned)
{
    for (const Index f : turned) std::swap(triangles(f, 1), triangles(f, 2));
    return triangles;
}

}  // namespace

void make_polygons_convex(const Vertices& vertices, const Triangles& triangles, const std::vector<Index>& polygon,
                          UniformizeResult& result, const ExecutionContext& context, bool mend)
{
    if (polygon.empty()) return;
    std::vector<Index> turned, held;
    for (const Warning& warning : result.warnings)
        if (warning.kind == WarningKind::reoriented_faces) turned = warning.elements;
    for (const Index v : {result.center, result.point})
        if (v >= 0) held.push_back(v);
    const SurfacePolygons surface{vertices, triangles, polygon, turned, held};
    if (concave_polygons(surface, disk_corner_uvs(triangles, result.uv)).empty()) return;
    if (mend && mend_canonical(surface, result.uv, context))
        result.distortion = {measure_distortion(vertices, oriented(triangles, turned), result.uv),
                             judge_disk(vertices, triangles, result.uv, turned)};
    warn_concave_polygons(surface, disk_corner_uvs(triangles, result.uv), result.warnings);
}

}  // namespace koebe
