#include "cut/open_surface.h"

#include "core/enum_words.h"
#include "core/errors.h"
#include "cut/edge_chains.h"
#include "cut/handle_loops.h"
#include "cut/left_out_faces.h"
#include "cut/seamed_mesh.h"
#include "cut/slit.h"

#include <algorithm>
#include <array>
#include <string>
#include <utility>

namespace koebe {
namespace {

constexpr int most_base_points = 24;
/// Limit of faces times base points for all handles of a surface: some seconds.
constexpr double most_work = 4e6;
/// After so many rounds of cuts, long loops are taken too.
constexpr int patient_rounds = 12;

void require_arrays(const Vertices& vertices, const Triangles& triangles, const OpenOptions& options)
{
    if (vertices.rows() == 0) throw InputError("the mesh has no vertices");
    if (triangles.rows() == 0) throw InputError("the mesh has no faces");
    std::vector<Index> bad;
    for (Eigen::Index v = 0; v < vertices.rows(); ++v)
        if (!vertices.row(v).allFinite()) bad.push_back(static_cast<Index>(v));
    if (!bad.empty())
        throw InputError(std::to_string(bad.size()) + " vertices have a coordinate that is NaN or infinite",
                         ElementKind::vertices, bad);
    for (Eigen::Index f = 0; f < triangles.rows(); ++f)
        if (triangles.row(f).minCoeff() < 0 || triangles.row(f).maxCoeff() >= vertices.rows())
            bad.push_back(static_cast<Index>(f));
    if (!bad.empty())
        throw InputError(std::to_string(bad.size()) + " faces name a vertex that does not exist (faces listed)",
                         ElementKind::faces, bad);
    if (!options.polygon.empty() && options.polygon.size() != static_cast<std::size_t>(triangles.rows()))
        throw InputError("there must be a polygon for each face");
}

/// A connected part that is to become a piece.
struct Work {
    SeamedMesh mesh;
    bool was_closed = false;  ///< before its handles were cut
    bool slit = false;
    int rounds = 0;
    double work = 0.0;
};

class Opener {
public:
    Opener(OpenedSurface& result, const OpenOptions& options, ExecutionContext& context)
        : result_(result), options_(options), context_(context)
    {
    }

    std::vector<SeamedMesh> run(const SeamedMesh& mesh)
    {
        std::vector<Work> pending;
        for (SeamedMesh& part : connected_parts(mesh)) {
            const bool closed = std::ranges::find(part.twin, no_twin) == part.twin.end();
            pending.push_back({std::move(part), closed});
        }
        std::vector<SeamedMesh> done;
        const double all = static_cast<double>(mesh.face.size());
        double finished = 0.0;
        while (!pending.empty()) {
            Work work = std::move(pending.back());
            pending.pop_back();
            const std::vector<std::vector<Index>> paths = next_cuts(work);
            if (paths.empty()) {
                finished += static_cast<double>(work.mesh.face.size());
                context_.advance(finished / all);
                done.push_back(std::move(work.mesh));
                continue;
            }
            for (const auto& path : paths)
                for (const Index h : path) work.mesh.cut(h);
            for (SeamedMesh& part : connected_parts(work.mesh)) {
                join_idle_seams(part);
                pending.push_back({std::move(part), work.was_closed, work.slit, work.rounds, work.work});
            }
        }
        std::ranges::sort(done, {}, [](const SeamedMesh& part) { return part.face.front(); });
        return done;
    }

private:
    /// The next cuts, already added to the report; empty if the part is a piece.
    std::vector<std::vector<Index>> next_cuts(Work& work)
    {
        const std::size_t loops = boundary_halfedges(work.mesh).size();
        if (genus_of(work.mesh, loops) > 0) return next_handles(work);
        const bool enough = !work.was_closed || work.slit || !options_.long_slit || !options_.slit_beside_handles;
        if (loops > 0 && enough) return {};
        work.slit = true;
        std::vector<Index> path = options_.long_slit ? long_slit(work.mesh) : short_slit(work.mesh);
        if (path.empty() && loops == 0) {  // if polygons leave no other path
            std::ranges::fill(work.mesh.whole, char{0});
            path = short_slit(work.mesh);
        }
        if (path.empty()) return {};
        report(CutKind::opening, work.mesh, path);
        return {std::move(path)};
    }

    std::vector<std::vector<Index>> next_handles(Work& work)
    {
        const double faces = static_cast<double>(work.mesh.face.size());
        const double possible = (most_work - work.work) / (2.0 * faces);
        const int base_points = std::clamp(static_cast<int>(possible), 1, most_base_points);
        const bool all = work.rounds >= patient_rounds || possible < 1.0;
        std::vector<std::vector<Index>> loops = handle_loops(work.mesh, base_points, all, context_);
        work.work += base_points * faces;
        ++work.rounds;
        for (const auto& loop : loops) report(CutKind::handle, work.mesh, loop);
        result_.handles += static_cast<int>(loops.size());
        return loops;
    }

    void report(CutKind kind, const SeamedMesh& mesh, const std::vector<Index>& path)
    {
        std::vector<std::pair<Index, Index>> edges;
        for (const Index h : path) edges.emplace_back(origin(mesh.corners, h), target(mesh.corners, h));
        for (auto& chain : edge_chains(std::move(edges))) result_.cuts.push_back({kind, std::move(chain)});
    }

    OpenedSurface& result_;
    const OpenOptions& options_;
    ExecutionContext& context_;
};

SurfacePiece to_piece(const SeamedMesh& mesh, const Vertices& vertices)
{
    SurfacePiece piece;
    piece.triangles = mesh.fans;
    piece.source_face = mesh.face;
    piece.turned = mesh.turned;
    piece.source_vertex.resize(mesh.fan_count);
    for (Index h = 0; h < mesh.halfedge_count(); ++h)
        piece.source_vertex[origin(mesh.fans, h)] = origin(mesh.corners, h);
    piece.vertices = vertices(piece.source_vertex, Eigen::all);
    return piece;
}

}  // namespace

const char* to_string(CutKind kind) noexcept
{
    return word_of(kind, std::array{"crowded_edge", "orientation", "bow_tie", "handle", "opening"});
}

OpenedSurface open_surface(const Vertices& vertices, const Triangles& triangles, const OpenOptions& options,
                           ExecutionContext& context)
{
    require_arrays(vertices, triangles, options);
    OpenedSurface result;
    result.left_out = left_out_faces(triangles, static_cast<Index>(vertices.rows()), options.polygon);
    std::vector<Index> faces;
    for (Index f = 0, out = 0; f < static_cast<Index>(triangles.rows()); ++f) {
        if (out < static_cast<Index>(result.left_out.size()) && result.left_out[out].face == f)
            ++out;
        else
            faces.push_back(f);
    }
    if (faces.empty()) {
        std::vector<Index> all;
        for (const LeftOutFace& out : result.left_out) all.push_back(out.face);
        throw InputError("no face has three different vertices", ElementKind::faces, all);
    }
    context.checkpoint();
    Seams seams = seam_faces(vertices, triangles, faces, options.polygon);
    for (auto& chain : edge_chains(std::move(seams.crowded)))
        result.cuts.push_back({CutKind::crowded_edge, std::move(chain)});
    for (auto& chain : edge_chains(std::move(seams.disagree)))
        result.cuts.push_back({CutKind::orientation, std::move(chain)});
    if (!seams.bow_ties.empty()) result.cuts.push_back({CutKind::bow_tie, std::move(seams.bow_ties)});
    for (const SeamedMesh& part : Opener(result, options, context).run(seams.mesh))
        result.pieces.push_back(to_piece(part, vertices));
    std::ranges::stable_sort(result.cuts, {}, &SurfaceCut::kind);
    return result;
}

OpenedSurface open_surface(const Vertices& vertices, const Triangles& triangles, const OpenOptions& options)
{
    ExecutionContext context;
    return open_surface(vertices, triangles, options, context);
}

}  // namespace koebe
