// koebe sphere IN OUT
#include "cli/end_with_input.h"
#include "cli/map_run.h"
#include "cli/mapping_options.h"
#include "cli/subcommand.h"
#include "cli/validators.h"

#include "core/counted.h"
#include "domains/sphere_map.h"
#include "io/corner_uvs.h"
#include "report/sphere_json.h"
#include "report/sphere_svg.h"

#include <map>
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
    MapKind<SphereResult> kind = corner_map<SphereResult, SphereOptions>(request, request.sphere_options, sphere_map);
    kind.compute = [compute = kind.compute](const MeshInput& input, ExecutionContext& context) {
        SphereResult result = compute(input, context);
        for (auto faces : {&SphereLayoutReport::crossing, &SphereLayoutReport::torn, &SphereLayoutReport::flipped,
                           &SphereLayoutReport::below_resolution})
            result.layout.*faces = filed_faces(input.triangulation, result.layout.*faces);
        return result;
    };
    kind.write_sphere = [&](AtomicFile& file, const MeshInput& input, const SphereResult& result) {
        const PlanarPoints uvs = polygon_corner_uvs(input.polygons, input.triangulation, result.uv);
        return write_with_corner_uvs(file, required_format(request.sphere), on_unit_sphere(input, result), uvs,
                                     {input.file, true});
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
    SphereOptions& sphere = request->sphere_options;
    CLI::App* options = app.add_subcommand("sphere", "map a surface without handles to the sphere, its holes round");
    options->add_option("IN", request->input, "surface of genus 0, closed or with holes: OBJ, OFF, PLY or STL")
        ->required();
    options
        ->add_option("OUT", request->output,
                     "OBJ or PLY to write: the same vertices and faces, with texture coordinates of corners")
        ->required();
    const std::map<std::string, SphereLayout> names{
        {to_string(SphereLayout::equirectangular), SphereLayout::equirectangular},
        {to_string(SphereLayout::octahedral), SphereLayout::octahedral}};
    options
        ->add_option("--layout", sphere.layout,
                     "the sphere as texture coordinates: longitude and latitude, or the octahedron folded out")
        ->transform(CLI::Transformer(names))
        ->type_name("equirectangular|octahedral")
        ->default_str("equirectangular");
    options
        ->add_option("--sphere", request->sphere,
                     "write the sphere itself there, OBJ or PLY: the same faces, their vertices on the unit sphere")
        ->type_name("FILE");
    options
        ->add_option("--tolerance", sphere.tolerance,
                     "stop when the circles, or the points of a closed surface, move by less in a sweep")
        ->check(positive_number())
        ->type_name("LENGTH")
        ->capture_default_str();
    options->add_option("--max-sweeps", sphere.max_sweeps, "then stop, not converged")
        ->check(whole_number(1))
        ->type_name("N")
        ->capture_default_str();
    add_most_lost(*options, sphere.most_lost);
    options->add_option("--json", request->json, "write the report there")->type_name("FILE");
    options->add_option("--svg", request->svg, "write a picture of the sphere there, front and back")
        ->type_name("FILE");
    options->add_flag("--quiet", request->quiet, "no progress and no result line");
    options->add_flag(end_with_input_flag, request->ends_with_input)->group("");
    options->callback([request] {
        check_map_files(*request);
        if (!request->sphere.empty()) required_format(request->sphere);
        request->entries["options"] = {{"layout", to_string(request->sphere_options.layout)},
                                       {"tolerance", request->sphere_options.tolerance},
                                       {"max_sweeps", request->sphere_options.max_sweeps},
                                       {"most_lost", request->sphere_options.most_lost}};
    });
    return {options, [request] { return run_sphere(*request); }};
}

}  // namespace koebe::cli
