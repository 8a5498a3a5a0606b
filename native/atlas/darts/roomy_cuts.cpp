#include "darts/roomy_cuts.h"

#include "core/connectivity.h"
#include "core/numbering.h"
#include "core/sort_unique.h"
#include "cost/costs.h"
#include "cut/edge_graph.h"
#include "darts/tension.h"
#include "planar/boundary_crossings.h"
#include "planar/convex_hull.h"
#include "planar/planar_predicates.h"
#include "surface/face_vectors.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <map>
#include <optional>
#include <utility>

namespace koebe {
namespace {

constexpr std::size_t most_corners = 64, most_hole_corners = 12;  // of an outline where ends of cuts are looked for
constexpr double straight = 0.004;    // no corner is nearer to the line between its neighbours, in roots of the area
constexpr double long_side = 0.15;    // longer sides get a corner in their middle
constexpr int square_angles = 32;     // turns in which the smallest square is looked for
constexpr std::size_t most_ways = 3;  // cuts of a part that are tried
constexpr double cosine_of_crease = 0.643;  // of 50 degrees

/// A loop with its most important corners only.
struct Corners {
    std::vector<std::size_t> place;  // in the loop, ascending
    PlanarPoints points;
};

/// Corners that are farthest from the outline so far are added one after the other, then points in long sides.
class CornerSearch {
public:
    CornerSearch(const VertexLoop& loop, const PlanarPoints& points) : at_(points(loop, Eigen::all)) {}

    /// @param ends places in the loop that are corners, too, unless they are more
    Corners find(std::size_t most, const std::vector<std::size_t>& ends = {})
    {
        const Eigen::RowVector2d start = at_.row(0);
        Eigen::Index opposite = 0;
        (at_.rowwise() - start).rowwise().squaredNorm().maxCoeff(&opposite);
        Corners corners{{0, static_cast<std::size_t>(opposite)}, {}};
        std::vector<Span> spans{span(0, corners.place[1]), span(corners.place[1], count())};
        // The point farthest from the outline so far, again and again.
        while (corners.place.size() < most) {
            Span& widest = *std::ranges::max_element(spans, {}, &Span::distance);
            if (!(widest.distance > straight)) break;
            corners.place.push_back(widest.farthest);
            const Span second = span(widest.farthest, widest.to);
            widest = span(widest.from, widest.farthest);
            spans.push_back(second);
        }
        // Then the middles of long sides.
        while (corners.place.size() < most) {
            Span& longest = *std::ranges::max_element(spans, {}, &Span::length);
            const std::size_t middle = middle_of(longest);
            if (!(longest.length > long_side) || middle == longest.from) break;
            corners.place.push_back(middle);
            const Span second = span(middle, longest.to);
            longest = span(longest.from, middle);
            spans.push_back(second);
        }
        // Then the ends that were asked for.
        if (ends.size() <= most) corners.place.insert(corners.place.end(), ends.begin(), ends.end());
        sort_unique(corners.place);
        corners.points.resize(static_cast<Eigen::Index>(corners.place.size()), 2);
        for (std::size_t i = 0; i < corners.place.size(); ++i)
            corners.points.row(static_cast<Eigen::Index>(i)) = at_.row(static_cast<Eigen::Index>(corners.place[i]));
        return corners;
    }

private:
    struct Span {
        std::size_t from = 0, to = 0, farthest = 0;
        double distance = 0.0;  // of the farthest point from the chord
        double length = 0.0;    // of the chord
    };
    std::size_t count() const { return static_cast<std::size_t>(at_.rows()); }
    Complex at(std::size_t i) const
    {
        const auto row = static_cast<Eigen::Index>(i % count());
        return {at_(row, 0), at_(row, 1)};
    }
    Span span(std::size_t from, std::size_t to) const
    {
        const Complex a = at(from), along = at(to) - a;
        Span found{from, to, from, 0.0, std::sqrt(std::norm(along))};
        for (std::size_t i = from + 1; i < to; ++i) {
            const double share = std::norm(along) > 0.0 ? dot(at(i) - a, along) / std::norm(along) : 0.0;
            const double far = distance(at(i), a + std::clamp(share, 0.0, 1.0) * along);
            if (far > found.distance) {
                found.distance = far;
                found.farthest = i;
            }
        }
        return found;
    }
    /// The point of a span that is about as far from one end as from the other; `from` if there is none between.
    std::size_t middle_of(const Span& span) const
    {
        std::size_t middle = span.from;
        double least = std::numeric_limits<double>::infinity();
        for (std::size_t i = span.from + 1; i < span.to; ++i)
            if (const double off = std::abs(distance(at(i), at(span.from)) - distance(at(i), at(span.to)));
                off < least) {
                least = off;
                middle = i;
            }
        return middle;
    }

    PlanarPoints at_;
};

/// A turn of k/square_angles of 90 degrees, nearly, without sines.
Complex turned(int k)
{
    const double t = static_cast<double>(k) / square_angles;
    return Complex(1.0 - t * t, 2.0 * t) / (1.0 + t * t);
}

double area_inside(const PlanarPoints& polygon)
{
    VertexLoop loop = numbers_below(polygon.rows());
    return enclosed_area(loop, polygon);
}

/// The room that an outline needs. @param turns in which it may lie, of 90 degrees
double room_of(const PlanarPoints& polygon, double square, int turns)
{
    const PlanarPoints hull = polygon(convex_hull(polygon), Eigen::all);
    double smallest = std::numeric_limits<double>::infinity();
    for (int k = 0; k < turns; ++k) {
        const Complex turn = turned(k);
        const VectorXd x = turn.real() * hull.col(0) - turn.imag() * hull.col(1);
        const VectorXd y = turn.imag() * hull.col(0) + turn.real() * hull.col(1);
        smallest = std::min(smallest, std::max(x.maxCoeff() - x.minCoeff(), y.maxCoeff() - y.minCoeff()));
        if (smallest * smallest <= square) break;
    }
    return area_inside(hull) + std::max(0.0, smallest * smallest - square);
}

/// The corners from one to the other, going round.
PlanarPoints between(const PlanarPoints& corners, Eigen::Index from, Eigen::Index to)
{
    const Eigen::Index count = corners.rows(), length = (to - from + count) % count + 1;
    PlanarPoints own(length, 2);
    for (Eigen::Index i = 0; i < length; ++i) own.row(i) = corners.row((from + i) % count);
    return own;
}

class RoomSearch {
public:
    RoomSearch(const FlatPart& flat, double square, const ThroughPrice& price)
        : flat_(flat),
          square_(square),
          price_(price),
          loop_(outer_loop(flat)),
          mesh_(priced(flat, price.smooth)),
          outer_(CornerSearch(loop_, flat.points).find(most_corners, ends_of_edges()))
    {
        for (const VertexLoop& loop : flat.surface.loops)
            if (&loop != &loop_) holes_.push_back(CornerSearch(loop, flat.points).find(most_hole_corners).points);
        const bool along_axes = flat.kind == PartKind::tube;
        room_ = room_of(outer_.points, square_, along_axes ? 1 : square_angles);
        saved_at_most_ = room_ - area_inside(outer_.points);
    }

    static const VertexLoop& outer_loop(const FlatPart& flat)
    {
        return *std::ranges::max_element(flat.surface.loops, {},
                                         [&](const VertexLoop& loop) { return enclosed_area(loop, flat.points); });
    }

    /// The cuts along edges that are worth most, with ends apart.
    std::vector<ThroughCut> best() const
    {
        std::vector<ThroughCut> cuts;
        const std::vector<Chord> chords = paying_chords();
        if (chords.empty()) return cuts;
        const EdgeGraph graph(mesh_, tuning::avoided_factor);
        const std::vector<char> outside = boundary_mask(flat_.surface);
        std::map<Eigen::Index, PathTree> trees;
        std::vector<Chord> made;
        for (const Chord& chord : chords) {
            if (std::ranges::any_of(made, [&](const Chord& other) { return share_an_end(chord, other); })) continue;
            auto tree = trees.find(chord.from);
            if (tree == trees.end())
                tree = trees.emplace(chord.from, shortest_paths(graph, {vertex_at(chord.from)})).first;
            auto cut = along_edges(chord, tree->second, outside);
            if (!cut) continue;
            cuts.push_back(std::move(*cut));
            made.push_back(chord);
            if (made.size() == most_ways) break;
        }
        return cuts;
    }

private:
    /// A straight cut between two corners.
    struct Chord {
        Eigen::Index from = 0, to = 0;
        double worth = 0.0;  // gain over cost
    };

    /// The part's edges. A cut over a smooth place shows: there an edge counts as longer.
    static SeamedMesh priced(const FlatPart& flat, double smooth)
    {
        SeamedMesh mesh = seamed(flat, flat.shown);
        if (smooth == 1.0) return mesh;
        const auto normal = [&](Index f) { return twice_area_vector(flat.vertices, flat.surface.triangles, f); };
        for (Index h = 0; h < mesh.halfedge_count(); ++h) {
            if (mesh.whole[h]) continue;
            const Eigen::RowVector3d a = normal(face_of(h)), b = normal(face_of(mesh.twin[h]));
            if (a.dot(b) > cosine_of_crease * a.norm() * b.norm()) mesh.length[h] *= smooth;
        }
        return mesh;
    }

    /// The places in the outer loop where an inner edge ends that may be cut.
    std::vector<std::size_t> ends_of_edges() const
    {
        std::vector<char> is_end(static_cast<std::size_t>(flat_.surface.vertex_count), 0);
        for (Index h = 0; h < mesh_.halfedge_count(); ++h)
            if (!mesh_.whole[h]) is_end[origin(mesh_.fans, h)] = 1;
        std::vector<std::size_t> ends;
        for (std::size_t i = 0; i < loop_.size(); ++i)
            if (is_end[loop_[i]]) ends.push_back(i);
        return ends;
    }
    Complex corner(Eigen::Index i) const
    {
        const Eigen::Index row = (i + outer_.points.rows()) % outer_.points.rows();
        return {outer_.points(row, 0), outer_.points(row, 1)};
    }
    bool is_hollow(Eigen::Index i) const { return cross(corner(i) - corner(i - 1), corner(i + 1) - corner(i)) < 0.0; }

    Index vertex_at(Eigen::Index corner) const { return loop_[outer_.place[static_cast<std::size_t>(corner)]]; }

    /// The chords that pay, first those worth most.
    std::vector<Chord> paying_chords() const
    {
        std::vector<Chord> found;
        const Eigen::Index count = outer_.points.rows();
        const double least = area_inside(outer_.points) - 2.0 * tuning::small_area;
        if (count < 4 || least < 0.0 || room_gain(saved_at_most_) < price_.of(0.0, true)) return found;
        const bool is_long = room_ > area_inside(outer_.points(convex_hull(outer_.points), Eigen::all));
        for (Eigen::Index i = 0; i < count; ++i)
            for (Eigen::Index j = i + 2; j < count; ++j) {
                if (!is_long && !is_hollow(i) && !is_hollow(j)) continue;
                const double cost = price_.of(distance(corner(i), corner(j)), true);
                if (room_gain(saved_at_most_) < cost || !is_inside(i, j)) continue;
                const double gain = room_gain(saved(between(outer_.points, i, j), between(outer_.points, j, i)));
                if (gain > cost) found.push_back({i, j, gain / cost});
            }
        std::ranges::stable_sort(found, std::ranges::greater(), &Chord::worth);
        return found;
    }

    static bool share_an_end(const Chord& a, const Chord& b)
    {
        return a.from == b.from || a.from == b.to || a.to == b.from || a.to == b.to;
    }

    /// The room that two pieces save; less than 0 if a piece is too small.
    double saved(const PlanarPoints& one, const PlanarPoints& other) const
    {
        if (std::min(area_inside(one), area_inside(other)) < tuning::small_area) return -1.0;
        return room_ - room_of(one, square_, square_angles) - room_of(other, square_, square_angles);
    }

    /// Whether the chord lies inside the part.
    bool is_inside(Eigen::Index i, Eigen::Index j) const
    {
        const Eigen::Index count = outer_.points.rows();
        if (i == 0 && j + 1 == count) return false;
        const Complex a = corner(i), b = corner(j), before = corner(i - 1) - a, after = corner(i + 1) - a, way = b - a;
        const bool left = cross(after, way) > 0.0, right = cross(way, before) > 0.0;
        if (is_hollow(i) ? !(left || right) : !(left && right)) return false;
        for (Eigen::Index k = 0; k < count; ++k) {
            const Eigen::Index next = (k + 1) % count;
            if (k != i && k != j && next != i && next != j && segments_meet(a, b, corner(k), corner(next)))
                return false;
        }
        return std::ranges::none_of(holes_, [&](const PlanarPoints& hole) {
            for (Eigen::Index k = 0; k < hole.rows(); ++k) {
                const Eigen::Index next = (k + 1) % hole.rows();
                if (segments_meet(a, b, {hole(k, 0), hole(k, 1)}, {hole(next, 0), hole(next, 1)})) return true;
            }
            return false;
        });
    }

    /// The shortest path between the chord's ends, if it pays.
    std::optional<ThroughCut> along_edges(const Chord& chord, const PathTree& tree,
                                          const std::vector<char>& outside) const
    {
        const std::size_t i = outer_.place[static_cast<std::size_t>(chord.from)];
        const std::size_t j = outer_.place[static_cast<std::size_t>(chord.to)];
        ThroughCut cut;
        for (Index v = loop_[j]; v != loop_[i]; v = tree.parent[v]) {
            if (tree.parent[v] == v || (v != loop_[j] && outside[v])) return {};
            cut.vertices.push_back(v);
            cut.halfedges.push_back(tree.halfedge[v]);
            cut.length += mesh_.length[tree.halfedge[v]];
        }
        cut.vertices.push_back(loop_[i]);
        VertexLoop one(loop_.begin() + static_cast<std::ptrdiff_t>(i), loop_.begin() + static_cast<std::ptrdiff_t>(j));
        VertexLoop other(loop_.begin() + static_cast<std::ptrdiff_t>(j), loop_.end());
        other.insert(other.end(), loop_.begin(), loop_.begin() + static_cast<std::ptrdiff_t>(i));
        one.insert(one.end(), cut.vertices.begin(), cut.vertices.end() - 1);
        other.insert(other.end(), cut.vertices.rbegin(), cut.vertices.rend() - 1);
        cut.forecast = room_gain(saved(flat_.points(one, Eigen::all), flat_.points(other, Eigen::all)));
        cut.cost = price_.of(cut.length, true);
        if (cut.forecast > cut.cost) return cut;
        return {};
    }

    const FlatPart& flat_;
    double square_;
    ThroughPrice price_;
    const VertexLoop& loop_;
    SeamedMesh mesh_;
    Corners outer_;
    std::vector<PlanarPoints> holes_;
    double room_ = 0.0, saved_at_most_ = 0.0;
};

}  // namespace

double square_for_all(const std::vector<const FlatPart*>& parts)
{
    double sum = 0.0;
    for (const FlatPart* flat : parts) {
        const VertexLoop& loop = RoomSearch::outer_loop(*flat);
        const PlanarPoints outline = flat->points(loop, Eigen::all);
        sum += area_inside(outline(convex_hull(outline), Eigen::all));
    }
    return std::max(sum, tuning::least_square);
}

std::vector<ThroughCut> roomy_cuts(const FlatPart& flat, double square, const ThroughPrice& price)
{
    if (!flat.one_to_one || face_areas(flat.vertices, flat.surface.triangles).sum() < 2.0 * tuning::small_area)
        return {};
    return RoomSearch(flat, square, price).best();
}

}  // namespace koebe
