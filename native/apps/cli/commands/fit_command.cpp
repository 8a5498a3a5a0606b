// koebe fit IN TEMPLATE OUT
#include "cli/commands/map_run.h"
#include "cli/commands/subcommand.h"
#include "cli/files/template_file.h"
#include "cli/options/option_table.h"

#include "core/counted.h"
#include "fit/fit_circles.h"
#include "pipeline/convex_disk.h"
#include "report/fit_json.h"

#include <algorithm>
#include <memory>
#include <string>

namespace koebe::cli {
namespace {

struct FitRequest : MapRequest {
    std::string wanted;
    bool extremal = false;
};

class FitKind final : public DiskKind<FitResult> {
public:
    explicit FitKind(const FitRequest& request)
        : DiskKind(request), wanted_(read_template(request.wanted)), extremal_(request.extremal)
    {
    }

    FitResult compute(const MeshInput& input, ExecutionContext& context) const override
    {
        CircleTemplate named = wanted_;
        const auto name_mapped = [&input](TemplateRim& rim) {
            if (rim.pin) rim.pin->vertex = input.mapped(rim.pin->vertex);
        };
        name_mapped(named.outer);
        std::ranges::for_each(named.rims, name_mapped);
        FitResult result = with_filed_faces(input, [&] {
            return fit_circles(input.polygons.vertices, input.triangulation.triangles, named,
                               {.map = request_.options, .extremal = extremal_}, context);
        });
        make_polygons_convex(input.polygons.vertices, input.triangulation.triangles, input.triangulation.face, result,
                             context, false);  // the fit's |mu| is least as it is
        input.give_to_joined(result.uv);
        add_input_warnings(input, result.warnings);
        return result;
    }
    std::string first_words(const FitResult& result) const override
    {
        return counted(result.loops.size() - 1, "circle") + ", |mu| " + formatted("%.2g", result.of_faces.mean) +
               ", at most " + formatted("%.2g", result.of_faces.max);
    }

private:
    CircleTemplate wanted_;
    bool extremal_;
};

}  // namespace

Subcommand add_fit(CLI::App& app)
{
    auto request = std::make_shared<FitRequest>();
    CLI::App* options = app.add_subcommand("fit", "map a surface with holes to circles at given places");
    add_input(*options, request->input, "surface with holes");
    options->add_option("TEMPLATE", request->wanted, "JSON file: centres and radii of the circles (docs/fit.md)")
        ->required();
    add_mapped_mesh(*options, *request);
    options->add_flag("--extremal", request->extremal, "least largest |mu|, nearly; takes longer");
    add_options(*options, "shapes", request->options);
    add_options(*options, "shapes", request->of_files);
    add_report_options(*options, *request, "write a picture of the template there");
    options->callback([request] {
        check_map_files(*request);
        require_different_files(map_files(*request), {request->input, request->wanted}, !request->quiet);
        report_options(*request, "shapes", request->options);
        request->entries["options"]["extremal"] = request->extremal;
    });
    return {options, [request] { return run_map_of(*request, FitKind(*request)); }};
}

}  // namespace koebe::cli
