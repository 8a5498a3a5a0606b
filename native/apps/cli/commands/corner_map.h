// Maps that give each corner of a face its own UVs.
#pragma once

#include "cli/commands/map_run.h"
#include "cli/commands/subcommand.h"
#include "cli/commands/weights_option.h"
#include "cli/options/option_table.h"
#include "cli/process/end_with_input.h"
#include "io/corner_uvs.h"

#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace koebe::cli {

/// Writes the mesh with UVs per corner.
template <typename Result>
void write_corners(MapKind<Result>& kind, const MeshFormat* format)
{
    kind.corner_uvs = [](const MeshInput& input, const Result& result) {
        return polygon_corner_uvs(input.mapped_polygons(), input.triangulation, result.uv);
    };
    kind.write_mesh = [format, uvs = kind.corner_uvs](AtomicFile& file, const MeshInput& input, const Result& result) {
        return write_with_corner_uvs(file, *format, input.polygons, uvs(input, result), {input.file});
    };
}

/// The kind of a map whose result is a CornerMapReport. The caller sets draw and first_words.
template <typename Result, typename Options>
MapKind<Result> corner_map_kind(const MapRequest& request, const Options& chosen,
                                Result (*map)(const Vertices&, const Triangles&, const Options&, ExecutionContext&))
{
    MapKind<Result> kind;
    kind.compute = [&chosen, map](const MeshInput& input, ExecutionContext& context) {
        Options options = chosen;
        options.polygon = input.triangulation.face;
        name_mapped_vertices(input, options);
        Result result = with_filed_faces(
            input, [&] { return map(input.polygons.vertices, input.triangulation.triangles, options, context); });
        result.turned = filed_faces(input.triangulation, result.turned);
        add_input_warnings(input, result.warnings);
        return result;
    };
    write_corners(kind, request.format);
    kind.report = [](const Result& result) { return to_json(result); };
    return kind;
}

/// The kind of such a map in pieces, whose faces are those of the file.
template <typename Result, typename Options, typename Piece>
MapKind<Result> piece_map_kind(const MapRequest& request, const Options& chosen,
                               Result (*map)(const Vertices&, const Triangles&, const Options&, ExecutionContext&),
                               std::vector<Piece> Result::*pieces)
{
    auto kind = corner_map_kind<Result, Options>(request, chosen, map);
    kind.many_pieces = true;
    kind.compute = [compute = kind.compute, pieces](const MeshInput& input, ExecutionContext& context) {
        Result result = compute(input, context);
        for (Piece& piece : result.*pieces) piece.faces = filed_faces(input.triangulation, piece.faces);
        return result;
    };
    return kind;
}

/// The request for such a map: files and options.
template <typename Options>
struct CornerMapRequest : MapRequest {
    Options chosen;
    WeightsOption show, importance;
    bool ends_with_input = false;
};

/// The words of the help for such a map.
struct CornerMapHelp {
    const char* name;  ///< name of the command, and of the map in the table of options
    const char* does;
    const char* surface;
    const char* picture;  ///< description of --svg; empty: there is no such option
    const char* uvs = "texture coordinates of corners in [0, 1]^2";
    bool has_sphere = false;       ///< whether there is an option --sphere
    const char* output = nullptr;  ///< description of an OUT that is no mesh with `uvs`
    void (*check)(MapRequest&) = check_map_files;
};

/// Adds the command of such a map.
template <typename Options>
Subcommand add_corner_map(CLI::App& app, const CornerMapHelp& help,
                          const std::function<int(const CornerMapRequest<Options>&)>& run)
{
    auto request = std::make_shared<CornerMapRequest<Options>>();
    CLI::App* options = app.add_subcommand(help.name, help.does);
    if (help.output == nullptr) {
        add_mesh_arguments(*options, *request, help.surface, help.uvs);
    } else {
        add_input(*options, request->input, help.surface);
        add_output(*options, request->output, help.output);
    }
    add_options(*options, help.name, request->chosen);
    add_options(*options, help.name, request->of_files);
    request->show.add(*options, help.name, "show");
    request->importance.add(*options, help.name, "importance");
    if (help.has_sphere)
        options
            ->add_option("--sphere", request->sphere,
                         "write the sphere itself there, " + io::listed_formats(io::FormatName::word, true) +
                             ": the same faces, their vertices on the unit sphere")
            ->type_name("FILE");
    add_report_options(*options, *request, help.picture);
    options->add_flag(end_with_input_flag, request->ends_with_input)->group("");
    options->callback([request, name = help.name, check = help.check] {
        check(*request);
        if (!request->sphere.empty()) required_format(request->sphere);
        request->entries["options"] = option_report(name, request->chosen);
        request->entries["options"].update(option_report(name, request->of_files));
        request->show.check(*request);
        request->importance.check(*request);
    });
    return {options, [request, run] {
                if (request->ends_with_input) end_with_input();
                if constexpr (requires { request->chosen.show; })
                    request->chosen.show = request->show.read("a weight to show");
                if constexpr (requires { request->chosen.importance; })
                    request->chosen.importance = request->importance.read("an importance");
                return run(*request);
            }};
}

}  // namespace koebe::cli
