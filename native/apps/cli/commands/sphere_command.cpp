// koebe sphere IN OUT
#include "cli/commands/corner_map.h"

#include "core/counted.h"
#include "report/sphere_json.h"
#include "report/sphere_svg.h"
#include "sphere/sphere_map.h"

#include <utility>

namespace koebe::cli {
namespace {

PolygonMesh on_unit_sphere(const MeshInput& input, const SphereResult& result)
{
    PolygonMesh mesh = input.polygons;
    mesh.vertices = result.points;
    return mesh;
}

int run_sphere(const CornerMapRequest<SphereOptions>& request)
{
    auto kind = corner_map_kind<SphereResult, SphereOptions>(request, request.chosen, sphere_map);
    kind.compute = [compute = kind.compute](const MeshInput& input, ExecutionContext& context) {
        SphereResult result = compute(input, context);
        input.give_to_joined(result.points);
        for (auto faces : {&SphereLayoutReport::crossing, &SphereLayoutReport::moved, &SphereLayoutReport::torn,
                           &SphereLayoutReport::flipped, &SphereLayoutReport::below_resolution})
            result.layout.*faces = filed_faces(input.triangulation, result.layout.*faces);
        return result;
    };
    kind.write_sphere = [&](AtomicFile& file, const MeshInput& input, const SphereResult& result) {
        return write_with_corner_uvs(file, *required_format(request.sphere), on_unit_sphere(input, result),
                                     polygon_corner_uvs(input.mapped_polygons(), input.triangulation, result.uv),
                                     {input.file, true});
    };
    kind.draw = [](const MeshInput& input, const SphereResult& result) {
        return sphere_svg(input.triangulation.triangles, result);
    };
    kind.first_words = [](const SphereResult& result) {
        return counted(result.loops.size(), "loop") + ", " + counted(static_cast<std::size_t>(result.sweeps), "sweep");
    };
    return run_map_of(request, kind);
}

}  // namespace

Subcommand add_sphere(CLI::App& app)
{
    return add_corner_map<SphereOptions>(app,
                                         {.name = "sphere",
                                          .does = "map a surface without handles to the sphere, its holes round",
                                          .surface = "surface of genus 0, closed or with holes",
                                          .picture = "write a picture of the sphere there, front and back",
                                          .uvs = "texture coordinates of corners",
                                          .has_sphere = true},
                                         run_sphere);
}

}  // namespace koebe::cli
