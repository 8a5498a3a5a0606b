#include "cli/files/mesh_input.h"

#include "batch/content_hash.h"
#include "core/counted.h"
#include "core/errors.h"
#include "core/sort_unique.h"
#include "execution/detachable_run.h"
#include "execution/stopwatch.h"
#include "execution/thread_share.h"
#include "quality/take_verdict.h"

#include <system_error>

namespace koebe::cli {

namespace {

MeshInput read_and_triangulate(const std::filesystem::path& path, ReadOptions options)
{
    const Stopwatch reading;
    const ThreadShare threads(options.threads);
    MeshInput input;
    if (options.hash) input.sha256 = input_hash(path);
    input.file = read_mesh_file(path);
    input.polygons = parse_mesh(input.file.bytes, input.file.extension);
    if (!options.keep_file) input.file = {};
    triangulate_input(input, options.any_polygon);
    input.seconds = reading.elapsed();
    return input;
}

}  // namespace

std::string input_hash(const std::filesystem::path& path)
{
    // Hash before reading: if the file changes in between, the hash belongs to no mesh, and the map is not taken for
    // another mesh's.
    std::error_code error;
    return std::filesystem::is_regular_file(path, error) ? batch::sha256_of_file(path) : "";
}

void triangulate_input(MeshInput& input, bool any_polygon)
{
    input.triangulation = triangulate(input.polygons, !any_polygon);
    const std::vector<Index>& collapsed = input.triangulation.collapsed;
    if (!collapsed.empty())
        input.warnings.push_back(
            {WarningKind::collapsed_faces,
             "faces with fewer than three different vertices, left out: " + std::to_string(collapsed.size()),
             collapsed});
    if (const std::vector<Index>& uncut = input.triangulation.uncut; !uncut.empty())
        input.warnings.push_back({WarningKind::left_out,
                                  counted(uncut.size(), "polygon") +
                                      " cannot be cut into triangles: left out of the map, each drawn as one point",
                                  uncut});
    if (input.triangulation.triangles.rows() == 0)
        throw InputError("no face has three different vertices", ElementKind::faces, collapsed);
}

MeshInput read_mesh_input(const std::filesystem::path& path, const CancelToken& token, ReadOptions options)
{
    ExecutionContext context({}, token);
    return run_detachable<MeshInput>(
        context, [path, options](ExecutionContext&) { return read_and_triangulate(path, options); });
}

void add_input_warnings(const MeshInput& input, std::vector<Warning>& warnings)
{
    for (Warning& warning : warnings)
        if (elements_of(warning.kind) == ElementKind::faces)
            warning.elements = filed_faces(input.triangulation, warning.elements);
    warnings.insert(warnings.begin(), input.warnings.begin(), input.warnings.end());
    put_loss_first(warnings);
}

std::vector<Index> filed_faces(const Triangulation& triangulation, const std::vector<Index>& triangles)
{
    std::vector<Index> faces;
    faces.reserve(triangles.size());
    for (const Index t : triangles) faces.push_back(triangulation.face[static_cast<std::size_t>(t)]);
    sort_unique(faces);
    return faces;
}

}  // namespace koebe::cli
