#include "foldover/convex_polygons.h"

#include "core/counted.h"
#include "core/errors.h"
#include "foldover/foldover_free.h"
#include "foldover/patch_shapes.h"
#include "foldover/repair_effort.h"
#include "planar/planar_predicates.h"
#include "quality/stored_uv.h"

#include <Eigen/Geometry>
#include <Eigen/LU>

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <span>
#include <utility>

namespace koebe {
namespace {

constexpr double least_turn = 1e-6;         // of a corner's triangle, over the polygon's area
constexpr double guard_weight = 0.1;        // of a corner's triangle in the sum; a face has 1
constexpr double stored_loss = 1.5e-7;      // twice the area a face can lose by rounding, over its longest edge, in UVs
constexpr double wanted_height = 0.05;      // of a corner's triangle that is not upright, over its longest edge
constexpr int mend_rings[] = {1, 2, 4, 8};  // of polygons around a concave one
constexpr std::size_t few_steps = 100000;   // allowed effort in steps of a face (repair_effort.h), and 5 for each face

/// Whether each corner turns left, and all corners go round once.
/// @param left (a, b, c) -> whether the corner b turns left
template <class Left>
bool goes_round_convex(std::span<const Complex> points, const Left& left)
{
    const std::size_t n = points.size();
    int changes = 0;  // of the half-plane in which an edge points: two in one turn
    const auto points_down = [](Complex d) { return d.imag() < 0.0 || (d.imag() == 0.0 && d.real() < 0.0); };
    for (std::size_t i = 0; i < n; ++i) {
        const Complex a = points[i], b = points[(i + 1) % n], c = points[(i + 2) % n];
        if (!left(a, b, c)) return false;
        changes += points_down(b - a) != points_down(c - b) ? 1 : 0;
    }
    return changes == 2;
}

bool is_convex_as_stored(std::span<const Complex> uv)
{
    const auto stored = [](Complex z) { return StoredPoint{as_stored(z.real()), as_stored(z.imag())}; };
    return goes_round_convex(
        uv, [&](Complex a, Complex b, Complex c) { return !StoredFace(stored(a), stored(b), stored(c)).doubtful(); });
}

/// Whether a polygon's projection onto the plane of its area vector is convex.
bool is_convex_in_space(std::span<const Eigen::Vector3d> corners)
{
    // In units of the polygon, so that no square over- or underflows.
    std::vector<Eigen::Vector3d> p;
    double unit = 0.0;
    for (const Eigen::Vector3d& corner : corners) {
        p.push_back(0.5 * corner - 0.5 * corners.front());
        unit = std::max(unit, p.back().lpNorm<Eigen::Infinity>());
    }
    if (!(unit > 0.0)) return false;
    for (Eigen::Vector3d& corner : p) corner /= unit;
    Eigen::Vector3d normal = Eigen::Vector3d::Zero();
    for (std::size_t i = 0; i < p.size(); ++i) normal += p[i].cross(p[(i + 1) % p.size()]);
    const double area = normal.norm();  // twice
    if (!(area > 0.0)) return false;
    const Eigen::Vector3d across = normal.unitOrthogonal(), up = (normal / area).cross(across);
    std::vector<Complex> flat;
    for (const Eigen::Vector3d& corner : p) flat.emplace_back(corner.dot(across), corner.dot(up));
    return goes_round_convex(flat,
                             [&](Complex a, Complex b, Complex c) { return cross(b - a, c - a) > least_turn * area; });
}

/// The faces of each polygon of two triangles or more, and the corners along its outline.
class PolygonOutlines {
public:
    explicit PolygonOutlines(const SurfacePolygons& surface) : surface_(surface), turned_(surface.triangles.rows(), 0)
    {
        const std::vector<Index>& polygon = surface.polygon;
        if (polygon.empty()) return;
        if (polygon.size() != turned_.size()) throw InputError("there must be a polygon for each face");
        for (const Index f : surface.turned) turned_[f] = 1;
        std::vector<Index> order(polygon.size());
        std::iota(order.begin(), order.end(), 0);
        if (!std::ranges::is_sorted(polygon)) std::ranges::stable_sort(order, {}, [&](Index f) { return polygon[f]; });
        std::vector<char> out(turned_.size(), 0);
        for (const Index f : surface.left_out) out[f] = 1;
        for (std::size_t begin = 0, end = 0; begin < order.size(); begin = end) {
            while (end < order.size() && polygon[order[end]] == polygon[order[begin]]) ++end;
            const std::span<const Index> faces(order.data() + begin, order.data() + end);
            if (faces.size() > 1 && std::ranges::none_of(faces, [&](Index f) { return out[f] != 0; })) add(faces);
        }
    }

    Index count() const { return static_cast<Index>(face_begin_.size()) - 1; }
    std::span<const Index> faces(Index i) const
    {
        return {faces_.data() + face_begin_[i], faces_.data() + face_begin_[i + 1]};
    }
    /// Half-edges along the outline, each by its first corner 3 f + k; empty if the outline is not one simple loop.
    std::span<const Index> outline(Index i) const
    {
        return {outlines_.data() + outline_begin_[i], outlines_.data() + outline_begin_[i + 1]};
    }
    /// The k-th corner of a face in the map's orientation, as 3 f + k in the input's.
    Index corner(Index face, int k) const { return 3 * face + (turned_[face] != 0 && k > 0 ? 3 - k : k); }
    Index vertex(Index corner) const { return surface_.triangles.data()[corner]; }

    bool convex_in_space(Index i) const
    {
        std::vector<Eigen::Vector3d> corners;
        for (const Index c : outline(i)) corners.push_back(surface_.vertices.row(vertex(c)).transpose());
        return !corners.empty() && is_convex_in_space(corners);
    }

    /// Whether each vertex has one place in the polygon, and all places make a convex polygon.
    bool convex_in(Index i, const PlanarPoints& uv) const
    {
        const std::span<const Index> around = outline(i);
        std::vector<Complex> places;
        for (const Index c : around) places.emplace_back(uv(c, 0), uv(c, 1));
        return !around.empty() && is_convex_as_stored(places) && !torn(i, uv);
    }

    bool torn(Index i, const PlanarPoints& uv) const
    {
        std::vector<std::pair<Index, Index>> corners;
        for (const Index f : faces(i))
            for (Index c = 3 * f; c < 3 * f + 3; ++c) corners.emplace_back(vertex(c), c);
        std::ranges::sort(corners);
        for (std::size_t k = 1; k < corners.size(); ++k)
            if (corners[k].first == corners[k - 1].first &&
                !(uv.row(corners[k].second) == uv.row(corners[k - 1].second)))
                return true;
        return false;
    }

private:
    struct Edge {
        Index from, to, corner;
    };

    void add(std::span<const Index> faces)
    {
        faces_.insert(faces_.end(), faces.begin(), faces.end());
        face_begin_.push_back(faces_.size());
        add_outline(faces);
        outline_begin_.push_back(outlines_.size());
    }

    /// Half-edges without an opposite one in the polygon, in their order round it.
    void add_outline(std::span<const Index> faces)
    {
        edges_.clear();
        for (const Index f : faces)
            for (int k = 0; k < 3; ++k)
                edges_.push_back({vertex(corner(f, k)), vertex(corner(f, (k + 1) % 3)), corner(f, k)});
        const auto ends = [](const Edge& edge) { return std::pair(edge.from, edge.to); };
        std::ranges::sort(edges_, {}, ends);
        outer_.clear();
        for (const Edge& edge : edges_)
            if (!std::ranges::binary_search(edges_, std::pair(edge.to, edge.from), {}, ends)) outer_.push_back(edge);
        if (outer_.size() != faces.size() + 2) return;
        const std::size_t begin = outlines_.size();
        Index at = outer_.front().from;
        do {
            const auto next = std::ranges::equal_range(outer_, at, {}, &Edge::from);
            if (next.size() != 1 || outlines_.size() - begin == outer_.size()) return outlines_.resize(begin);
            outlines_.push_back(next.front().corner);
            at = next.front().to;
        } while (at != outer_.front().from);
        if (outlines_.size() - begin != outer_.size()) outlines_.resize(begin);
    }

    const SurfacePolygons& surface_;
    std::vector<char> turned_;
    std::vector<Index> faces_, outlines_;
    std::vector<std::size_t> face_begin_{0}, outline_begin_{0};
    std::vector<Edge> edges_, outer_;  // of one polygon
};

std::vector<Index> concave_ones(const PolygonOutlines& polygons, const PlanarPoints& uv)
{
    std::vector<Index> found;
    for (Index i = 0; i < polygons.count(); ++i)
        if (!polygons.convex_in(i, uv) && polygons.convex_in_space(i)) found.push_back(i);
    return found;
}

/// The corners of the UVs that are one place, and the polygons around it. A triangle outside all polygons is a cell of
/// its own, as each polygon is.
class UvMesh {
public:
    UvMesh(const SurfacePolygons& surface, const PolygonOutlines& polygons, PlanarPoints& uv)
        : surface_(surface), polygons_(polygons), uv_(uv), node_(static_cast<std::size_t>(3 * surface.triangles.rows()))
    {
        make_cells();
        make_nodes();
        for (Index c = 0; c < static_cast<Index>(node_.size()); ++c) corners_.push_back(c);
        std::ranges::stable_sort(corners_, {}, [&](Index c) { return node_[c]; });
        for (std::size_t i = 0; i < corners_.size(); ++i)
            while (begin_.size() <= static_cast<std::size_t>(node_[corners_[i]])) begin_.push_back(i);
        begin_.push_back(corners_.size());
    }

    Index node(Index corner) const { return node_[corner]; }
    bool held(Index node) const { return held_[node] != 0; }
    /// Whether only two polygons meet at an inner vertex. Their angles there make a full turn, so one is not convex.
    bool between_two(Index corner) const
    {
        const Index node = node_[corner];
        if (held(node) || at_rim_[node] != 0) return false;
        std::array<Index, 2> met{cell(corner), -1};
        for (const Index c : corners(node)) {
            if (cell(c) == met[0] || cell(c) == met[1]) continue;
            if (met[1] >= 0) return false;
            met[1] = cell(c);
        }
        return true;
    }
    Index node_count() const { return static_cast<Index>(held_.size()); }
    std::span<const Index> corners(Index node) const
    {
        return {corners_.data() + begin_[node], corners_.data() + begin_[node + 1]};
    }
    Index cell(Index corner) const { return cell_[corner / 3]; }
    Index cell_count() const { return cell_count_; }
    std::span<const Index> faces(Index cell) const
    {
        return cell < polygons_.count() ? polygons_.faces(cell)
                                        : std::span<const Index>(&single_[cell - polygons_.count()], 1);
    }
    Complex place(Index corner) const { return {uv_(corner, 0), uv_(corner, 1)}; }

private:
    void make_cells()
    {
        cell_.assign(node_.size() / 3, -1);
        for (Index i = 0; i < polygons_.count(); ++i)
            for (const Index f : polygons_.faces(i)) cell_[f] = i;
        for (Index f = 0; f < static_cast<Index>(cell_.size()); ++f)
            if (cell_[f] < 0) {
                cell_[f] = polygons_.count() + static_cast<Index>(single_.size());
                single_.push_back(f);
            }
        cell_count_ = polygons_.count() + static_cast<Index>(single_.size());
    }

    /// Joins the corners over edges whose two sides lie in one place, or differ by a translation if the map is
    /// periodic. A corner at any other edge is held.
    void make_nodes()
    {
        struct Side {
            Index low, high, from, to;  // vertices, and corners of the half-edge
        };
        std::vector<Side> sides;
        for (Index f = 0; f < static_cast<Index>(cell_.size()); ++f)
            for (int k = 0; k < 3; ++k) {
                const Index from = polygons_.corner(f, k), to = polygons_.corner(f, (k + 1) % 3);
                const Index a = polygons_.vertex(from), b = polygons_.vertex(to);
                sides.push_back({std::min(a, b), std::max(a, b), from, to});
            }
        const auto ends = [](const Side& side) { return std::pair(side.low, side.high); };
        std::ranges::stable_sort(sides, {}, ends);
        std::vector<Index> root(node_.size());
        std::iota(root.begin(), root.end(), 0);
        const auto find = [&](Index c) {
            while (root[c] != c) c = root[c] = root[root[c]];
            return c;
        };
        std::vector<char> open(node_.size(), 0);
        for (std::size_t begin = 0, end = 0; begin < sides.size(); begin = end) {
            while (end < sides.size() && ends(sides[end]) == ends(sides[begin])) ++end;
            const Side& one = sides[begin];
            const Side& two = sides[end - 1];
            const bool joined = end - begin == 2 && polygons_.vertex(one.from) == polygons_.vertex(two.to) &&
                                is_same_side(place(two.to) - place(one.from), place(two.from) - place(one.to));
            if (joined) {
                root[find(two.to)] = find(one.from);
                root[find(two.from)] = find(one.to);
            } else {
                for (std::size_t i = begin; i < end; ++i) open[sides[i].from] = open[sides[i].to] = 1;
            }
        }
        std::vector<Index> number(node_.size(), -1);
        for (Index c = 0; c < static_cast<Index>(node_.size()); ++c) {
            Index& own = number[find(c)];
            if (own < 0) {
                own = static_cast<Index>(held_.size());
                held_.push_back(0);
                at_rim_.push_back(0);
            }
            node_[c] = own;
            if (open[c] == 0) continue;
            at_rim_[own] = 1;
            if (!surface_.free_rims) held_[own] = 1;
        }
        if (surface_.held.empty()) return;
        std::vector<char> stays(static_cast<std::size_t>(surface_.vertices.rows()), 0);
        for (const Index v : surface_.held) stays[v] = 1;
        for (Index c = 0; c < static_cast<Index>(node_.size()); ++c)
            if (stays[polygons_.vertex(c)] != 0) held_[node_[c]] = 1;
    }

    bool is_same_side(Complex first, Complex second) const
    {
        return first == second && (surface_.periodic || first == Complex(0.0, 0.0));
    }

    const SurfacePolygons& surface_;
    const PolygonOutlines& polygons_;
    const PlanarPoints& uv_;
    std::vector<Index> cell_, single_;  // (F) cell of each face; faces outside all polygons
    Index cell_count_ = 0;
    std::vector<Index> node_;     // (3F)
    std::vector<char> held_;      // of each node
    std::vector<char> at_rim_;    // of each node: 1 on a loop, or on a side of a cut
    std::vector<Index> corners_;  // by node
    std::vector<std::size_t> begin_;
};

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
        std::vector<Index> all(moving.size());
        std::iota(all.begin(), all.end(), 0);
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
