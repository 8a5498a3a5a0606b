// koebe torus IN OUT, koebe ring IN OUT
#include "cli/commands/corner_map.h"
#include "cli/commands/subcommand.h"
#include "cli/options/option_table.h"
#include "cli/process/end_with_input.h"

#include "core/counted.h"
#include "report/tile_json.h"
#include "report/tile_svg.h"
#include "tiles/tile_map.h"

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
    auto kind = corner_map_kind(request, request.tile, map);
    kind.draw = [](const MeshInput&, const TileResult& result) { return tile_svg(result); };
    kind.first_words = first_words;
    return run_map_of(request, kind);
}

/// Adds all options of the command.
void add_tile_options(CLI::App& app, const char* map, const char* surface, Request& request)
{
    add_mesh_arguments(app, request, surface, "texture coordinates of corners in [0, 1]^2");
    add_options(app, map, request.tile);
    add_report_options(app, request, "write a picture of the tile and its copies there");
    app.add_flag(end_with_input_flag, request.ends_with_input)->group("");
}

}  // namespace

Subcommand add_torus(CLI::App& app)
{
    auto request = std::make_shared<Request>();
    CLI::App* options = app.add_subcommand("torus", "map a surface with one handle to a flat torus, its holes round");
    add_tile_options(*options, "torus", "surface of genus 1, with or without holes", *request);
    options->callback([request] {
        check_map_files(*request);
        request->entries["options"] = option_report("torus", request->tile);
    });
    return {options, [request] { return run(*request, torus_map); }};
}

Subcommand add_ring(CLI::App& app)
{
    auto request = std::make_shared<Request>();
    CLI::App* options = app.add_subcommand("ring", "map a surface with two loops and more to a cylinder, unrolled");
    add_tile_options(*options, "ring", "surface of genus 0 with two loops or more", *request);
    options->callback([request] {
        check_map_files(*request);
        request->entries["options"] = option_report("ring", request->tile);
    });
    return {options, [request] { return run(*request, ring_map); }};
}

}  // namespace koebe::cli
