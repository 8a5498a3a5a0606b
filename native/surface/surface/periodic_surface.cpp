#include "surface/periodic_surface.h"

#include "core/all_elements.h"
#include "core/connectivity.h"
#include "core/counted.h"
#include "core/errors.h"
#include "core/numbering.h"
#include "execution/memory_limit.h"
#include "mesh/loop_with.h"
#include "surface/loop_edges.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

namespace koebe {
namespace {

/// @throws TopologyError genus
void require_genus(const Surface& surface, int genus, const std::string& needs)
{
    if (surface.genus != genus)
        throw TopologyError(TopologyKind::genus,
                            "the surface has " + counted(static_cast<std::size_t>(surface.genus), "handle") + ": " +
                                needs + " (a vertex listed)",
                            {surface.triangles(0, 0)});
}

/// The dual graph: its nodes are the faces and, after them, the boundary loops.
class DualGraph {
public:
    explicit DualGraph(const Surface& surface) : surface_(surface), loop_of_(surface.vertex_count, -1)
    {
        for (std::size_t k = 0; k < surface.loops.size(); ++k)
            for (const Index v : surface.loops[k]) loop_of_[v] = static_cast<Index>(k);
        border_.resize(surface.loops.size());
        for (Index h = 0; h < halfedge_count(); ++h)
            if (surface.twin[h] == no_twin) border_[loop_of_[origin(surface.triangles, h)]].push_back(h);
    }

    Index halfedge_count() const { return static_cast<Index>(surface_.triangles.size()); }
    Index face_count() const { return static_cast<Index>(surface_.triangles.rows()); }
    Index loop_node(std::size_t loop) const { return face_count() + static_cast<Index>(loop); }
    const std::vector<Index>& border(std::size_t loop) const { return border_[loop]; }
    Index across(Index h) const
    {
        const Index twin = surface_.twin[h];
        return twin != no_twin ? face_of(twin) : loop_node(loop_of_[origin(surface_.triangles, h)]);
    }

    /// A step from one node to the next over an edge: from the face of a half-edge, or into it.
    struct Step {
        Index halfedge = -1;
        bool out = true;
    };

    /// For each node the step that leads to it from its neighbour towards the root.
    std::vector<Step> tree(Index root, const std::vector<char>& closed) const
    {
        std::vector<Step> to(static_cast<std::size_t>(face_count()) + border_.size());
        std::vector<char> met(to.size(), 0);
        std::vector<Index> queue{root};
        met[root] = 1;
        const auto visit = [&](Index node, Step step) {
            if (met[node] || closed[step.halfedge]) return;
            met[node] = 1;
            to[node] = step;
            queue.push_back(node);
        };
        for (std::size_t head = 0; head < queue.size(); ++head) {
            const Index node = queue[head];
            if (node < face_count())
                for (Index h = 3 * node; h < 3 * node + 3; ++h) visit(across(h), {h, true});
            else
                for (const Index h : border_[node - face_count()]) visit(face_of(h), {h, false});
        }
        return to;
    }

    /// Adds a step to a form: 1 along the edge that the step crosses from left to right.
    void add(OneForm& form, Step step, double sign) const
    {
        if (!step.out) sign = -sign;
        form[step.halfedge] += sign;
        if (surface_.twin[step.halfedge] != no_twin) form[surface_.twin[step.halfedge]] -= sign;
    }

    /// Adds the path from the root to a node.
    void add_way(OneForm& form, const std::vector<Step>& to, Index node, double sign) const
    {
        while (to[node].halfedge >= 0) {
            const Step step = to[node];
            add(form, step, sign);
            node = step.out ? face_of(step.halfedge) : across(step.halfedge);
        }
    }

private:
    const Surface& surface_;
    std::vector<Index> loop_of_;
    std::vector<std::vector<Index>> border_;  // half-edges of each loop
};

/// 1 for the half-edges of a spanning tree of the vertices.
std::vector<char> vertex_tree(const Surface& surface)
{
    const Index count = static_cast<Index>(surface.triangles.size());
    std::vector<std::vector<Index>> leaving(surface.vertex_count);
    for (Index h = 0; h < count; ++h) leaving[origin(surface.triangles, h)].push_back(h);
    for (Index h = 0; h < count; ++h)  // the last edge of a fan has no half-edge that leaves
        if (surface.twin[h] == no_twin) leaving[target(surface.triangles, h)].push_back(h);
    std::vector<char> in_tree(count, 0), met(surface.vertex_count, 0);
    std::vector<Index> queue{origin(surface.triangles, 0)};
    met[queue.front()] = 1;
    for (std::size_t head = 0; head < queue.size(); ++head)
        for (const Index h : leaving[queue[head]]) {
            const Index a = origin(surface.triangles, h), b = target(surface.triangles, h);
            const Index next = a == queue[head] ? b : a;
            if (met[next]) continue;
            met[next] = 1;
            in_tree[h] = 1;
            if (surface.twin[h] != no_twin) in_tree[surface.twin[h]] = 1;
            queue.push_back(next);
        }
    return in_tree;
}

/// Adds an exact form so that a form vanishes along a loop on which its period is 0.
void make_zero_along(const Surface& surface, const std::vector<Index>& border, const VertexLoop& loop, OneForm& form)
{
    std::vector<Index> halfedge_at(surface.vertex_count, -1);
    for (const Index h : border) halfedge_at[origin(surface.triangles, h)] = h;
    VectorXd raise = VectorXd::Zero(surface.vertex_count);
    double sum = 0.0;
    for (const Index v : loop) {
        raise[v] = -sum;
        sum += form[halfedge_at[v]];
    }
    form += exterior_derivative(surface.triangles, raise);
}

/// Keeps the used vertices, and scales their coordinates to [-1, 1].
PeriodicSurface prepared(const Vertices& vertices, const Triangles& triangles)
{
    validate_arrays(vertices, triangles);
    require_memory_for_faces(triangles.rows());
    PeriodicSurface result;
    const std::vector<char> unused = unused_vertices(triangles, static_cast<Index>(vertices.rows()));
    std::vector<Index> number(vertices.rows(), -1);
    for (Index v = 0; v < static_cast<Index>(vertices.rows()); ++v)
        if (!unused[v]) {
            number[v] = static_cast<Index>(result.original.size());
            result.original.push_back(v);
        }
    Triangles own = triangles;
    for (Index& v : own.reshaped()) v = number[v];
    result.surface = analyze_surface(own, static_cast<Index>(result.original.size()));
    result.vertices = vertices(result.original, Eigen::all);
    const Eigen::RowVector3d low = result.vertices.colwise().minCoeff(), high = result.vertices.colwise().maxCoeff();
    const double extent = (0.5 * high - 0.5 * low).maxCoeff();  // no sum overflows
    if (!(extent > 0.0))
        throw InputError("all vertices lie on one point", ElementKind::vertices, all_elements(result.vertices.rows()));
    result.vertices = (result.vertices.rowwise() - (0.5 * low + 0.5 * high)) / extent;
    return result;
}

/// Sorts the loops by falling length, after the given first loops.
void order_loops(PeriodicSurface& domain, std::vector<std::size_t> first)
{
    const auto& loops = domain.surface.loops;
    std::vector<double> length;
    for (const VertexLoop& loop : loops) length.push_back(loop_edges(domain.vertices, loop).sum());
    std::vector<std::size_t> order = numbers_below<std::size_t>(loops.size());
    std::ranges::stable_sort(order, [&](std::size_t a, std::size_t b) { return length[a] > length[b]; });
    for (const std::size_t k : order)
        if (std::ranges::find(first, k) == first.end()) first.push_back(k);
    for (const std::size_t k : first) {
        domain.loops.push_back(loops[k]);
        domain.edges.push_back(loop_edges(domain.vertices, loops[k]));
    }
}

void take_metric(PeriodicSurface& domain)
{
    domain.metric_shifts = domain.shifts;
    domain.metric = intrinsic_metric(domain.vertices, domain.surface, {}, &domain.metric_shifts);
}

/// The loop with a vertex of the input. For vertex -1 the longest loop other than `taken`.
std::size_t rim_with(const PeriodicSurface& domain, Index vertex, std::size_t taken)
{
    const auto& loops = domain.surface.loops;
    if (vertex >= 0) return loop_with_original(loops, domain.original, vertex);
    std::size_t best = 0;
    double length = -1.0;
    for (std::size_t k = 0; k < loops.size(); ++k)
        if (const double own = loop_edges(domain.vertices, loops[k]).sum(); k != taken && own > length) {
            length = own;
            best = k;
        }
    return best;
}

}  // namespace

std::array<int, 2> PeriodicSurface::shift(Index halfedge) const
{
    std::array<int, 2> result{0, 0};
    for (std::size_t j = 0; j < shifts.size(); ++j) result[j] = static_cast<int>(std::lround(shifts[j][halfedge]));
    return result;
}

VertexLoop PeriodicSurface::named_loop(std::size_t k) const
{
    VertexLoop named = values_at(original, loops[k]);
    std::rotate(named.begin(), std::ranges::min_element(named), named.end());
    return named;
}

std::vector<Index> PeriodicSurface::named_on_loop(std::size_t k, const std::vector<Index>& vertices) const
{
    std::vector<Index> named;
    for (const Index v : loops[k])
        if (std::ranges::binary_search(vertices, v)) named.push_back(original[v]);
    std::ranges::sort(named);
    return named;
}

PeriodicSurface periodic_torus(const Vertices& vertices, const Triangles& triangles)
{
    PeriodicSurface domain = prepared(vertices, triangles);
    const Surface& surface = domain.surface;
    require_genus(surface, 1, "a map to a flat torus needs exactly one");
    order_loops(domain, {});
    // Tree and cotree (Eppstein 2003): on a torus two edges are in neither.
    const DualGraph dual(surface);
    std::vector<char> closed = vertex_tree(surface);
    const auto to = dual.tree(0, closed);
    for (const DualGraph::Step& step : to) {
        if (step.halfedge < 0) continue;
        closed[step.halfedge] = 1;
        if (surface.twin[step.halfedge] != no_twin) closed[surface.twin[step.halfedge]] = 1;
    }
    // Each closes a loop of the dual graph: the form is 1 where an edge crosses it, and 0 along the holes.
    for (Index h = 0; h < dual.halfedge_count(); ++h) {
        if (closed[h] || (surface.twin[h] != no_twin && surface.twin[h] < h)) continue;
        OneForm form = OneForm::Zero(dual.halfedge_count());
        dual.add_way(form, to, face_of(h), 1.0);
        dual.add(form, {h, true}, 1.0);
        dual.add_way(form, to, dual.across(h), -1.0);
        for (std::size_t k = 0; k < surface.loops.size(); ++k)
            make_zero_along(surface, dual.border(k), surface.loops[k], form);
        domain.shifts.push_back(std::move(form));
    }
    // So ordered that the tile lies upright.
    if (wedge_integral(domain.shifts.at(0), domain.shifts.at(1)) < 0.0) std::swap(domain.shifts[0], domain.shifts[1]);
    take_metric(domain);
    return domain;
}

PeriodicSurface periodless_sphere(const Vertices& vertices, const Triangles& triangles)
{
    PeriodicSurface domain = prepared(vertices, triangles);
    require_genus(domain.surface, 0, "a map to the sphere needs a surface without handles");
    order_loops(domain, {});
    return domain;
}

PeriodicSurface periodic_ring(const Vertices& vertices, const Triangles& triangles, Index outer, Index inner)
{
    PeriodicSurface domain = prepared(vertices, triangles);
    const Surface& surface = domain.surface;
    require_genus(surface, 0, "a ring needs a surface without handles");
    if (surface.loops.size() < 2)
        throw TopologyError(TopologyKind::closed,
                            "a ring needs two boundary loops, the surface has " + std::to_string(surface.loops.size()) +
                                " (a face listed)",
                            {0});
    const std::size_t none = surface.loops.size();
    std::size_t first = outer >= 0 || inner < 0 ? rim_with(domain, outer, none) : none;
    const std::size_t second = rim_with(domain, inner, first);
    if (first == none) first = rim_with(domain, outer, second);
    if (first == second)
        throw InputError("the vertices of both rims lie on one loop: a ring needs two different rims",
                         ElementKind::vertices, {outer, inner});
    order_loops(domain, {first, second});
    domain.first_hole = 2;

    // The shift across each half-edge: a closed form that sums up to 1 round the ring, and to 0 round each hole.
    const DualGraph dual(surface);
    OneForm form = OneForm::Zero(dual.halfedge_count());
    const std::vector<char> open(static_cast<std::size_t>(dual.halfedge_count()), 0);
    dual.add_way(form, dual.tree(dual.loop_node(second), open), dual.loop_node(first), 1.0);
    for (std::size_t k = 0; k < surface.loops.size(); ++k)
        if (k != first && k != second) make_zero_along(surface, dual.border(k), surface.loops[k], form);
    domain.shifts.push_back(std::move(form));
    take_metric(domain);
    return domain;
}

}  // namespace koebe
