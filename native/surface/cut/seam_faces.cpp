// seam_faces: the first seams of a mesh.
#include "cut/seam_faces.h"
#include "cut/disjoint_sets.h"
#include "cut/edge_runs.h"

#include "core/length.h"

#include <algorithm>
#include <array>
#include <utility>
#include <vector>

namespace koebe {
namespace {

/// Share of the extent, added to every edge: of paths about equally short, the one with fewer edges is taken.
constexpr double least_length = 1e-9;

class FaceJoiner {
public:
    FaceJoiner(const Vertices& vertices, const Triangles& triangles, const std::vector<Index>& faces,
               const std::vector<Index>& polygon, const std::vector<std::array<Index, 2>>& seams)
        : vertex_count_(static_cast<Index>(vertices.rows()))
    {
        for (const auto& edge : seams) chosen_.emplace_back(std::minmax(edge[0], edge[1]));
        std::ranges::sort(chosen_);
        SeamedMesh& mesh = seams_.mesh;
        mesh.face = faces;
        mesh.corners = triangles(faces, Eigen::all);
        mesh.turned.assign(faces.size(), 0);
        mesh.twin.assign(3 * faces.size(), no_twin);
        mesh.whole.assign(3 * faces.size(), 0);
        polygon_.resize(faces.size());
        for (std::size_t f = 0; f < faces.size(); ++f)
            polygon_[f] = polygon.empty() ? faces[f] : polygon[static_cast<std::size_t>(faces[f])];
    }

    Seams run(const Vertices& vertices)
    {
        pair();
        find_bow_ties();
        orient();
        measure(vertices);
        number_fans(seams_.mesh);
        while (detach_entangled()) number_fans(seams_.mesh);
        join_idle_seams(seams_.mesh);
        return std::move(seams_);
    }

private:
    bool alike(Index g, Index h) const { return origin(seams_.mesh.corners, g) == origin(seams_.mesh.corners, h); }

    void join(Index g, Index h) { seams_.mesh.join(g, h); }

    /// Pairs half-edges, first inside polygons, then over edges with two half-edges left. A polygon that goes round a
    /// hole through a slit meets itself there: inside it, faces are joined as a tree.
    void pair()
    {
        SeamedMesh& mesh = seams_.mesh;
        DisjointSets trees(mesh.face.size());
        for_each_edge(mesh.corners, vertex_count_, [&](std::span<const Index> run) {
            std::vector<Index> left;
            for (std::size_t i = 0; i < run.size(); ++i) {
                for (std::size_t j = i + 1; j < run.size() && mesh.twin[run[i]] == no_twin; ++j)
                    if (mesh.twin[run[j]] == no_twin && !alike(run[i], run[j]) &&
                        polygon_[face_of(run[i])] == polygon_[face_of(run[j])]) {
                        join(run[i], run[j]);
                        if (!trees.join(face_of(run[i]), face_of(run[j]))) continue;
                        mesh.whole[run[i]] = mesh.whole[run[j]] = 1;
                    }
                if (mesh.twin[run[i]] == no_twin) left.push_back(run[i]);
            }
            if (left.size() == 2 && !std::ranges::binary_search(chosen_, ends(left[0]))) join(left[0], left[1]);
            if (left.size() > 2) seams_.crowded.emplace_back(ends(left[0]));
        });
    }

    std::pair<Index, Index> ends(Index h) const
    {
        return std::minmax({origin(seams_.mesh.corners, h), target(seams_.mesh.corners, h)});
    }

    /// Joins corners over all edges, even crowded ones. Fans that are still apart meet in a vertex only.
    void find_bow_ties()
    {
        const Triangles& corners = seams_.mesh.corners;
        const auto count = static_cast<std::size_t>(corners.size());
        DisjointSets fans(count);
        for_each_edge(corners, vertex_count_, [&](std::span<const Index> run) {
            for (const Index h : run.subspan(1)) {
                const Index at = alike(h, run[0]) ? h : next_halfedge(h), to = alike(h, run[0]) ? next_halfedge(h) : h;
                fans.join(run[0], at);
                fans.join(next_halfedge(run[0]), to);
            }
        });
        std::vector<Index> fans_at(vertex_count_, 0);
        for (Index h = 0; h < static_cast<Index>(count); ++h)
            if (fans.find(h) == h) ++fans_at[origin(corners, h)];
        for (Index v = 0; v < vertex_count_; ++v)
            if (fans_at[v] > 1) seams_.bow_ties.push_back(v);
    }

    /// Orients faces breadth first, each polygon as a whole before its neighbours.
    void orient()
    {
        const Index face_count = static_cast<Index>(seams_.mesh.face.size());
        const std::vector<Index>& twin = seams_.mesh.twin;
        std::vector<signed char> side(face_count, -1);
        std::vector<Index> queue, polygon;
        // Faces of one polygon have one side.
        const auto give = [&](Index seed, signed char seed_side) {
            side[seed] = seed_side;
            polygon.assign(1, seed);
            for (std::size_t head = 0; head < polygon.size(); ++head) {
                queue.push_back(polygon[head]);
                for (Index h = 3 * polygon[head]; h < 3 * polygon[head] + 3; ++h)
                    if (seams_.mesh.whole[h] && side[face_of(twin[h])] < 0) {
                        side[face_of(twin[h])] = seed_side;
                        polygon.push_back(face_of(twin[h]));
                    }
            }
        };
        for (Index seed = 0; seed < face_count; ++seed) {
            if (side[seed] >= 0) continue;
            queue.clear();
            give(seed, 0);
            for (std::size_t head = 0; head < queue.size(); ++head)
                for (Index h = 3 * queue[head]; h < 3 * queue[head] + 3; ++h)
                    if (twin[h] != no_twin && side[face_of(twin[h])] < 0)
                        give(face_of(twin[h]), static_cast<signed char>(side[queue[head]] ^ alike(h, twin[h])));
            // The minority turns.
            const auto turned = std::ranges::count_if(queue, [&](Index f) { return side[f] == 1; });
            if (2 * turned > static_cast<std::ptrdiff_t>(queue.size()))
                for (const Index f : queue) side[f] ^= 1;
        }
        cut_disagreeing(side);
        turn(side);
    }

    void cut_disagreeing(const std::vector<signed char>& side)
    {
        SeamedMesh& mesh = seams_.mesh;
        for (Index h = 0; h < mesh.halfedge_count(); ++h) {
            const Index twin = mesh.twin[h];
            if (twin == no_twin || (side[face_of(h)] ^ side[face_of(twin)]) == static_cast<int>(alike(h, twin)))
                continue;
            seams_.disagree.push_back(ends(h));
            mesh.cut(h);
        }
    }

    /// Turned faces get their half-edges in the other order.
    void turn(const std::vector<signed char>& side)
    {
        SeamedMesh& mesh = seams_.mesh;
        const auto renumbered = [&](Index h) { return side[face_of(h)] == 1 ? 3 * face_of(h) + 2 - h % 3 : h; };
        std::vector<Index> twin(mesh.twin.size(), no_twin);
        std::vector<char> whole(mesh.twin.size(), 0);
        for (Index h = 0; h < mesh.halfedge_count(); ++h) {
            if (mesh.twin[h] != no_twin) twin[renumbered(h)] = renumbered(mesh.twin[h]);
            whole[renumbered(h)] = mesh.whole[h];
        }
        mesh.twin = std::move(twin);
        mesh.whole = std::move(whole);
        for (std::size_t f = 0; f < side.size(); ++f)
            if (side[f] == 1) {
                std::swap(mesh.corners(static_cast<Eigen::Index>(f), 1), mesh.corners(static_cast<Eigen::Index>(f), 2));
                mesh.turned[f] = 1;
            }
    }

    void measure(const Vertices& vertices)
    {
        SeamedMesh& mesh = seams_.mesh;
        const double extent = (vertices.colwise().maxCoeff() - vertices.colwise().minCoeff()).maxCoeff();
        const double unit = extent > 0.0 ? extent : 1.0;
        mesh.length.resize(mesh.twin.size());
        for (Index h = 0; h < mesh.halfedge_count(); ++h) {
            const Eigen::RowVector3d edge =
                vertices.row(target(mesh.corners, h)) / unit - vertices.row(origin(mesh.corners, h)) / unit;
            mesh.length[h] = length_of(edge) + least_length;
        }
    }

    /// Two fans may have only one edge between them. A polygon whose inside is a second edge becomes a part of its own.
    bool detach_entangled()
    {
        SeamedMesh& mesh = seams_.mesh;
        std::vector<Index> entangled;
        for_each_edge(mesh.fans, mesh.fan_count, [&](std::span<const Index> run) {
            if (run.size() <= 2) return;
            for (const Index h : run)
                if (mesh.whole[h]) entangled.push_back(polygon_[face_of(h)]);
        });
        std::ranges::sort(entangled);
        bool changed = false;
        for (Index h = 0; h < mesh.halfedge_count(); ++h) {
            if (mesh.twin[h] == no_twin || mesh.whole[h] ||
                !std::ranges::binary_search(entangled, polygon_[face_of(h)]))
                continue;
            seams_.crowded.push_back(ends(h));
            mesh.cut(h);
            changed = true;
        }
        return changed;
    }

    Index vertex_count_;
    std::vector<Index> polygon_;
    std::vector<std::pair<Index, Index>> chosen_;  // seams, ascending
    Seams seams_;
};

}  // namespace

Seams seam_faces(const Vertices& vertices, const Triangles& triangles, const std::vector<Index>& faces,
                 const std::vector<Index>& polygon, const std::vector<std::array<Index, 2>>& seams)
{
    return FaceJoiner(vertices, triangles, faces, polygon, seams).run(vertices);
}

}  // namespace koebe
