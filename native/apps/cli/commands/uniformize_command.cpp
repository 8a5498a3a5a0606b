// koebe uniformize IN OUT
#include "cli/commands/corner_command.h"
#include "cli/commands/subcommand.h"
#include "cli/commands/uniformize_kind.h"
#include "cli/commands/weights_option.h"
#include "cli/options/loop_options.h"
#include "cli/options/option_table.h"
#include "cli/options/uniformize_options.h"
#include "cli/process/end_with_input.h"

#include "core/counted.h"
#include "opened/cut_uniformize.h"
#include "pipeline/uniformize.h"
#include "report/cut_json.h"
#include "report/svg.h"

#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace koebe::cli {
namespace {

struct UniformizeRequest : MapRequest {
    bool cut = false;
    WeightsOption importance;
    bool ends_with_input = false;
};

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

/// --cut: any mesh, with texture coordinates per corner.
class CutUniformizeKind final : public CornerKind<CutUniformizeResult> {
public:
    explicit CutUniformizeKind(const MapRequest& request) : CornerKind(request.format), chosen_(request.options) {}

    bool any_polygon() const override { return true; }
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

Subcommand add_uniformize(CLI::App& app)
{
    auto request = std::make_shared<UniformizeRequest>();
    CLI::App* options = app.add_subcommand("uniformize", "map a surface with holes to a circle domain");
    add_mesh_arguments(*options, *request);
    add_uniformize_options(*options, request->options, request->cut);
    add_options(*options, "uniformize", request->of_files);
    request->importance.add(*options, "uniformize", "importance");
    add_report_options(*options, *request);
    options->add_flag(end_with_input_flag, request->ends_with_input)->group("");
    // Combinations that say nothing are refused before a mesh is read.
    options->callback([options, request] {
        check_map_files(*request);
        check_uniformize_options(*options, request->options, request->cut);
        if (request->importance.is_given() && request->options.balance == Balance::none &&
            !(request->options.even > 0.0))
            throw CLI::ValidationError("--importance", "needs --balance area, or --even above 0");
        // The report's options, ahead of the run.
        request->entries["options"] = uniformize_report(request->options, request->cut);
        request->entries["options"].update(option_report("uniformize", request->of_files));
        request->importance.check(*request);
    });
    return {options,
            [request] {
                if (request->ends_with_input) end_with_input();
                request->options.importance = request->importance.read("an importance");
                // With --cut, surfaces with handles or in pieces are cut open first.
                if (request->cut) return run_map_of(*request, CutUniformizeKind(*request));
                const auto map = [](const auto& vertices, const auto& triangles, const auto& chosen,
                                    ExecutionContext& context) {
                    require_schedule_of_loops(triangles, static_cast<Index>(vertices.rows()), chosen);
                    return uniformize(vertices, triangles, chosen, context);
                };
                return run_map_of(*request, UniformizeKind(*request, map));
            },
            &request->entries};
}

}  // namespace koebe::cli
