// koebe torus IN OUT, koebe ring IN OUT
#include "cli/end_with_input.h"
#include "cli/map_run.h"
#include "cli/mapping_options.h"
#include "cli/subcommand.h"
#include "cli/validators.h"

#include "core/counted.h"
#include "domains/tile_map.h"
#include "io/corner_uvs.h"
#include "report/tile_json.h"
#include "report/tile_svg.h"

#include <map>
#include <memory>
#include <string>
#include <utility>

namespace koebe::cli {
namespace {

struct Request : MapRequest {
    TileOptions tile;
    bool ends_with_input = false;
};

using TileFunction = TileResult (*)(const Vertices&, const Triangles&, const TileOptions&, ExecutionContext&);

std::string first_words(const TileResult& result)
{
    const bool torus = result.periods.size() > 1;
    std::string words = counted(result.loops.size(), "loop") + ", modulus ";
    if (torus) words += rounded("%.5g", result.modulus.real()) + (result.modulus.imag() < 0.0 ? "" : "+");
    return words + rounded("%.5g", result.modulus.imag()) + "i";
}

int run(const Request& request, TileFunction map)
{
    if (request.ends_with_input) end_with_input();
    MapKind<TileResult> kind = corner_map(request, request.tile, map);
    kind.draw = [](const MeshInput&, const TileResult& result) { return tile_svg(result); };
    kind.report = [](const TileResult& result) { return to_json(result); };
    kind.first_words = first_words;
    return run_map_of(request, kind);
}

void add_files(CLI::App& app, Request& request, const char* kind)
{
    app.add_option("IN", request.input, kind)->required();
    app.add_option("OUT", request.output,
                   "OBJ or PLY to write: the same vertices and faces, with texture coordinates of corners in [0, 1]^2")
        ->required();
}

void add_iteration(CLI::App& app, Request& request)
{
    app.add_option("--tolerance", request.tile.tolerance, "stop when the circles move by less in a sweep")
        ->check(positive_number())
        ->type_name("LENGTH")
        ->capture_default_str();
    app.add_option("--max-sweeps", request.tile.max_sweeps, "then stop, not converged")
        ->check(whole_number(1))
        ->type_name("N")
        ->capture_default_str();
    add_most_lost(app, request.tile.most_lost);
    app.add_option("--json", request.json, "write the report there")->type_name("FILE");
    app.add_option("--svg", request.svg, "write a picture of the tile and its copies there")->type_name("FILE");
    app.add_flag("--quiet", request.quiet, "no progress and no result line");
    app.add_flag(end_with_input_flag, request.ends_with_input)->group("");
}

nlohmann::ordered_json iteration_report(const TileOptions& options)
{
    return {{"tolerance", options.tolerance}, {"max_sweeps", options.max_sweeps}, {"most_lost", options.most_lost}};
}

}  // namespace

Subcommand add_torus(CLI::App& app)
{
    auto request = std::make_shared<Request>();
    CLI::App* options = app.add_subcommand("torus", "map a surface with one handle to a flat torus, its holes round");
    add_files(*options, *request, "surface of genus 1, with or without holes: OBJ, OFF, PLY or STL");
    add_iteration(*options, *request);
    options->callback([request] {
        check_map_files(*request);
        request->entries["options"] = iteration_report(request->tile);
    });
    return {options, [request] { return run(*request, torus_map); }};
}

Subcommand add_ring(CLI::App& app)
{
    auto request = std::make_shared<Request>();
    CLI::App* options = app.add_subcommand("ring", "map a surface with two loops and more to a cylinder, unrolled");
    add_files(*options, *request, "surface of genus 0 with two loops or more: OBJ, OFF, PLY or STL");
    options->add_option("--outer", request->tile.outer, "a vertex of the rim where v = 0 (from 0); else a longest loop")
        ->check(whole_number(0))
        ->type_name("VERTEX");
    options->add_option("--inner", request->tile.inner, "a vertex of the other rim (from 0); else a longest loop")
        ->check(whole_number(0))
        ->type_name("VERTEX");
    const std::map<std::string, RingHoles> names{{to_string(RingHoles::circles), RingHoles::circles},
                                                 {to_string(RingHoles::concentric), RingHoles::concentric},
                                                 {to_string(RingHoles::radial), RingHoles::radial}};
    options
        ->add_option("--holes", request->tile.holes,
                     "what becomes of the others: round in the annulus, or slits round it or along its radii")
        ->transform(CLI::Transformer(names))
        ->type_name("circles|concentric|radial")
        ->default_str("circles");
    add_iteration(*options, *request);
    options->callback([request] {
        check_map_files(*request);
        const auto vertex = [](Index number) {
            return number < 0 ? nlohmann::ordered_json() : nlohmann::ordered_json(number);
        };
        nlohmann::ordered_json report{{"outer", vertex(request->tile.outer)},
                                      {"inner", vertex(request->tile.inner)},
                                      {"holes", to_string(request->tile.holes)}};
        report.update(iteration_report(request->tile));
        request->entries["options"] = std::move(report);
    });
    return {options, [request] { return run(*request, ring_map); }};
}

}  // namespace koebe::cli
