#include "parts/carried_cuts.h"

#include "core/complex_places.h"
#include "core/connectivity.h"
#include "cut/seamed_mesh.h"
#include "foldover/turn_upright.h"
#include "mesh/nearest_first.h"
#include "part_maps/part_mesh.h"
#include "parts/darts.h"
#include "parts/tension.h"
#include "parts/through_cuts.h"
#include "planar/planar_predicates.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <optional>
#include <unordered_map>
#include <utility>

namespace koebe {
namespace {

constexpr int longest_walk = 1000;      // coarse faces that a walk to the next vertex may cross
constexpr double far_off = 4.0;         // price of an edge as far from a coarse edge as that is long, beside its length
constexpr double longest_detour = 3.0;  // length of a path over the length of its chain
constexpr int shift_sweeps = 30;        // of Gauss-Seidel: about so many rings round a path go with it

/// How much of the distance from coarse edges goes. Paths lie nearer to each other than the boundary's sides.
struct Straightened {
    double paths, rims;
};
constexpr std::array straightened{Straightened{0.7, 0.0}, Straightened{0.9, 0.5}, Straightened{0.97, 0.97},
                                  Straightened{0.995, 0.995}};

/// Half-edges one after the other, in faces on their left.
using Path = std::vector<Index>;

/// A corner of a piece: the piece, and its half-edge from there.
struct PieceCorner {
    std::size_t piece = 0;
    Index halfedge = -1;
};

double edge_length(const FlatPart& part, Index h)
{
    const Triangles& triangles = part.surface.triangles;
    return (part.vertices.row(origin(triangles, h)) - part.vertices.row(target(triangles, h))).norm();
}

double path_length(const FlatPart& part, const Path& path)
{
    double sum = 0.0;
    for (const Index h : path) sum += edge_length(part, h);
    return sum;
}

/// A fine part, its coarse part, and the pieces of both.
class CarriedPart {
public:
    CarriedPart(const FlatPart& fine, const FlatPart& coarse, const std::vector<Index>& vertex)
        : fine_(fine), coarse_(coarse), vertex_(vertex)
    {
        for (std::size_t f = 0; f < coarse.faces.size(); ++f)
            coarse_face_.emplace(coarse.faces[f], static_cast<Index>(f));
    }

    void add(const FlatPart& piece)
    {
        for (std::size_t f = 0; f < piece.faces.size(); ++f)
            coarse_corner_.emplace(coarse_face_.at(piece.faces[f]),
                                   PieceCorner{after_.size(), 3 * static_cast<Index>(f)});
        after_.push_back(&piece);
    }

    /// The chains of edges along which the coarse part was cut, from one fork, tip or place of the boundary to the
    /// next.
    const std::vector<Path>& chains()
    {
        const Triangles& triangles = coarse_.surface.triangles;
        std::vector<std::vector<Index>> leaving(static_cast<std::size_t>(coarse_.surface.vertex_count));
        for (Index h = 0; h < static_cast<Index>(triangles.size()); ++h)
            if (coarse_.surface.twin[h] != no_twin && is_open(h)) leaving[origin(triangles, h)].push_back(h);
        const std::vector<char> outside = boundary_mask(coarse_.surface);
        const auto is_node = [&](Index v) { return outside[v] != 0 || leaving[v].size() != 2; };
        std::vector<char> seen(coarse_.surface.twin.size(), 0);
        for (Index v = 0; v < coarse_.surface.vertex_count; ++v) {
            if (!is_node(v)) continue;
            for (Index h : leaving[v]) {
                if (seen[h]) continue;
                Path chain{h};
                for (Index end = target(triangles, h); !is_node(end); end = target(triangles, h)) {
                    h = leaving[end][leaving[end][0] == coarse_.surface.twin[h] ? 1 : 0];
                    chain.push_back(h);
                }
                for (const Index own : chain) seen[own] = seen[coarse_.surface.twin[own]] = 1;
                chains_.push_back(std::move(chain));
            }
        }
        return chains_;
    }

    /// The vertices of a chain, by the whole, or their images; from the lower end.
    std::vector<Index> name_of(const Path& chain, bool image) const
    {
        const std::vector<Index>& names = image ? coarse_.image : coarse_.original;
        const Triangles& triangles = coarse_.surface.triangles;
        std::vector<Index> name{names[origin(triangles, chain.front())]};
        for (const Index h : chain) name.push_back(names[target(triangles, h)]);
        if (name.front() > name.back()) std::ranges::reverse(name);
        return name;
    }

    /// A short path near a chain, through its vertices.
    std::optional<Path> path_along(const Path& chain)
    {
        prepare();
        const Triangles& triangles = coarse_.surface.triangles;
        Path path;
        std::vector<Index> own{vertex_[origin(triangles, chain.front())]};  // vertices of this path
        for (const Index h : chain) own.push_back(vertex_[target(triangles, h)]);
        std::vector<char> taken = taken_;
        for (const Index v : own) taken[v] = 1;
        for (std::size_t i = 0; i + 1 < own.size(); ++i) {
            std::optional<Path> step = path_between(own[i], own[i + 1], taken, false);
            if (!step && (i == 0 || i + 2 == own.size())) step = path_between(own[i], own[i + 1], taken, true);
            if (!step) return {};
            for (const Index h : *step) taken[target(fine_.surface.triangles, h)] = 1;
            path.insert(path.end(), step->begin(), step->end());
        }
        return path;
    }

    /// The shortest path near the straight line between two vertices. @param taken (V) 1: the path may not touch it
    /// @param anywhere ends on the boundary may be elsewhere on the same loop
    std::optional<Path> path_between(Index from, Index to, const std::vector<char>& taken, bool anywhere) const
    {
        const Triangles& triangles = fine_.surface.triangles;
        const Complex start = complex_at(fine_.points, from), along = complex_at(fine_.points, to) - start;
        NearestFirst nearest(fine_.surface.vertex_count);
        std::unordered_map<Index, Index> last;
        nearest.reach(from, 0.0);
        if (anywhere && loop_of_[from] >= 0 && loop_of_[from] != loop_of_[to])
            for (const Index v : fine_.surface.loops[loop_of_[from]])
                if (!on_path_[v]) nearest.reach(v, 0.0);
        const auto is_end = [&](Index v) {
            return v == to || (anywhere && loop_of_[to] >= 0 && loop_of_[v] == loop_of_[to] &&
                               loop_of_[to] != loop_of_[from] && !on_path_[v]);
        };
        Index end = nearest.take();
        for (Index v = end; v >= 0 && !is_end(v); v = end = nearest.take())
            for (std::size_t i = begin_[v]; i < begin_[v + 1]; ++i) {
                const Index h = leaving_[i], w = target(triangles, h);
                if (taken[w] && !is_end(w)) continue;
                const Complex off = (0.5 * (complex_at(fine_.points, v) + complex_at(fine_.points, w)) - start) / along;
                const double beyond = off.real() - std::clamp(off.real(), 0.0, 1.0);
                const double price = 1.0 + far_off * (off.imag() * off.imag() + beyond * beyond);
                if (nearest.reach(w, nearest.distance()[v] + mesh_.length[h] * price)) last[w] = h;
            }
        if (end < 0) return {};
        Path path;
        for (Index v = end; last.contains(v); v = origin(triangles, last[v])) path.push_back(last[v]);
        std::ranges::reverse(path);
        return path;
    }

    /// The path through these vertices of the whole, if it is free. @param names in either direction
    std::optional<Path> path_through(const Path& chain, std::vector<Index> names)
    {
        prepare();
        if (names.back() == coarse_.original[origin(coarse_.surface.triangles, chain.front())] ||
            names.front() == coarse_.original[target(coarse_.surface.triangles, chain.back())])
            std::ranges::reverse(names);
        const auto number = [&](Index name) {
            const auto found = number_.find(name);
            return found == number_.end() ? -1 : found->second;
        };
        Path path;
        for (std::size_t i = 0; i + 1 < names.size(); ++i) {
            const Index a = number(names[i]), b = number(names[i + 1]);
            if (a < 0 || b < 0 || (i > 0 && taken_[a])) return {};
            const auto begin = leaving_.begin() + static_cast<std::ptrdiff_t>(begin_[a]);
            const auto end = leaving_.begin() + static_cast<std::ptrdiff_t>(begin_[a + 1]);
            const auto found =
                std::find_if(begin, end, [&](Index h) { return target(fine_.surface.triangles, h) == b; });
            if (found == end) return {};
            path.push_back(*found);
        }
        return path;
    }

    std::vector<Index> images_on(const Path& path) const
    {
        std::vector<Index> names{fine_.image[origin(fine_.surface.triangles, path.front())]};
        for (const Index h : path) names.push_back(fine_.image[target(fine_.surface.triangles, h)]);
        return names;
    }

    bool is_roundabout(const Path& chain, const Path& path) const
    {
        return path_length(fine_, path) > longest_detour * path_length(coarse_, chain);
    }

    void take(std::size_t chain, const Path& path)
    {
        for (const Index h : path)
            for (const Index v : {origin(fine_.surface.triangles, h), target(fine_.surface.triangles, h)})
                taken_[v] = on_path_[v] = 1;
        paths_.emplace_back(chain, path);
    }

    /// The fine pieces. They are placed only if they correspond to the coarse pieces: a chain without a path is not
    /// cut.
    /// @return empty if a piece is no surface, or if its cuts cannot be drawn apart
    CarriedParts pieces(const ExecutionContext& context)
    {
        prepare();
        SeamedMesh mesh = mesh_;
        for (const auto& [chain, path] : paths_)
            for (const Index h : path) mesh.cut(h);
        std::vector<FlatPart> pieces;
        std::vector<std::vector<Index>> sources;
        fine_corner_.assign(fine_.faces.size(), {});
        std::vector<std::size_t> coarse_of;  // (pieces) the coarse piece
        bool is_alike = true;                // whether pieces and coarse pieces correspond
        for (const SeamedMesh& own : connected_parts(mesh)) {
            std::vector<Index> source(static_cast<std::size_t>(own.fan_count));
            for (Eigen::Index c = 0; c < own.fans.size(); ++c) source[own.fans.data()[c]] = own.corners.data()[c];
            auto piece = opened_piece(fine_, own.face, own.fans, source);
            if (!piece) return {};
            std::vector<Index> votes(after_.size(), 0);
            for (std::size_t f = 0; f < own.face.size(); ++f) {
                fine_corner_[own.face[f]] = {pieces.size(), 3 * static_cast<Index>(f)};
                if (const auto found = coarse_face_.find(piece->faces[f]); found != coarse_face_.end())
                    ++votes[coarse_corner_.at(found->second).piece];
            }
            const auto most = std::ranges::max_element(votes);
            is_alike = is_alike && *most > 0;
            coarse_of.push_back(static_cast<std::size_t>(most - votes.begin()));
            pieces.push_back(std::move(*piece));
            sources.push_back(std::move(source));
        }
        std::vector<std::size_t> sorted = coarse_of;
        std::ranges::sort(sorted);
        is_alike = is_alike && sorted.size() == after_.size() && std::ranges::adjacent_find(sorted) == sorted.end();
        std::vector<char> placed;
        for (std::size_t k = 0; k < pieces.size(); ++k) {
            note_tips(sources[k], pieces[k]);
            const auto is_placed = [&](const Straightened& straight) {
                return place(pieces[k], k, *after_[coarse_of[k]], straight, sources[k], context);
            };
            placed.push_back(is_alike && std::ranges::any_of(straightened, is_placed));
            if (!placed.back() && !draw_apart(pieces[k], on_paths(pieces[k], sources[k]))) return {};
        }
        if (pieces.size() == 1) pieces.front().kind = fine_.kind;
        note_lengths(pieces.front());
        return {std::move(pieces), std::move(placed)};
    }

private:
    /// A vertex of a fine piece in the relaxed coarse piece.
    struct Place {
        Index face = -1;  ///< of the coarse piece
        Complex at = 0.0;
        Complex shift = 0.0;  ///< in the uncut map, from the path to the chain
        bool on_path = false;
    };

    bool is_open(Index h) const
    {
        const PieceCorner& own = coarse_corner_.at(face_of(h));
        return after_[own.piece]->surface.twin[own.halfedge + h % 3] == no_twin;
    }

    void prepare()
    {
        if (!begin_.empty()) return;
        mesh_ = seamed(fine_, fine_.shown);
        taken_ = boundary_mask(fine_.surface);
        on_path_.assign(taken_.size(), 0);
        loop_of_.assign(taken_.size(), -1);
        for (std::size_t k = 0; k < fine_.surface.loops.size(); ++k)
            for (const Index v : fine_.surface.loops[k]) loop_of_[v] = static_cast<int>(k);
        const auto count = static_cast<std::size_t>(fine_.surface.vertex_count);
        begin_.assign(count + 1, 0);
        const auto may_cut = [&](Index h) { return mesh_.twin[h] != no_twin && !mesh_.whole[h]; };
        for (Index h = 0; h < mesh_.halfedge_count(); ++h)
            if (may_cut(h)) ++begin_[origin(fine_.surface.triangles, h) + 1];
        for (std::size_t v = 0; v < count; ++v) begin_[v + 1] += begin_[v];
        leaving_.resize(begin_.back());
        std::vector<std::size_t> next(begin_.begin(), std::prev(begin_.end()));
        for (Index h = 0; h < mesh_.halfedge_count(); ++h)
            if (may_cut(h)) leaving_[next[origin(fine_.surface.triangles, h)]++] = h;
        for (std::size_t v = 0; v < count; ++v) {
            const auto [at, is_new] = number_.emplace(fine_.original[v], static_cast<Index>(v));
            if (!is_new) at->second = -1;  // two sides of a slit
        }
    }

    /// Both sides of each path, and the boundary: at the same share of each edge's length as on the coarse edge.
    void place_paths(const Straightened& straight)
    {
        pending_.clear();
        for (const auto& [number, path] : paths_) {
            auto from = path.begin();
            for (const Index h : chains_[number]) {
                const Index end = vertex_[target(coarse_.surface.triangles, h)];
                auto next = std::find_if(from, path.end(),
                                         [&](Index own) { return target(fine_.surface.triangles, own) == end; });
                if (next != path.end()) ++next;  // else the path ends elsewhere on the loop
                if (from == next) break;
                place_path({from, next}, h, straight.paths);
                from = next;
            }
        }
        if (straight.rims == 0.0) return;
        std::vector<Index> leaving(static_cast<std::size_t>(fine_.surface.vertex_count), no_twin);
        for (Index h = 0; h < static_cast<Index>(fine_.surface.twin.size()); ++h)
            if (fine_.surface.twin[h] == no_twin) leaving[origin(fine_.surface.triangles, h)] = h;
        for (Index h = 0; h < static_cast<Index>(coarse_.surface.twin.size()); ++h) {
            if (coarse_.surface.twin[h] != no_twin) continue;
            const Index end = vertex_[target(coarse_.surface.triangles, h)];
            Path rim{leaving[vertex_[origin(coarse_.surface.triangles, h)]]};
            while (target(fine_.surface.triangles, rim.back()) != end)
                rim.push_back(leaving[target(fine_.surface.triangles, rim.back())]);
            place_path(rim, h, straight.rims);
        }
    }

    /// Puts the vertices of a path beside one coarse edge, on both sides of it if it has two.
    void place_path(const Path& path, Index coarse, double straight)
    {
        const double whole = path_length(fine_, path);
        double before = 0.0, after = 0.0;  // lengths up to the ends of an edge
        for (const Index h : path) {
            after = h == path.back() ? whole : before + edge_length(fine_, h);
            put(h, coarse, before / whole, straight);
            put(next_halfedge(h), coarse, after / whole, straight);
            if (const Index twin = fine_.surface.twin[h]; twin != no_twin) {
                put(twin, coarse_.surface.twin[coarse], 1.0 - after / whole, straight);
                put(next_halfedge(twin), coarse_.surface.twin[coarse], 1.0 - before / whole, straight);
            }
            before = after;
        }
    }

    /// Puts the vertex where a fine half-edge starts beside a coarse half-edge.
    void put(Index fine, Index coarse, double share, double straight)
    {
        const PieceCorner& here = coarse_corner_.at(face_of(coarse));
        const Triangles& triangles = coarse_.surface.triangles;
        const Complex on_edge = (1.0 - share) * complex_at(coarse_.points, origin(triangles, coarse)) +
                                share * complex_at(coarse_.points, target(triangles, coarse));
        const Complex z = complex_at(fine_.points, origin(fine_.surface.triangles, fine));
        Place place{face_of(here.halfedge), 0.0, straight * (on_edge - z), true};
        const FlatPart& piece = *after_[here.piece];
        place.at = moved(piece, place.face, z + place.shift);
        pending_.push_back({fine_corner_[face_of(fine)], fine % 3, place});
    }

    /// Moves a fine piece to its places in the relaxed coarse piece. @return whether it is one to one there
    bool place(FlatPart& piece, std::size_t k, const FlatPart& relaxed, const Straightened& straight,
               const std::vector<Index>& source, const ExecutionContext& context)
    {
        std::vector<Place> places(static_cast<std::size_t>(piece.surface.vertex_count));
        place_paths(straight);
        const Triangles& triangles = piece.surface.triangles;
        for (const Pending& own : pending_)
            if (own.corner.piece == k) places[triangles.data()[own.corner.halfedge + own.k]] = own.place;
        // Coarse vertices that lie on no path.
        std::unordered_map<Index, Index> vertex_at;  // of the piece, by the fine vertex
        for (std::size_t v = 0; v < source.size(); ++v) vertex_at.emplace(source[v], static_cast<Index>(v));
        std::vector<Index> queue;
        for (Eigen::Index c = 0; c < relaxed.surface.triangles.size(); ++c) {
            const auto found = vertex_at.find(vertex_[coarse_corner_of(relaxed, c)]);
            if (found == vertex_at.end()) continue;
            Place& own = places[found->second];
            if (own.face < 0) own.face = static_cast<Index>(c / 3);
        }
        std::vector<std::vector<Index>> around(places.size());
        for (Index h = 0; h < static_cast<Index>(triangles.size()); ++h) {
            around[origin(triangles, h)].push_back(target(triangles, h));
            if (piece.surface.twin[h] == no_twin) around[target(triangles, h)].push_back(origin(triangles, h));
        }
        spread_shifts(piece, around, places);
        const auto settle = [&](Index v, Index face) {
            Place& own = places[v];
            own.face = face;
            if (!own.on_path) locate(relaxed, complex_at(piece.points, v) + own.shift, own);
            queue.push_back(v);
        };
        for (std::size_t v = 0; v < places.size(); ++v)
            if (places[v].face >= 0) settle(static_cast<Index>(v), places[v].face);
        for (std::size_t i = 0; i < queue.size(); ++i)
            for (const Index w : around[queue[i]])
                if (places[w].face < 0) settle(w, places[queue[i]].face);
        if (queue.size() < places.size()) return false;
        PlanarPoints points(piece.points.rows(), 2);
        for (std::size_t v = 0; v < places.size(); ++v) put_complex(points, static_cast<Eigen::Index>(v), places[v].at);
        const std::vector<char> none(places.size(), 0);
        if (!points.allFinite() ||
            !turn_upright(piece.vertices, triangles, piece.surface.loops, none, points, context) ||
            !lies_one_to_one(piece, points))
            return false;
        piece.points = std::move(points);
        return true;
    }

    /// The coarse part's vertex at a corner of a relaxed coarse piece.
    Index coarse_corner_of(const FlatPart& relaxed, Eigen::Index c) const
    {
        return coarse_.surface.triangles(coarse_face_.at(relaxed.faces[static_cast<std::size_t>(c / 3)]), c % 3);
    }

    /// Vertices near a path go with it, so that they stay on their side of it: as far as their edges are long.
    static void spread_shifts(const FlatPart& piece, const std::vector<std::vector<Index>>& around,
                              std::vector<Place>& places)
    {
        const std::vector<char> outside = boundary_mask(piece.surface);
        std::vector<double> size(places.size(), 0.0);
        for (std::size_t v = 0; v < places.size(); ++v) {
            for (const Index w : around[v])
                size[v] += (piece.points.row(w) - piece.points.row(static_cast<Eigen::Index>(v))).norm();
            size[v] = std::max(size[v] / static_cast<double>(around[v].size()), 1e-300);
        }
        for (int sweep = 0; sweep < shift_sweeps; ++sweep)
            for (std::size_t i = 0; i < places.size(); ++i) {
                const std::size_t v = sweep % 2 == 0 ? i : places.size() - 1 - i;
                if (outside[v]) continue;
                Complex sum = 0.0;
                for (const Index w : around[v]) sum += places[w].shift / size[w];
                places[v].shift = size[v] / static_cast<double>(around[v].size()) * sum;
            }
    }

    /// Walks in a relaxed coarse piece from a face towards a point of the uncut map, and stops at the boundary.
    void locate(const FlatPart& relaxed, Complex z, Place& place) const
    {
        Index face = place.face;
        const auto before = [&](Index h) { return complex_at(coarse_.points, coarse_corner_of(relaxed, h)); };
        for (int step = 0; step < longest_walk; ++step) {
            Index across = no_twin;
            double least = 0.0;
            for (Index h = 3 * face; h < 3 * face + 3; ++h) {
                const Complex a = before(h), b = before(next_halfedge(h));
                const double beside = cross(b - a, z - a) / std::max(distance(a, b), 1e-300);
                if (relaxed.surface.twin[h] == no_twin || !(beside < least)) continue;
                least = beside;
                across = relaxed.surface.twin[h];
            }
            if (across == no_twin) break;
            face = face_of(across);
        }
        place.face = face;
        place.at = moved(relaxed, face, z);
    }

    /// Where a relaxed coarse piece takes a point of the uncut map, by the linear map of one of its faces.
    Complex moved(const FlatPart& relaxed, Index face, Complex z) const
    {
        std::array<Complex, 3> before, after;
        for (Index k = 0; k < 3; ++k) {
            before[k] = complex_at(coarse_.points, coarse_corner_of(relaxed, 3 * face + k));
            after[k] = complex_at(relaxed.points, relaxed.surface.triangles(face, k));
        }
        const double whole = cross(before[1] - before[0], before[2] - before[0]);
        const double b = cross(z - before[0], before[2] - before[0]) / whole;
        const double c = cross(before[1] - before[0], z - before[0]) / whole;
        return after[0] + b * (after[1] - after[0]) + c * (after[2] - after[0]);
    }

    /// (V) 1 for vertices of a piece that lie on a path, but for tips.
    std::vector<char> on_paths(const FlatPart& piece, const std::vector<Index>& source) const
    {
        std::vector<char> on(source.size(), 0), of_fine(static_cast<std::size_t>(fine_.surface.vertex_count), 0);
        for (const auto& [chain, path] : paths_)
            for (const Index h : path)
                of_fine[origin(fine_.surface.triangles, h)] = of_fine[target(fine_.surface.triangles, h)] = 1;
        for (std::size_t v = 0; v < source.size(); ++v) on[v] = of_fine[source[v]];
        for (const Index tip : piece.tips) on[tip] = 0;
        return on;
    }

    void note_tips(const std::vector<Index>& source, FlatPart& piece) const
    {
        std::unordered_map<Index, int> ends;  // of paths, inside
        const std::vector<char> outside = boundary_mask(fine_.surface);
        for (const auto& [chain, path] : paths_)
            for (const Index v :
                 {origin(fine_.surface.triangles, path.front()), target(fine_.surface.triangles, path.back())})
                if (!outside[v]) ++ends[v];
        for (std::size_t v = 0; v < source.size(); ++v)
            if (const auto found = ends.find(source[v]); found != ends.end() && found->second == 1)
                piece.tips.push_back(static_cast<Index>(v));
    }

    /// Lengths of slits and darts, which are summed over the pieces of a part.
    void note_lengths(FlatPart& first) const
    {
        double fine = 0.0, coarse = 0.0;
        for (const auto& [chain, path] : paths_) {
            fine += path_length(fine_, path);
            coarse += path_length(coarse_, chains_[chain]);
        }
        const double share = coarse > 0.0 ? fine / coarse : 1.0;
        first.slit = fine_.slit;
        first.dart_length = fine_.dart_length;
        for (const FlatPart* piece : after_) {
            first.slit += share * piece->slit;
            first.dart_length += share * piece->dart_length;
        }
        first.slit -= share * coarse_.slit;
    }

    struct Pending {
        PieceCorner corner;
        Index k;
        Place place;
    };

    const FlatPart &fine_, &coarse_;
    const std::vector<Index>& vertex_;                      // (V) of the coarse part: the fine vertex
    std::unordered_map<Index, Index> coarse_face_;          // by the face of the whole
    std::unordered_map<Index, PieceCorner> coarse_corner_;  // first corner of each coarse face
    std::vector<PieceCorner> fine_corner_;                  // first corner of each fine face
    std::vector<const FlatPart*> after_;
    std::vector<Path> chains_;
    std::vector<std::pair<std::size_t, Path>> paths_;  // the chain, and its path
    SeamedMesh mesh_;
    std::vector<char> taken_, on_path_;  // (V) of the fine part: on the boundary or on a path
    std::vector<int> loop_of_;           // (V) -1 inside
    std::vector<std::size_t> begin_;
    std::vector<Index> leaving_;               // half-edges that may be cut, by the vertex that they leave
    std::unordered_map<Index, Index> number_;  // of the fine vertex, by the vertex of the whole
    std::vector<Pending> pending_;
};

}  // namespace

CarriedParts carried(const std::vector<FlatPart>& fine, const CoarseParts& before, const std::vector<FlatPart>& after,
                     const ExecutionContext& context)
{
    std::vector<CarriedPart> parts;
    std::unordered_map<Index, std::size_t> part_of;  // by a face of the whole
    for (std::size_t k = 0; k < fine.size(); ++k) {
        parts.emplace_back(fine[k], before.parts[k], before.vertex[k]);
        for (const Index f : before.parts[k].faces) part_of.emplace(f, k);
    }
    for (const FlatPart& piece : after) parts[part_of.at(piece.faces.front())].add(piece);
    std::map<std::vector<Index>, std::vector<Index>> images;  // the image of each path, by the image of its chain
    for (std::size_t k = 0; k < parts.size(); ++k) {
        const std::vector<Path>& chains = parts[k].chains();
        for (std::size_t i = 0; i < chains.size(); ++i) {
            context.checkpoint();
            std::optional<Path> path;
            if (const auto found = images.find(parts[k].name_of(chains[i], false)); found != images.end())
                path = parts[k].path_through(chains[i], found->second);
            if (!path) path = parts[k].path_along(chains[i]);
            if (path && parts[k].is_roundabout(chains[i], *path)) path.reset();
            if (path) {
                parts[k].take(i, *path);
                if (!fine[k].image.empty()) images[parts[k].name_of(chains[i], true)] = parts[k].images_on(*path);
            }
        }
    }
    CarriedParts result;
    for (std::size_t k = 0; k < parts.size(); ++k) {
        CarriedParts own = parts[k].pieces(context);
        if (own.parts.empty()) own = {{fine[k]}, {0}};
        std::ranges::move(own.parts, std::back_inserter(result.parts));
        result.placed.insert(result.placed.end(), own.placed.begin(), own.placed.end());
    }
    return result;
}

}  // namespace koebe
