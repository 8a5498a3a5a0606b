// Maps that give each corner of a face its own UVs.
#pragma once

#include "cli/commands/map_run.h"
#include "io/corner_uvs.h"

namespace koebe::cli {

/// Writes the mesh with UVs per corner.
template <typename Result>
auto corner_writer(WrittenFormat format)
{
    return [format](AtomicFile& file, const MeshInput& input, const Result& result) {
        return write_with_corner_uvs(file, format, input.polygons,
                                     polygon_corner_uvs(input.polygons, input.triangulation, result.uv), {input.file});
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
        Result result = with_filed_faces(
            input, [&] { return map(input.polygons.vertices, input.triangulation.triangles, options, context); });
        result.turned = filed_faces(input.triangulation, result.turned);
        add_input_warnings(input, result.warnings);
        return result;
    };
    kind.write_mesh = corner_writer<Result>(request.format);
    kind.report = [](const Result& result) { return to_json(result); };
    return kind;
}

}  // namespace koebe::cli
