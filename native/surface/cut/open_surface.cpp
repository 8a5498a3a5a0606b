#include "cut/open_surface.h"

#include "core/enum_words.h"
#include "core/errors.h"
#include "core/numbering.h"
#include "core/sort_unique.h"
#include "core/types.h"
#include "cut/handle_loops.h"
#include "cut/seam_faces.h"
#include "cut/slits.h"

#include <algorithm>
#include <array>
#include <map>
#include <string>
#include <utility>
#include <vector>

namespace koebe {
namespace {

/// Paths of vertices that go along each edge once, as long as possible without a branch. A closed path ends with its
/// first vertex.
std::vector<std::vector<Index>> edge_chains(std::vector<std::pair<Index, Index>> edges)
{
    for (auto& edge : edges) edge = std::minmax({edge.first, edge.second});
    sort_unique(edges);

    struct End {
        Index vertex, other;
        std::size_t edge;
    };
    std::vector<End> ends;
    for (std::size_t e = 0; e < edges.size(); ++e) {
        ends.push_back({edges[e].first, edges[e].second, e});
        ends.push_back({edges[e].second, edges[e].first, e});
    }
    std::ranges::sort(ends, {}, [](const End& end) { return std::pair(end.vertex, end.other); });
    // Number of edge ends at a vertex, and the first of them.
    const auto at = [&](Index v) {
        const auto first = std::ranges::lower_bound(ends, v, {}, &End::vertex);
        return std::pair(std::ranges::upper_bound(ends, v, {}, &End::vertex) - first, first);
    };

    std::vector<char> walked(edges.size(), 0);
    std::vector<std::vector<Index>> chains;
    const auto walk = [&](const End& first) {
        if (walked[first.edge]) return;
        walked[first.edge] = 1;
        std::vector<Index> chain{first.vertex, first.other};
        for (auto next = at(chain.back()); next.first == 2; next = at(chain.back())) {
            const End& end = walked[next.second->edge] ? *std::next(next.second) : *next.second;
            if (walked[end.edge]) break;
            walked[end.edge] = 1;
            chain.push_back(end.other);
        }
        chains.push_back(std::move(chain));
    };
    for (const End& end : ends)
        if (at(end.vertex).first != 2) walk(end);
    for (const End& end : ends) walk(end);
    return chains;
}

using Corners = std::array<Index, 3>;

bool is_degenerate(const Triangles& triangles, Index f)
{
    return triangles(f, 0) == triangles(f, 1) || triangles(f, 1) == triangles(f, 2) ||
           triangles(f, 2) == triangles(f, 0);
}

Corners sorted_corners(const Triangles& triangles, Index f)
{
    Corners corners{triangles(f, 0), triangles(f, 1), triangles(f, 2)};
    std::ranges::sort(corners);
    return corners;
}

/// (F) the first face with the same vertices, perhaps the face itself.
std::vector<Index> first_alike(const Triangles& triangles)
{
    std::vector<Index> order;
    for (Index f = 0; f < static_cast<Index>(triangles.rows()); ++f)
        if (!is_degenerate(triangles, f)) order.push_back(f);
    std::ranges::stable_sort(
        order, [&](Index f, Index g) { return sorted_corners(triangles, f) < sorted_corners(triangles, g); });
    std::vector<Index> first = numbers_below(triangles.rows());
    for (std::size_t i = 1; i < order.size(); ++i)
        if (sorted_corners(triangles, order[i]) == sorted_corners(triangles, order[i - 1]))
            first[order[i]] = first[order[i - 1]];
    return first;
}

/// Removes the duplicate's mark from polygons that do not duplicate one other polygon as a whole.
void keep_partial_polygons(const std::vector<Index>& polygon, std::vector<Index>& first)
{
    std::map<Index, std::vector<Index>> faces;
    for (std::size_t f = 0; f < first.size(); ++f) faces[polygon[f]].push_back(static_cast<Index>(f));
    for (const auto& one : faces) {
        const Index number = one.first;
        const std::vector<Index>& own = one.second;
        const Index other = polygon[first[own.front()]];
        const bool whole = std::ranges::all_of(
            own, [&](Index f) { return first[f] != f && polygon[first[f]] == other && other != number; });
        if (!whole)
            for (const Index f : own) first[f] = f;
    }
}

/// (V) a face at each vertex that is not left out, or -1.
std::vector<Index> face_at(const Triangles& triangles, Index vertex_count, const std::vector<Index>& first)
{
    std::vector<Index> face(vertex_count, -1);
    for (Index f = static_cast<Index>(triangles.rows()) - 1; f >= 0; --f)
        if (first[f] == f && !is_degenerate(triangles, f))
            for (int k = 0; k < 3; ++k) face[triangles(f, k)] = f;
    return face;
}

/// Finds faces that name a vertex twice, and faces with the three vertices of an earlier face. A polygon is a duplicate
/// only as a whole: if all its faces duplicate faces of one other polygon.
/// @param polygon (F) or empty, as in OpenOptions
std::vector<LeftOutFace> left_out_faces(const Triangles& triangles, Index vertex_count,
                                        const std::vector<Index>& polygon)
{
    std::vector<Index> first = first_alike(triangles);
    if (!polygon.empty()) keep_partial_polygons(polygon, first);
    const std::vector<Index> at = face_at(triangles, vertex_count, first);
    std::vector<LeftOutFace> result;
    for (Index f = 0; f < static_cast<Index>(triangles.rows()); ++f) {
        if (is_degenerate(triangles, f)) {
            Index like = -1;
            for (int k = 0; k < 3 && like < 0; ++k) like = at[triangles(f, k)];
            result.push_back({f, like, true});
        } else if (first[f] != f) {
            result.push_back({f, first[f], false});
        }
    }
    return result;
}

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
        // Cut until no part wants a cut. The parts end in the order of their first faces.
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
        if (!options_.open) return {};
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
    piece.source_vertex = vertices_of_fans(mesh);
    piece.vertices = vertices(piece.source_vertex, Eigen::all);
    return piece;
}

}  // namespace

SurfacePiece whole_piece(const Vertices& vertices, const Triangles& triangles)
{
    SurfacePiece piece{vertices, triangles, {}, {}, {}};
    piece.source_vertex = numbers_below(vertices.rows());
    piece.source_face = numbers_below(triangles.rows());
    return piece;
}

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
    // Seams where faces cannot be joined: an edge with more than two faces, faces that disagree, pinched vertices. Then
    // the cuts that make each part a disk or a planar surface.
    Seams seams = seam_faces(vertices, triangles, faces, options.polygon, options.seams);
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
