#include "foldover/convex_polygons.h"

#include "core/counted.h"
#include "core/numbering.h"
#include "foldover/foldover_free.h"
#include "foldover/patch_shapes.h"
#include "foldover/polygon_outlines.h"
#include "foldover/repair_effort.h"
#include "foldover/uv_mesh.h"
#include "planar/planar_predicates.h"
#include "quality/stored_uv.h"

#include <Eigen/LU>

#include <algorithm>
#include <array>
#include <cmath>
#include <span>
#include <utility>

namespace koebe {
namespace {

constexpr double guard_weight = 0.1;        // of a corner's triangle in the sum; a face has 1
constexpr double stored_loss = 1.5e-7;      // twice the area a face can lose by rounding, over its longest edge, in UVs
constexpr double wanted_height = 0.05;      // of a corner's triangle that is not upright, over its longest edge
constexpr int mend_rings[] = {1, 2, 4, 8};  // of polygons around a concave one
constexpr std::size_t few_steps = 100000;   // allowed effort in steps of a face (repair_effort.h), and 5 for each face

std::vector<Index> concave_ones(const PolygonOutlines& polygons, const PlanarPoints& uv)
{
    std::vector<Index> found;
    for (Index i = 0; i < polygons.count(); ++i)
        if (!polygons.convex_in(i, uv) && polygons.convex_in_space(i)) found.push_back(i);
    return found;
}

class PolygonMender {
public:
    PolygonMender(const SurfacePolygons& surface, const PolygonOutlines& polygons, PlanarPoints& uv,
                  const ExecutionContext& context)
        : surface_(surface),
          polygons_(polygons),
          uv_(uv),
          context_(context),
          mesh_(surface, polygons, uv),
          effort_(surface.triangles.rows(), few_steps),
          shift_(static_cast<std::size_t>(mesh_.cell_count())),
          taken_(shift_.size(), 0),
          local_of_(static_cast<std::size_t>(mesh_.node_count()), -1),
          convex_in_space_(static_cast<std::size_t>(polygons.count()), unknown)
    {
        effort_.set_limit(few_steps + 5 * static_cast<std::size_t>(surface.triangles.rows()));
    }

    bool mend(std::vector<Index> concave)
    {
        bool moved = false;
        for (const int rings : mend_rings)
            for (const bool gentle : {true, false})
                for (bool fewer = true; fewer; moved = moved || fewer) {
                    std::erase_if(concave, [&](Index i) { return is_convex(i) || !may_become_convex(i); });
                    fewer = mend_clusters(concave, rings, gentle);
                }
        return moved;
    }

private:
    static constexpr char unknown = 2;

    bool is_convex(Index i) const { return polygons_.convex_in(i, uv_); }

    bool convex_in_space(Index i)
    {
        if (convex_in_space_[i] == unknown) convex_in_space_[i] = polygons_.convex_in_space(i) ? 1 : 0;
        return convex_in_space_[i] != 0;
    }

    bool upright(Index a, Index b, Index c) const
    {
        const auto stored = [&](Index corner) {
            return StoredPoint{as_stored(uv_(corner, 0)), as_stored(uv_(corner, 1))};
        };
        return !StoredFace(stored(a), stored(b), stored(c)).doubtful();
    }

    bool face_upright(Index f) const
    {
        return upright(polygons_.corner(f, 0), polygons_.corner(f, 1), polygons_.corner(f, 2));
    }

    /// False if the polygon is too small to be drawn, or a corner cannot turn left: it and its neighbours stay in
    /// place, or only one more polygon meets there.
    bool may_become_convex(Index i) const
    {
        const std::span<const Index> around = polygons_.outline(i);
        const std::size_t n = around.size();
        double longest = 0.0;
        for (std::size_t k = 0; k < n; ++k) {
            longest = std::max(longest, std::abs(mesh_.place(around[k]) - mesh_.place(around[(k + 1) % n])));
            const std::array<Index, 3> c{around[k], around[(k + 1) % n], around[(k + 2) % n]};
            const bool stays = std::ranges::all_of(c, [&](Index own) { return mesh_.held(mesh_.node(own)); });
            if ((stays || mesh_.between_two(c[1])) && !upright(c[0], c[1], c[2])) return false;
        }
        return longest >= uv_resolution && !polygons_.torn(i, uv_);
    }

    /// Mends the neighbourhoods of concave polygons, touching ones together. @return whether any has fewer of them now
    bool mend_clusters(const std::vector<Index>& concave, int rings, bool gentle)
    {
        std::vector<char> waits(taken_.size(), 0);
        for (const Index i : concave) waits[i] = 1;
        bool fewer = false;
        for (const Index first : concave) {
            context_.checkpoint();
            if (waits[first] == 0) continue;
            std::vector<Index> cells{first};
            taken_[first] = 1;
            shift_[first] = 0.0;
            for (std::size_t i = 0; i < cells.size(); ++i)
                add_touching(cells[i], cells, [&](Index cell) { return waits[cell] != 0; });
            for (const Index cell : cells) waits[cell] = 0;
            std::size_t begin = 0;
            for (int ring = 0; ring < rings; ++ring)
                for (const std::size_t end = cells.size(); begin < end; ++begin)
                    add_touching(cells[begin], cells, [](Index) { return true; });
            fewer = mend_patch(cells, gentle) || fewer;
        }
        return fewer;
    }

    /// Adds the cells that have a node in common with a cell, and shifts that bring them beside it.
    template <class Wanted>
    void add_touching(Index cell, std::vector<Index>& cells, const Wanted& wanted)
    {
        for (const Index f : mesh_.faces(cell))
            for (Index c = 3 * f; c < 3 * f + 3; ++c)
                for (const Index other : mesh_.corners(mesh_.node(c))) {
                    const Index next = mesh_.cell(other);
                    if (taken_[next] != 0 || !wanted(next)) continue;
                    taken_[next] = 1;
                    shift_[next] = shift_[cell] + mesh_.place(c) - mesh_.place(other);
                    cells.push_back(next);
                }
    }

    /// A patch as a problem, and what it was before.
    struct Patch {
        std::vector<Index> nodes;
        FoldoverProblem problem;
        Vertices vertices;
        std::vector<std::array<Index, 3>> triangles;  // of local numbers: the faces, then the guards
        std::vector<char> concave;                    // of each triangle: whether its polygon is concave
        std::size_t faces = 0;
        bool wraps = false;  // round a period
    };

    /// The local number of a corner's node.
    Index local(Index corner, Patch& patch)
    {
        const Index node = mesh_.node(corner);
        const Complex at = mesh_.place(corner) + shift_[mesh_.cell(corner)];
        if (local_of_[node] < 0) {
            local_of_[node] = static_cast<Index>(patch.nodes.size());
            patch.nodes.push_back(node);
            places_.push_back(at);
        } else if (places_[local_of_[node]] != at) {
            patch.wraps = true;
        }
        return local_of_[node];
    }

    void add_triangle(std::array<Index, 3> corners, bool concave, Patch& patch)
    {
        std::array<Index, 3> own{};
        for (int k = 0; k < 3; ++k) own[k] = local(corners[k], patch);
        patch.triangles.push_back(own);
        patch.concave.push_back(concave ? 1 : 0);
    }

    Patch patch_of(const std::vector<Index>& cells)
    {
        Patch patch;
        places_.clear();
        for (const Index cell : cells) {
            const bool concave = cell < polygons_.count() && convex_in_space(cell) && !is_convex(cell);
            for (const Index f : mesh_.faces(cell))
                add_triangle({polygons_.corner(f, 0), polygons_.corner(f, 1), polygons_.corner(f, 2)}, concave, patch);
        }
        patch.faces = patch.triangles.size();
        for (const Index cell : cells) {
            if (cell >= polygons_.count() || !convex_in_space(cell) || polygons_.torn(cell, uv_)) continue;
            const bool concave = !is_convex(cell);
            const std::span<const Index> around = polygons_.outline(cell);
            for (std::size_t k = 0; k < around.size(); ++k) {
                const std::array<Index, 3> c{around[k], around[(k + 1) % around.size()],
                                             around[(k + 2) % around.size()]};
                if (!mesh_.between_two(c[1])) add_triangle(c, concave, patch);
            }
        }
        // The nodes whose cells all belong to the patch are free.
        FoldoverProblem& problem = patch.problem;
        problem.points.resize(static_cast<Eigen::Index>(patch.nodes.size()), 2);
        patch.vertices.resize(problem.points.rows(), 3);
        for (std::size_t i = 0; i < patch.nodes.size(); ++i) {
            const std::span<const Index> corners = mesh_.corners(patch.nodes[i]);
            problem.points.row(static_cast<Eigen::Index>(i)) << places_[i].real(), places_[i].imag();
            patch.vertices.row(static_cast<Eigen::Index>(i)) = surface_.vertices.row(polygons_.vertex(corners[0]));
            const bool free = !mesh_.held(patch.nodes[i]) &&
                              std::ranges::all_of(corners, [&](Index c) { return taken_[mesh_.cell(c)] != 0; });
            problem.mobility.push_back(free ? FoldoverProblem::Mobility::free : FoldoverProblem::Mobility::held);
        }
        if (std::ranges::count(problem.mobility, FoldoverProblem::Mobility::held) ==
            0)  // then it may not turn as a whole
            problem.mobility.front() = problem.mobility.back() = FoldoverProblem::Mobility::held;
        for (const Index node : patch.nodes) local_of_[node] = -1;
        return patch;
    }

    /// Two edges of a low triangle over the longest edge.
    static Eigen::Matrix2d low_triangle(const std::array<Eigen::Vector2d, 3>& corners)
    {
        const auto edge = [&](int k) { return Eigen::Vector2d(corners[(k + 1) % 3] - corners[k]); };
        int base = 0;
        for (int k = 1; k < 3; ++k)
            if (edge(k).squaredNorm() > edge(base).squaredNorm()) base = k;
        const Eigen::Vector2d along = edge(base);
        const double share = std::clamp(-edge((base + 2) % 3).dot(along) / along.squaredNorm(), 0.1, 0.9);
        std::array<Eigen::Vector2d, 3> low = corners;
        low[(base + 2) % 3] = corners[base] + share * along + wanted_height * Eigen::Vector2d(-along[1], along[0]);
        Eigen::Matrix2d edges;
        edges << low[1] - low[0], low[2] - low[0];
        return edges;
    }

    /// Adds the triangles that can move. A triangle that is upright wants to keep its shape. If gentle, the others want
    /// to be low; else all triangles of concave polygons want their shapes on the surface.
    static void pose(Patch& patch, bool gentle)
    {
        FoldoverProblem& problem = patch.problem;
        std::vector<Index> moving;
        for (std::size_t t = 0; t < patch.triangles.size(); ++t)
            if (std::ranges::any_of(patch.triangles[t],
                                    [&](Index v) { return problem.mobility[v] == FoldoverProblem::Mobility::free; }))
                moving.push_back(static_cast<Index>(t));
        problem.triangles.resize(static_cast<Eigen::Index>(moving.size()), 3);
        for (std::size_t i = 0; i < moving.size(); ++i)
            for (int k = 0; k < 3; ++k)
                problem.triangles(static_cast<Eigen::Index>(i), k) = patch.triangles[moving[i]][k];
        std::vector<Index> all = numbers_below(moving.size());
        const PatchShapes wanted =
            patch_shapes(patch.vertices, problem.triangles, problem.points, all, PatchShape::surface);
        problem.reference = wanted.references;
        problem.floor.resize(problem.triangles.rows());
        problem.weight.resize(problem.triangles.rows());
        for (std::size_t i = 0; i < moving.size(); ++i) {
            std::array<Eigen::Vector2d, 3> corners;
            double longest = 0.0;
            for (int k = 0; k < 3; ++k) corners[k] = problem.points.row(patch.triangles[moving[i]][k]).transpose();
            for (int k = 0; k < 3; ++k) longest = std::max(longest, (corners[k] - corners[(k + 1) % 3]).norm());
            Eigen::Matrix2d now;
            now << corners[1] - corners[0], corners[2] - corners[0];
            const bool upright = now.determinant() > 2.0 * stored_loss * longest;
            if (upright && (gentle || patch.concave[moving[i]] == 0))
                problem.reference[i] = now;
            else if (gentle && longest > 0.0)
                problem.reference[i] = low_triangle(corners);
            const double area = problem.reference[i].determinant();  // twice, of the wanted shape
            const double floor = stored_loss * std::max(longest, std::sqrt(area)) / area;
            problem.floor[static_cast<Eigen::Index>(i)] =
                upright ? std::min(floor, 0.5 * now.determinant() / area) : floor;
            problem.weight[static_cast<Eigen::Index>(i)] =
                static_cast<std::size_t>(moving[i]) < patch.faces ? 1.0 : guard_weight;
        }
    }

    std::size_t count_concave(const std::vector<Index>& cells)
    {
        return static_cast<std::size_t>(std::ranges::count_if(
            cells, [&](Index cell) { return cell < polygons_.count() && !is_convex(cell) && convex_in_space(cell); }));
    }

    /// @return whether the cells have fewer concave polygons now
    bool mend_patch(const std::vector<Index>& cells, bool gentle)
    {
        Patch patch = patch_of(cells);
        for (const Index cell : cells) taken_[cell] = 0;
        if (patch.wraps || !patch.problem.points.allFinite()) return false;
        const PlanarPoints before = patch.problem.points;
        pose(patch, gentle);
        const Eigen::Index size = patch.problem.triangles.rows();
        const int affordable = size > 0 ? effort_.affordable(size) : 0;
        if (affordable == 0) return false;
        effort_.spend(size, minimize_foldover_free(patch.problem, context_, {.max_iterations = affordable}).iterations);
        if (!patch.problem.points.allFinite()) return false;

        const std::size_t concave = count_concave(cells);
        std::vector<Index> upright;
        for (const Index cell : cells)
            for (const Index f : mesh_.faces(cell))
                if (face_upright(f)) upright.push_back(f);
        move(patch, patch.problem.points - before);
        if (count_concave(cells) < concave && std::ranges::all_of(upright, [&](Index f) { return face_upright(f); }))
            return true;
        for (const auto& [corner, place] : undo_) uv_.row(corner) = place;
        return false;
    }

    /// Moves the free nodes. On a grid both sides of a cut move alike.
    void move(const Patch& patch, const PlanarPoints& steps)
    {
        constexpr double grid = 16777216.0;  // 2^24: tiles/tile.h
        undo_.clear();
        for (std::size_t i = 0; i < patch.nodes.size(); ++i) {
            if (patch.problem.mobility[i] != FoldoverProblem::Mobility::free) continue;
            Eigen::RowVector2d step = steps.row(static_cast<Eigen::Index>(i));
            if (surface_.periodic) step = (step * grid).array().round() / grid;
            const std::span<const Index> corners = mesh_.corners(patch.nodes[i]);
            for (const Index c : corners) {
                undo_.emplace_back(c, uv_.row(c));
                uv_.row(c) += step;
            }
        }
    }

    const SurfacePolygons& surface_;
    const PolygonOutlines& polygons_;
    PlanarPoints& uv_;
    const ExecutionContext& context_;
    UvMesh mesh_;
    RepairEffort effort_;
    std::vector<Complex> shift_;         // of each cell in a patch
    std::vector<char> taken_;            // 1: cells of the patch
    std::vector<Index> local_of_;        // of each node
    std::vector<Complex> places_;        // of the patch's nodes
    std::vector<char> convex_in_space_;  // of each polygon: 0, 1 or unknown
    std::vector<std::pair<Index, Eigen::RowVector2d>> undo_;
};

}  // namespace

std::vector<Index> concave_polygons(const SurfacePolygons& surface, const PlanarPoints& uv)
{
    const PolygonOutlines polygons(surface);
    std::vector<Index> faces;
    for (const Index i : concave_ones(polygons, uv)) faces.push_back(std::ranges::min(polygons.faces(i)));
    std::ranges::sort(faces);
    return faces;
}

bool mend_polygons(const SurfacePolygons& surface, PlanarPoints& uv, const ExecutionContext& context)
{
    const PolygonOutlines polygons(surface);
    std::vector<Index> concave = concave_ones(polygons, uv);
    return !concave.empty() && PolygonMender(surface, polygons, uv, context).mend(std::move(concave));
}

void warn_concave_polygons(const SurfacePolygons& surface, const PlanarPoints& uv, std::vector<Warning>& warnings)
{
    std::vector<Index> concave = concave_polygons(surface, uv);
    if (concave.empty()) return;
    std::string sentence = counted(concave.size(), "polygon") +
                           " convex on the surface, but not in the UVs: cut along other diagonals, they have flipped "
                           "triangles";
    warnings.push_back({WarningKind::concave_polygons, std::move(sentence), std::move(concave)});
}

PlanarPoints disk_corner_uvs(const Triangles& triangles, const PlanarPoints& points)
{
    PlanarPoints uv(triangles.size(), 2);
    for (Eigen::Index c = 0; c < triangles.size(); ++c)
        uv.row(c) = 0.5 * (1.0 + points.row(triangles.data()[c]).array());
    return uv;
}

bool mend_disk_polygons(const SurfacePolygons& surface, PlanarPoints& points, const ExecutionContext& context)
{
    if (surface.polygon.empty()) return false;
    const PlanarPoints before = disk_corner_uvs(surface.triangles, points);
    PlanarPoints uv = before;
    if (!mend_polygons(surface, uv, context)) return false;
    for (Eigen::Index c = 0; c < uv.rows(); ++c)
        if (uv.row(c) != before.row(c)) points.row(surface.triangles.data()[c]) = 2.0 * uv.row(c).array() - 1.0;
    return true;
}

}  // namespace koebe
