// koebe planar IN
#include "cli/commands/subcommand.h"
#include "cli/files/text_file.h"
#include "cli/options/option_table.h"
#include "cli/process/interrupt.h"
#include "cli/process/progress_line.h"
#include "cli/process/standard_streams.h"
#include "exit_code.h"

#include "files/extension.h"
#include "planar_domain/planar_map.h"
#include "report/json.h"
#include "report/planar_json.h"

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

namespace koebe::cli {
namespace {

struct PlanarRequest {
    std::string input, points, images;
    std::vector<double> pole;
    PlanarOptions options;
};

int run_planar(const PlanarRequest& request)
{
    PlanarOptions asked = request.options;
    if (!request.pole.empty()) asked.pole = Complex(request.pole[0], request.pole[1]);
    const CancelToken token = cancel_on_signal();
    require_standard_output();
    const std::vector<PlanarRim> rims =
        planar_rims(read_text(request.input), io::lower_extension(request.input) == ".svg");
    const VectorXcd points = request.points.empty() ? VectorXcd() : planar_places(read_text(request.points));
    const VectorXcd images = request.images.empty() ? VectorXcd() : planar_places(read_text(request.images));
    ProgressLine progress(false);
    ExecutionContext context(progress.callback(), token);
    const PlanarResult result = planar_map(rims, asked, context);
    nlohmann::ordered_json json = to_json(result);
    json["input"] = std::filesystem::path(request.input).filename().string();
    if (!request.points.empty()) {
        json["images"] = places_json(result.map(points));
        if (!result.slits.empty()) json["slit_images"] = places_json(result.map.slit_images(points));
    }
    if (!request.images.empty()) json["preimages"] = places_json(result.map.inverse(images));
    print(json_text(json));
    return result.converged ? done : not_converged;
}

}  // namespace

Subcommand add_planar(CLI::App& app)
{
    auto request = std::make_shared<PlanarRequest>();
    CLI::App* options = app.add_subcommand(
        "planar", "the circle domain of a planar domain with smooth or polygonal rims, to ten digits");
    options->add_option("IN", request->input, "JSON or SVG: the rims, an outer one and holes (docs/shapes.md)")
        ->required();
    options->add_option("--points", request->points, "JSON list of places [x, y] whose images the report has")
        ->type_name("FILE");
    options
        ->add_option("--inverse", request->images,
                     "JSON list of places of the circle domain: the report has their preimages")
        ->type_name("FILE");
    options->add_option("--pole", request->pole, "with parallel slits: the place of the domain that goes to infinity")
        ->expected(2)
        ->type_name("X Y");
    add_options(*options, "planar", request->options);
    return {options, [request] { return run_planar(*request); }};
}

}  // namespace koebe::cli
