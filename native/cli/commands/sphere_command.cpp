// koebe sphere IN OUT
#include "cli/commands/corner_map.h"
#include "cli/commands/subcommand.h"
#include "cli/options/option_table.h"
#include "cli/process/end_with_input.h"

#include "core/counted.h"
#include "report/sphere_json.h"
#include "report/sphere_svg.h"
#include "sphere/sphere_map.h"

#include <memory>
#include <string>
#include <utility>

namespace koebe::cli {
namespace {

struct SphereRequest : MapRequest {
    SphereOptions sphere_options;
    bool ends_with_input = false;
};

PolygonMesh on_unit_sphere(const MeshInput& input, const SphereResult& result)
{
    PolygonMesh mesh = input.polygons;
    mesh.vertices = result.points;
    return mesh;
}

int run_sphere(const SphereRequest& request)
{
    if (request.ends_with_input) end_with_input();
    auto kind = corner_map_kind<SphereResult, SphereOptions>(request, request.sphere_options, sphere_map);
    kind.compute = [compute = kind.compute](const MeshInput& input, ExecutionContext& context) {
        SphereResult result = compute(input, context);
        for (auto faces : {&SphereLayoutReport::crossing, &SphereLayoutReport::torn, &SphereLayoutReport::flipped,
                           &SphereLayoutReport::below_resolution})
            result.layout.*faces = filed_faces(input.triangulation, result.layout.*faces);
        return result;
    };
    kind.write_sphere = [&](AtomicFile& file, const MeshInput& input, const SphereResult& result) {
        return write_with_corner_uvs(file, required_format(request.sphere), on_unit_sphere(input, result),
                                     polygon_corner_uvs(input.polygons, input.triangulation, result.uv),
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
    auto request = std::make_shared<SphereRequest>();
    CLI::App* options = app.add_subcommand("sphere", "map a surface without handles to the sphere, its holes round");
    add_mesh_arguments(*options, *request, "surface of genus 0, closed or with holes",
                       "texture coordinates of corners");
    add_options(*options, "sphere", request->sphere_options);
    options
        ->add_option("--sphere", request->sphere,
                     "write the sphere itself there, OBJ or PLY: the same faces, their vertices on the unit sphere")
        ->type_name("FILE");
    add_report_options(*options, *request, "write a picture of the sphere there, front and back");
    options->add_flag(end_with_input_flag, request->ends_with_input)->group("");
    options->callback([request] {
        check_map_files(*request);
        if (!request->sphere.empty()) required_format(request->sphere);
        request->entries["options"] = option_report("sphere", request->sphere_options);
    });
    return {options, [request] { return run_sphere(*request); }};
}

}  // namespace koebe::cli
