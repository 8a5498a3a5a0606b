// koebe sphere IN OUT
#include "cli/commands/corner_command.h"

#include "core/counted.h"
#include "report/sphere_json.h"
#include "report/sphere_svg.h"
#include "sphere/sphere_map.h"

namespace koebe::cli {
namespace {

PolygonMesh on_unit_sphere(const MeshInput& input, const SphereResult& result)
{
    PolygonMesh mesh = input.polygons;
    mesh.vertices = result.points;
    return mesh;
}

class SphereKind final : public CornerMapKind<sphere_map> {
public:
    using CornerMapKind::CornerMapKind;

    SphereResult compute(const MeshInput& input, ExecutionContext& context) const override
    {
        SphereResult result = CornerMapKind::compute(input, context);
        input.give_to_joined(result.points);
        for (auto faces : {&SphereLayoutReport::crossing, &SphereLayoutReport::moved, &SphereLayoutReport::torn,
                           &SphereLayoutReport::flipped, &SphereLayoutReport::below_resolution})
            result.layout.*faces = filed_faces(input.triangulation, result.layout.*faces);
        return result;
    }
    std::vector<Warning> write_sphere(AtomicFile& file, const MeshInput& input,
                                      const SphereResult& result) const override
    {
        return write_with_corner_uvs(file, *required_format(request_.sphere), on_unit_sphere(input, result),
                                     corner_uvs(input, result), {input.file, true});
    }
    std::string draw(const MeshInput& input, const SphereResult& result) const override
    {
        return sphere_svg(input.triangulation.triangles, result);
    }
    std::string first_words(const SphereResult& result) const override
    {
        return counted(result.loops.size(), "loop") + ", " + counted(static_cast<std::size_t>(result.sweeps), "sweep");
    }
};

}  // namespace

Subcommand add_sphere(CLI::App& app)
{
    return add_corner_map<SphereKind>(app, {.name = "sphere",
                                            .does = "map a surface without handles to the sphere, its holes round",
                                            .surface = "surface of genus 0, closed or with holes",
                                            .picture = "write a picture of the sphere there, front and back",
                                            .uvs = "texture coordinates of corners",
                                            .has_sphere = true});
}

}  // namespace koebe::cli
