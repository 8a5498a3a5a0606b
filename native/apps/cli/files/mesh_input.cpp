#include "cli/files/mesh_input.h"

#include "batch/content_hash.h"
#include "core/counted.h"
#include "core/errors.h"
#include "core/numbering.h"
#include "core/sort_unique.h"
#include "execution/detachable_run.h"
#include "execution/stopwatch.h"
#include "execution/thread_share.h"
#include "io/mesh_formats.h"
#include "io/welding.h"
#include "quality/take_verdict.h"

#include <algorithm>
#include <system_error>
#include <utility>

namespace koebe::cli {

namespace {

/// @throws InputError as MeshFormat::corner_uvs, or the file has none
PlanarPoints uvs_of(const MeshFile& file, const PolygonMesh& polygons, int set)
{
    const MeshFormat* const format = io::mesh_format(file.extension);
    PlanarPoints uvs;
    if (format != nullptr && format->corner_uvs != nullptr) uvs = format->corner_uvs(file.bytes, polygons, set);
    if (uvs.rows() == 0) throw InputError("the file has no texture coordinates");
    return uvs;
}

MeshInput read_and_triangulate(const std::filesystem::path& path, ReadOptions options)
{
    const Stopwatch reading;
    const ProfiledStage stage("read");
    const ThreadShare threads(options.threads);
    MeshInput input;
    input.file = read_hashed(path, options, input.sha256);
    input.polygons = parse_mesh(input.file.bytes, input.file.extension);
    if (options.uv_set) input.uvs = uvs_of(input.file, input.polygons, *options.uv_set);
    const MeshFormat* const format = io::mesh_format(input.file.extension);
    if (options.cut_at != CutAt::nothing && format != nullptr && format->corner_marks != nullptr)
        input.marks = format->corner_marks(input.file.bytes, options.cut_at);
    if (!options.keep_file) input.file = {};
    triangulate_input(input, options);
    input.seconds = reading.elapsed();
    return input;
}

void join_vertices(MeshInput& input, const ReadOptions& options)
{
    input.first = options.first.empty() ? weld(input.polygons.vertices, *options.weld) : options.first;
    input.joined = input.polygons;
    for (Index& corner : input.joined->corners) corner = input.mapped(corner);
    std::vector<Index> joined;
    for (Index v = 0; v < static_cast<Index>(input.first.size()); ++v)
        if (input.mapped(v) != v) joined.push_back(v);
    if (!joined.empty())
        input.warnings.push_back(
            {WarningKind::coincident, counted(joined.size(), "vertex") + " joined to earlier ones in the map", joined});
}

}  // namespace

MeshFile read_hashed(const std::filesystem::path& path, const ReadOptions& options, std::string& sha256)
{
    // Hash before reading: if the file changes in between, the hash belongs to no mesh, and the map is not taken for
    // another mesh's.
    std::error_code error;
    if (options.hash && std::filesystem::is_regular_file(path, error)) sha256 = batch::sha256_of_file(path);
    return read_mesh_file(path);
}

void triangulate_input(MeshInput& input, const ReadOptions& options)
{
    if (options.weld) join_vertices(input, options);
    input.triangulation = triangulate(input.mapped_polygons(), !options.any_polygon);
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
    if (options.weld) return;
    if (auto warning = coincident_vertices(input.polygons.vertices, input.triangulation.triangles))
        input.warnings.push_back(*std::move(warning));
}

MeshInput read_mesh_input(const std::filesystem::path& path, const CancelToken& token, const ReadOptions& options)
{
    ExecutionContext context({}, token);
    return run_detachable<MeshInput>(
        context, [path, options](ExecutionContext&) { return read_and_triangulate(path, options); });
}

std::vector<double> of_triangles(const MeshInput& input, const std::vector<double>& of_faces)
{
    if (of_faces.empty()) return {};
    if (of_faces.size() != static_cast<std::size_t>(input.polygons.face_count()))
        throw InputError("there must be a number for each of the " + counted(input.polygons.face_count(), "face") +
                         ", not " + std::to_string(of_faces.size()));
    return values_at(of_faces, input.triangulation.face);
}

std::vector<std::array<Index, 2>> marked_edges(const MeshInput& input)
{
    const PolygonMesh& mesh = input.mapped_polygons();
    std::vector<std::array<Index, 4>> sides;  // two vertices and their marks
    for (Index f = 0; f < mesh.face_count() && !input.marks.empty(); ++f)
        for (Index c = mesh.face_begin[f]; c < mesh.face_begin[f + 1]; ++c) {
            const Index next = c + 1 < mesh.face_begin[f + 1] ? c + 1 : mesh.face_begin[f];
            const auto [a, b] = mesh.corners[c] < mesh.corners[next] ? std::pair(c, next) : std::pair(next, c);
            sides.push_back({mesh.corners[a], mesh.corners[b], input.marks[a], input.marks[b]});
        }
    std::ranges::sort(sides);
    std::vector<std::array<Index, 2>> edges;
    for (std::size_t i = 1; i < sides.size(); ++i) {
        const std::array edge{sides[i][0], sides[i][1]};
        if (edge != std::array{sides[i - 1][0], sides[i - 1][1]} || sides[i] == sides[i - 1]) continue;
        if (edges.empty() || edges.back() != edge) edges.push_back(edge);
    }
    return edges;
}

void add_input_warnings(const MeshInput& input, std::vector<Warning>& warnings)
{
    for (Warning& warning : warnings)
        if (elements_of(warning.kind) == ElementKind::faces)
            warning.elements = filed_faces(input.triangulation, warning.elements);
    for (Warning& warning : warnings) {
        if (warning.kind != WarningKind::unused_vertices || input.first.empty()) continue;
        std::erase_if(warning.elements, [&](Index v) { return input.mapped(v) != v; });
        warning.sentence = counted(warning.elements.size(), "vertex") + " in no face";
    }
    std::erase_if(warnings, [](const Warning& warning) {
        return warning.kind == WarningKind::unused_vertices && warning.elements.empty();
    });
    warnings.insert(warnings.begin(), input.warnings.begin(), input.warnings.end());
    put_loss_first(warnings);
}

std::vector<Index> filed_faces(const Triangulation& triangulation, const std::vector<Index>& triangles)
{
    std::vector<Index> faces = values_at(triangulation.face, triangles);
    sort_unique(faces);
    return faces;
}

}  // namespace koebe::cli
