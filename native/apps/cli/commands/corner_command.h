// Maps that give each corner of a face its own UVs.
#pragma once

#include "cli/commands/map_run.h"
#include "cli/commands/subcommand.h"
#include "cli/commands/weights_option.h"
#include "cli/options/option_table.h"
#include "cli/process/end_with_input.h"
#include "io/corner_uvs.h"

#include <memory>
#include <vector>

namespace koebe::cli {

/// The request for such a map: files and options.
template <typename Options>
struct CornerMapRequest : MapRequest {
    Options chosen;
    WeightsOption show, importance, locked;
    bool ends_with_input = false;
};

/// A map that writes the mesh with UVs per corner.
template <typename Result>
class CornerKind : public MapKind<Result> {
public:
    explicit CornerKind(const MeshFormat* format) : format_(format) {}

    PlanarPoints corner_uvs(const MeshInput& input, const Result& result) const override
    {
        return polygon_corner_uvs(input.mapped_polygons(), input.triangulation, result.uv);
    }
    std::vector<Warning> write_mesh(AtomicFile& file, const MeshInput& input, const Result& result) const override
    {
        return write_with_corner_uvs(file, *format_, input.polygons, corner_uvs(input, result), {input.file});
    }

private:
    const MeshFormat* format_;
};

/// The types of a map's result and options.
template <auto map>
struct MapTypes;
template <typename R, typename O, R (*map)(const Vertices&, const Triangles&, const O&, ExecutionContext&)>
struct MapTypes<map> {
    using Result = R;
    using Options = O;
};

/// Such a map whose result is a CornerMapReport.
template <auto map>
class CornerMapKind : public CornerKind<typename MapTypes<map>::Result> {
public:
    using Result = typename MapTypes<map>::Result;
    using Options = typename MapTypes<map>::Options;
    using Request = CornerMapRequest<Options>;

    explicit CornerMapKind(const Request& request) : CornerKind<Result>(request.format), request_(request) {}

    Result compute(const MeshInput& input, ExecutionContext& context) const override
    {
        Options options = request_.chosen;
        options.polygon = input.triangulation.face;
        if constexpr (requires { options.uv; })
            options.uv = triangle_corner_uvs(input.mapped_polygons(), input.triangulation, input.uvs);
        if constexpr (requires { options.cuts; }) options.cuts = marked_edges(input);
        if constexpr (requires { options.locked; }) options.locked = of_triangles(input, options.locked);
        name_mapped_vertices(input, options);
        Result result = with_filed_faces(
            input, [&] { return map(input.polygons.vertices, input.triangulation.triangles, options, context); });
        result.turned = filed_faces(input.triangulation, result.turned);
        add_input_warnings(input, result.warnings);
        return result;
    }

protected:
    const Request& request_;
};

/// Such a map in pieces.
template <auto map, auto pieces>
class PieceMapKind : public CornerMapKind<map> {
public:
    using CornerMapKind<map>::CornerMapKind;

    typename MapTypes<map>::Result compute(const MeshInput& input, ExecutionContext& context) const override
    {
        auto result = CornerMapKind<map>::compute(input, context);
        for (auto& piece : result.*pieces) piece.faces = filed_faces(input.triangulation, piece.faces);
        return result;
    }
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
template <typename Kind>
Subcommand add_corner_map(CLI::App& app, const CornerMapHelp& help)
{
    auto request = std::make_shared<typename Kind::Request>();
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
    request->locked.add(*options, help.name, "locked");
    if (help.has_sphere)
        options
            ->add_option("--sphere", request->sphere,
                         "write the sphere itself there, " + io::listed_formats(io::FormatName::word, true) +
                             ": the same faces, their vertices on the unit sphere")
            ->type_name("FILE");
    add_report_options(*options, *request, help.picture);
    options->add_flag(end_with_input_flag, request->ends_with_input)->group("");
    // Checks run while the words are read; files of weights are read by the run.
    options->callback([request, name = help.name, check = help.check] {
        check(*request);
        if (!request->sphere.empty()) required_format(request->sphere);
        report_options(*request, name, request->chosen);
        request->show.check(*request);
        request->importance.check(*request);
        request->locked.check(*request);
    });
    return {options,
            [request] {
                if (request->ends_with_input) end_with_input();
                if constexpr (requires { request->chosen.show; })
                    request->chosen.show = request->show.read("a weight to show");
                if constexpr (requires { request->chosen.importance; })
                    request->chosen.importance = request->importance.read("an importance");
                if constexpr (requires { request->chosen.locked; })
                    request->chosen.locked = request->locked.read("a lock");
                return run_map_of(*request, Kind(*request));
            },
            &request->entries};
}

}  // namespace koebe::cli
