// koebe sphere IN OUT
#include "cli/end_with_input.h"
#include "cli/map_run.h"
#include "cli/option_table.h"
#include "cli/subcommand.h"

#include "core/counted.h"
#include "domains/sphere_map.h"
#include "io/corner_uvs.h"
#include "report/sphere_json.h"
#include "report/sphere_svg.h"

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

std::vector<Warning> write_sphere_mesh(AtomicFile& file, WrittenFormat format, const PolygonMesh& mesh,
                                       const MeshInput& input, const SphereResult& result, bool moved)
{
    const PlanarPoints uvs = polygon_corner_uvs(input.polygons, input.triangulation, result.uv);
    return write_with_corner_uvs(file, format, mesh, uvs, {input.file, moved});
}

int run_sphere(const SphereRequest& request)
{
    if (request.ends_with_input) end_with_input();
    MapKind<SphereResult> kind;
    kind.compute = [&](const MeshInput& input, ExecutionContext& context) {
        SphereOptions options = request.sphere_options;
        options.polygon = input.triangulation.face;
        SphereResult result = with_filed_faces(input, [&] {
            return sphere_map(input.polygons.vertices, input.triangulation.triangles, options, context);
        });
        result.turned = filed_faces(input.triangulation, result.turned);
        for (auto faces : {&SphereLayoutReport::crossing, &SphereLayoutReport::torn, &SphereLayoutReport::flipped,
                           &SphereLayoutReport::below_resolution})
            result.layout.*faces = filed_faces(input.triangulation, result.layout.*faces);
        add_input_warnings(input, result.warnings);
        return result;
    };
    kind.write_mesh = [&](AtomicFile& file, const MeshInput& input, const SphereResult& result) {
        return write_sphere_mesh(file, request.format, input.polygons, input, result, false);
    };
    kind.write_sphere = [&](AtomicFile& file, const MeshInput& input, const SphereResult& result) {
        return write_sphere_mesh(file, required_format(request.sphere), on_unit_sphere(input, result), input, result,
                                 true);
    };
    kind.draw = [](const MeshInput& input, const SphereResult& result) {
        return sphere_svg(input.triangulation.triangles, result);
    };
    kind.report = [&](const SphereResult& result) { return to_json(result, request.sphere_options.layout); };
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
    options->add_option("IN", request->input, "surface of genus 0, closed or with holes: OBJ, OFF, PLY or STL")
        ->required();
    options
        ->add_option("OUT", request->output,
                     "OBJ or PLY to write: the same vertices and faces, with texture coordinates of corners")
        ->required();
    add_options(*options, "sphere", request->sphere_options);
    options
        ->add_option("--sphere", request->sphere,
                     "write the sphere itself there, OBJ or PLY: the same faces, their vertices on the unit sphere")
        ->type_name("FILE");
    options->add_option("--json", request->json, "write the report there")->type_name("FILE");
    options->add_option("--svg", request->svg, "write a picture of the sphere there, front and back")
        ->type_name("FILE");
    options->add_flag("--quiet", request->quiet, "no progress and no result line");
    options->add_flag(end_with_input_flag, request->ends_with_input)->group("");
    options->callback([request] {
        check_map_files(*request);
        if (!request->sphere.empty()) required_format(request->sphere);
        request->entries["options"] = option_report("sphere", request->sphere_options);
    });
    return {options, [request] { return run_sphere(*request); }};
}

}  // namespace koebe::cli
