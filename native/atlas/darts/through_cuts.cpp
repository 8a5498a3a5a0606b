#include "darts/through_cuts.h"

#include "core/errors.h"
#include "core/numbering.h"
#include "cost/costs.h"
#include "cost/tolerances.h"
#include "cut/edge_graph.h"
#include "darts/darts.h"
#include "darts/tension.h"
#include "even/even_map.h"
#include "mesh/connected_pieces.h"
#include "part_maps/part_mesh.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <set>
#include <utility>

namespace koebe {
namespace {

constexpr std::size_t most_cuts = 6;

/// Sums along the shortest way from a vertex to the boundary, without the vertex itself.
struct WayOut {
    Complex force = 0.0;
    double moment = 0.0;  // of the force apart, about the way's end
    double swept = 0.0;   // twice the area between the way and the origin
    Index end = -1;
};

class ThroughSearch {
public:
    ThroughSearch(const FlatPart& flat, double even, const ThroughPrice& price)
        : flat_(flat),
          price_(price),
          even_(even),
          forces_(forces_in(flat, even)),
          energy_(forces_.energy.sum()),
          tension_(flat, forces_),
          outside_(boundary_mask(flat.surface)),
          mesh_(seamed(flat, flat.shown)),
          ways_(outside_.size()),
          loop_of_(outside_.size(), -1),
          arc_(outside_.size(), 0.0)
    {
        measure_loops();
        measure_ways();
        measure_strain();
    }

    std::vector<ThroughCut> best(const std::vector<CutEnds>& refused) const
    {
        const Index count = static_cast<Index>(flat_.surface.triangles.size());
        std::vector<std::pair<double, Index>> found;  // surplus, half-edge in the middle
        for (Index h = 0; h < count; ++h)
            if (const double surplus = flat_.surface.twin[h] > h && !mesh_.whole[h] ? surplus_of(h) : 0.0;
                surplus > 0.0)
                found.emplace_back(surplus, h);
        std::ranges::stable_sort(found, std::ranges::greater(), [](const auto& one) { return one.first; });
        std::vector<ThroughCut> cuts;
        Taken taken{numbers_below<int>(enclosed_.size()), std::vector<char>(strain_.size(), 0)};
        for (const auto& [surplus, h] : found) {
            ThroughCut cut = path(h);
            cut.forecast = surplus + cut.cost;
            if (std::ranges::any_of(refused, [&](const CutEnds& ends) { return is_near(cut, ends); })) continue;
            if (!fits(cut, h, cuts, taken)) continue;
            cuts.push_back(std::move(cut));
            if (cuts.size() == most_cuts || is_split(cuts.front())) break;
        }
        return cuts;
    }

private:
    /// What the cuts take that are opened together.
    struct Taken {
        std::vector<int> joined;     ///< (loops) the same number for loops that they make one
        std::vector<char> strained;  ///< (regions) 1 where one of them runs
    };

    double swept(Index v, Index w) const
    {
        return flat_.points(v, 0) * flat_.points(w, 1) - flat_.points(v, 1) * flat_.points(w, 0);
    }

    void measure_loops()
    {
        for (const VertexLoop& loop : flat_.surface.loops) {
            double sum = 0.0;
            for (std::size_t i = 0; i < loop.size(); ++i) {
                loop_of_[loop[i]] = static_cast<int>(enclosed_.size());
                arc_[loop[i]] = sum;
                sum += swept(loop[i], loop[(i + 1) % loop.size()]);
            }
            enclosed_.push_back(sum);
            area_ += sum;
        }
    }

    void measure_ways()
    {
        std::vector<Index> rim;
        for (Index v = 0; v < flat_.surface.vertex_count; ++v)
            if (outside_[v]) rim.push_back(v);
        tree_ = shortest_paths(EdgeGraph(mesh_, 1.0), rim);
        for (const Index v : rim) ways_[v].end = v;
        for (const Index v : tree_.order) {
            const Index u = tree_.parent[v];
            if (outside_[v] || u == v) continue;
            const Complex force = tension_.at(u, v, next(u));
            ways_[v] = ways_[u];
            ways_[v].force += force;
            ways_[v].moment += tree_.distance[u] * force.imag();
            ways_[v].swept += swept(v, u);
        }
    }

    /// The regions of faces with much energy, and the energy of each. Where most of the part is one such region, no cut
    /// releases it all.
    void measure_strain()
    {
        const VectorXd areas = face_areas(flat_.vertices, flat_.surface.triangles);
        const std::vector<int> is_strained = strained_faces(forces_.energy, areas);
        Index count = 0;
        region_ = connected_pieces(flat_.surface.twin, is_strained, count);
        strain_.assign(static_cast<std::size_t>(count), 0.0);
        std::vector<double> area(strain_.size(), 0.0);
        for (std::size_t f = 0; f < region_.size(); ++f) {
            if (is_strained[f] == 0) continue;
            strain_[region_[f]] += forces_.energy[static_cast<Eigen::Index>(f)];
            area[region_[f]] += areas[static_cast<Eigen::Index>(f)];
        }
        const double most = tolerance::majority * areas.sum();
        for (std::size_t k = 0; k < strain_.size(); ++k)
            if (area[k] > most) strain_[k] = 0.0;
    }

    /// The more strained of the regions on both sides of an edge.
    Index region_at(Index h) const
    {
        const Index left = region_[face_of(h)], right = region_[face_of(flat_.surface.twin[h])];
        return strain_[right] > strain_[left] ? right : left;
    }

    /// The next vertex on the way to the boundary; -1 there.
    Index next(Index v) const { return outside_[v] ? -1 : tree_.parent[v]; }

    /// The forecast of the path through an edge, without its cost; 0 if there is no path.
    double surplus_of(Index h) const
    {
        const Index a = origin(flat_.surface.triangles, h), b = target(flat_.surface.triangles, h);
        const WayOut &from = ways_[a], &to = ways_[b];
        if (from.end < 0 || to.end < 0 || from.end == to.end || next(a) == b || next(b) == a) return 0.0;
        const double length = tree_.distance[a] + tree_.distance[b] + mesh_.length[h];
        if (length > tuning::longest_through || is_too_small(a, b)) return 0.0;
        const Complex at_a = tension_.at(a, b, next(a)), at_b = tension_.at(b, a, next(b));
        const Complex force = from.force + at_a + at_b + to.force;
        const double moment = from.moment + tree_.distance[a] * at_a.imag() + length * (to.force + at_b).imag() -
                              to.moment - tree_.distance[b] * at_b.imag() - 0.5 * length * force.imag();
        const double released =
            std::max(tuning::released_share * beam_energy(force, moment, length, even_), strain_[region_at(h)]);
        return std::min(released, energy_) - price_.of(length, splits(from.end, to.end));
    }

    /// Whether a cut between two vertices of the boundary makes one more piece: between two loops it does not.
    bool splits(Index from, Index to) const { return loop_of_[from] == loop_of_[to]; }

    /// Whether a cut between two places of one loop would leave too small a piece.
    bool is_too_small(Index a, Index b) const
    {
        const WayOut &from = ways_[a], &to = ways_[b];
        if (loop_of_[from.end] != loop_of_[to.end]) return false;
        double round = swept(a, b) - from.swept + to.swept + arc_[from.end] - arc_[to.end];
        if (arc_[from.end] < arc_[to.end]) round += enclosed_[loop_of_[from.end]];
        return std::min(std::abs(round), std::abs(area_ - round)) < 2.0 * tuning::least_piece;
    }

    ThroughCut path(Index h) const
    {
        ThroughCut cut;
        const auto walk = [&](Index v) {
            for (cut.vertices.push_back(v); !outside_[v]; v = tree_.parent[v]) {
                cut.halfedges.push_back(tree_.halfedge[v]);
                cut.vertices.push_back(tree_.parent[v]);
            }
        };
        walk(origin(flat_.surface.triangles, h));
        std::ranges::reverse(cut.vertices);
        std::ranges::reverse(cut.halfedges);
        cut.halfedges.push_back(h);
        walk(target(flat_.surface.triangles, h));
        for (const Index e : cut.halfedges) cut.length += mesh_.length[e];
        cut.cost = price_.of(cut.length, is_split(cut));
        cut.ends = {flat_.vertices.row(cut.vertices.front()), flat_.vertices.row(cut.vertices.back())};
        return cut;
    }

    bool is_split(const ThroughCut& cut) const { return splits(cut.vertices.front(), cut.vertices.back()); }

    /// Whether a cut can be opened together with these cuts. Cuts between loops close no ring, or they would split the
    /// part. Each strained region has one cut. @param h the edge through which it was found @param taken by the cuts;
    /// if it fits, by this cut too
    bool fits(const ThroughCut& cut, Index h, const std::vector<ThroughCut>& cuts, Taken& taken) const
    {
        const auto are_close = [&](Index v, Index w) {
            return (flat_.vertices.row(v) - flat_.vertices.row(w)).norm() < tuning::dart_spacing;
        };
        for (const ThroughCut& other : cuts)
            for (const Index v : cut.vertices)
                if (std::ranges::any_of(other.vertices, [&](Index w) { return are_close(v, w); })) return false;
        const Index region = region_at(h);
        const bool is_strained = strain_[region] > 0.0;
        if (is_strained && taken.strained[region]) return false;
        const int from = taken.joined[loop_of_[cut.vertices.front()]], to = taken.joined[loop_of_[cut.vertices.back()]];
        if (from == to && !(cuts.empty() && is_split(cut))) return false;
        std::ranges::replace(taken.joined, from, to);
        taken.strained[region] = is_strained;
        return true;
    }

    static bool is_near(const ThroughCut& cut, const CutEnds& other)
    {
        const auto between = [](const auto& a, const auto& b) { return (a - b).norm(); };
        const auto& [from, to] = cut.ends;
        return std::min(std::max(between(from, other.from), between(to, other.to)),
                        std::max(between(from, other.to), between(to, other.from))) < tuning::cut_reach * cut.length;
    }

    const FlatPart& flat_;
    ThroughPrice price_;
    double even_;
    EvenForces forces_;
    double energy_;  // of all faces
    Tension tension_;
    std::vector<char> outside_;  // (V) 1 on the boundary
    SeamedMesh mesh_;
    PathTree tree_;
    std::vector<WayOut> ways_;
    std::vector<Index> region_;     // (F) strained faces that are connected, or others
    std::vector<double> strain_;    // (regions) energy; 0 where faces are not strained
    std::vector<int> loop_of_;      // (V) -1 inside
    std::vector<double> arc_;       // (V) twice the area swept along the loop before the vertex,
    std::vector<double> enclosed_;  // and round each loop
    double area_ = 0.0;             // twice the area of the part in the plane
};

/// The loops of a part before slits and darts were opened, as vertices of the whole. Empty where they meet at a vertex.
std::vector<VertexLoop> closed_loops(const FlatPart& flat)
{
    std::set<std::pair<Index, Index>> edges;
    for (const auto face : flat.surface.triangles.rowwise())
        for (int k = 0; k < 3; ++k) edges.emplace(flat.original[face[k]], flat.original[face[(k + 1) % 3]]);
    std::vector<std::pair<Index, Index>> rim;
    for (const auto& [a, b] : edges)
        if (!edges.contains({b, a})) rim.emplace_back(a, b);
    std::vector<VertexLoop> loops;
    std::vector<char> taken(rim.size(), 0);
    for (std::size_t i = 0; i < rim.size(); ++i) {
        if (i > 0 && rim[i].first == rim[i - 1].first) return {};
        if (taken[i]) continue;
        VertexLoop loop;
        for (std::size_t j = i; !std::exchange(taken[j], 1);) {
            loop.push_back(rim[j].first);
            j = static_cast<std::size_t>(
                std::ranges::lower_bound(rim, rim[j].second, {}, &std::pair<Index, Index>::first) - rim.begin());
            if (j == rim.size()) return {};
        }
        loops.push_back(std::move(loop));
    }
    return loops;
}

void name_loops(FlatPart& flat)
{
    flat.loops = closed_loops(flat);
    if (flat.loops.empty())
        for (const VertexLoop& loop : flat.surface.loops) flat.loops.push_back(values_at(flat.original, loop));
    for (const VertexLoop& loop : flat.loops) {
        const std::set<Index> named(loop.begin(), loop.end());
        flat.rims.emplace_back();
        for (const VertexLoop& rim : flat.surface.loops)
            std::ranges::copy_if(rim, std::back_inserter(flat.rims.back()),
                                 [&](Index v) { return named.contains(flat.original[v]); });
    }
}

/// The part with some of its faces.
std::optional<FlatPart> piece_of(const FlatPart& flat, const std::vector<Index>& faces)
{
    std::vector<Index> own(static_cast<std::size_t>(flat.surface.vertex_count), -1), source;
    Triangles triangles = flat.surface.triangles(faces, Eigen::all);
    for (Index& corner : triangles.reshaped()) {
        Index& number = own[corner];
        if (number < 0) {
            number = static_cast<Index>(source.size());
            source.push_back(corner);
        }
        corner = number;
    }
    auto piece = opened_piece(flat, faces, triangles, source);
    if (!piece || face_areas(piece->vertices, piece->surface.triangles).sum() < tuning::least_piece) return {};
    for (const Index tip : flat.tips)
        if (own[tip] >= 0) piece->tips.push_back(own[tip]);
    return piece;
}

/// The faces on the side of the first face, and the others. Both ascending.
std::array<std::vector<Index>, 2> sides_of(const Surface& surface, const std::vector<Index>& halfedges)
{
    std::vector<char> cut(surface.twin.size(), 0), seen(static_cast<std::size_t>(surface.triangles.rows()), 0);
    for (const Index h : halfedges) cut[h] = cut[surface.twin[h]] = 1;
    std::array<std::vector<Index>, 2> sides{std::vector<Index>{0}};
    seen[0] = 1;
    for (std::size_t i = 0; i < sides[0].size(); ++i)
        for (int k = 0; k < 3; ++k) {
            const Index h = 3 * sides[0][i] + k, twin = surface.twin[h];
            if (twin != no_twin && !cut[h] && !std::exchange(seen[face_of(twin)], 1)) sides[0].push_back(face_of(twin));
        }
    std::ranges::sort(sides[0]);
    for (Index f = 0; f < static_cast<Index>(seen.size()); ++f)
        if (!seen[f]) sides[1].push_back(f);
    return sides;
}

}  // namespace

std::optional<FlatPart> opened_piece(const FlatPart& flat, const std::vector<Index>& faces, const Triangles& triangles,
                                     const std::vector<Index>& source)
{
    FlatPart piece;
    try {
        piece.surface = require_bordered_genus_zero(triangles, static_cast<Index>(source.size()));
    } catch (const TopologyError&) {
        return {};
    }
    piece.faces = values_at(flat.faces, faces);
    piece.polygon = values_at(flat.polygon, faces);
    piece.sizes = values_at(flat.sizes, faces);
    take_vertices(flat, source, piece);
    name_loops(piece);
    return piece;
}

std::vector<ThroughCut> promising_through_cuts(const FlatPart& flat, double even, const ThroughPrice& price,
                                               const std::vector<CutEnds>& refused)
{
    if (is_true_to_size(flat)) return {};
    return ThroughSearch(flat, even, price).best(refused);
}

std::vector<FlatPart> cut_through(const FlatPart& flat, const ThroughCut& cut)
{
    const auto [side, other] = sides_of(flat.surface, cut.halfedges);
    if (other.empty()) {
        FlatPart joined = flat;
        Dart slit{cut.vertices, cut.halfedges};
        for (std::size_t i = 1; i < cut.vertices.size(); ++i)
            slit.length += (flat.vertices.row(cut.vertices[i]) - flat.vertices.row(cut.vertices[i - 1])).norm();
        if (!open_darts(joined, {slit})) return {};
        return {std::move(joined)};
    }
    auto first = piece_of(flat, side), second = piece_of(flat, other);
    if (!first || !second) return {};
    first->slit = flat.slit;  // lengths are summed over all parts
    first->dart_length = flat.dart_length;
    return {std::move(*first), std::move(*second)};
}

}  // namespace koebe
