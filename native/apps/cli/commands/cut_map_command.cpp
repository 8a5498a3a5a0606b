#include "cli/commands/cut_map_command.h"

#include "cli/commands/corner_map.h"
#include "cli/options/loop_options.h"
#include "core/counted.h"
#include "opened/cut_uniformize.h"
#include "report/cut_json.h"
#include "report/svg.h"

#include <string>
#include <utility>
#include <vector>

namespace koebe::cli {
namespace {

/// Changes all faces in the report to the file's.
void name_filed_faces(const MeshInput& input, CutUniformizeResult& result)
{
    const auto filed = [&](std::vector<Index>& faces) { faces = filed_faces(input.triangulation, faces); };
    for (MappedPiece& piece : result.pieces) {
        filed(piece.faces);
        for (Warning& warning : piece.map.warnings)
            if (elements_of(warning.kind) == ElementKind::faces) filed(warning.elements);
    }
    filed(result.turned);
    std::vector<LeftOutFace> left_out;
    for (LeftOutFace out : result.left_out) {
        out.face = input.triangulation.face[out.face];
        if (out.like >= 0) out.like = input.triangulation.face[out.like];
        if (left_out.empty() || left_out.back().face != out.face) left_out.push_back(out);
    }
    result.left_out = std::move(left_out);
    add_input_warnings(input, result.warnings);
}

}  // namespace

int run_cut_map(const MapRequest& request)
{
    MapKind<CutUniformizeResult> kind;
    kind.any_polygon = true;
    kind.many_pieces = true;
    kind.compute = [&](const MeshInput& input, ExecutionContext& context) {
        UniformizeOptions options = request.options;
        name_mapped_vertices(input, options);
        require_fitting_vertices(input, options);
        CutUniformizeResult result = uniformize_with_cuts(input.polygons.vertices, input.triangulation.triangles,
                                                          input.triangulation.face, options, context);
        name_filed_faces(input, result);
        return result;
    };
    write_corners(kind, request.format);
    kind.draw = [uvs = kind.corner_uvs](const MeshInput& input, const CutUniformizeResult& result) {
        return to_svg(result, input.polygons, uvs(input, result));
    };
    kind.report = [](const CutUniformizeResult& result) { return to_json(result); };
    kind.first_words = [](const CutUniformizeResult& result) {
        return counted(result.pieces.size(), "piece") + ", " + counted(result.cuts.size(), "cut");
    };
    return run_map_of(request, kind);
}

}  // namespace koebe::cli
