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

class CutUniformizeKind final : public CornerKind<CutUniformizeResult> {
public:
    explicit CutUniformizeKind(const MapRequest& request) : CornerKind(request.format), chosen_(request.options) {}

    bool any_polygon() const override { return true; }
    bool many_pieces() const override { return true; }
    CutUniformizeResult compute(const MeshInput& input, ExecutionContext& context) const override
    {
        UniformizeOptions options = chosen_;
        name_mapped_vertices(input, options);
        require_fitting_vertices(input, options);
        CutUniformizeResult result = uniformize_with_cuts(input.polygons.vertices, input.triangulation.triangles,
                                                          input.triangulation.face, options, context);
        name_filed_faces(input, result);
        return result;
    }
    std::string draw(const MeshInput& input, const CutUniformizeResult& result) const override
    {
        return to_svg(result, input.polygons, corner_uvs(input, result));
    }
    std::string first_words(const CutUniformizeResult& result) const override
    {
        return counted(result.pieces.size(), "piece") + ", " + counted(result.cuts.size(), "cut");
    }

private:
    const UniformizeOptions& chosen_;
};

}  // namespace

int run_cut_map(const MapRequest& request) { return run_map_of(request, CutUniformizeKind(request)); }

}  // namespace koebe::cli
