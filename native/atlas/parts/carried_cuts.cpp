#include "parts/carried_cuts.h"

#include "core/complex_places.h"
#include "core/connectivity.h"
#include "cut/seamed_mesh.h"
#include "foldover/turn_upright.h"
#include "part_maps/part_mesh.h"
#include "parts/carried_paths.h"
#include "parts/dart_rounds.h"
#include "parts/darts.h"
#include "parts/tension.h"
#include "parts/through_cuts.h"
#include "planar/planar_predicates.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <unordered_map>
#include <utility>

namespace koebe {
namespace {

constexpr int longest_walk = 1000;  // coarse faces that a walk to the next vertex may cross
constexpr int shift_sweeps = 30;    // of Gauss-Seidel: about so many rings round a path go with it

/// How much of the distance from coarse edges goes. Paths lie nearer to each other than the boundary's sides.
struct Straightened {
    double paths, rims;
};
constexpr std::array straightened{Straightened{0.7, 0.0}, Straightened{0.9, 0.5}, Straightened{0.97, 0.97},
                                  Straightened{0.995, 0.995}};

/// The pieces of a fine part, cut along paths.
class CarriedPieces {
public:
    CarriedPieces(const FlatPart& fine, const CutCoarsePart& cut, const std::vector<Index>& vertex,
                  std::vector<CarriedPath> paths)
        : fine_(fine), coarse_(cut.uncut()), cut_(cut), vertex_(vertex), paths_(std::move(paths))
    {
    }

    /// The fine pieces. They are placed only if they correspond to the coarse pieces: a chain without a path is not
    /// cut.
    /// @return empty if a piece is no surface, or if its cuts cannot be drawn apart
    CarriedParts pieces(const ExecutionContext& context)
    {
        SeamedMesh mesh = seamed(fine_, fine_.shown);
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
            std::vector<Index> votes(cut_.pieces().size(), 0);
            for (std::size_t f = 0; f < own.face.size(); ++f) {
                fine_corner_[own.face[f]] = {pieces.size(), 3 * static_cast<Index>(f)};
                if (const Index face = cut_.face_of_whole(piece->faces[f]); face >= 0)
                    ++votes[cut_.place_of(3 * face).piece];
            }
            const auto most = std::ranges::max_element(votes);
            is_alike = is_alike && *most > 0;
            coarse_of.push_back(static_cast<std::size_t>(most - votes.begin()));
            pieces.push_back(std::move(*piece));
            sources.push_back(std::move(source));
        }
        std::vector<std::size_t> sorted = coarse_of;
        std::ranges::sort(sorted);
        is_alike =
            is_alike && sorted.size() == cut_.pieces().size() && std::ranges::adjacent_find(sorted) == sorted.end();
        std::vector<Carried> how;
        for (std::size_t k = 0; k < pieces.size(); ++k) {
            note_tips(sources[k], pieces[k]);
            const bool is_placed = is_alike && place(pieces[k], k, *cut_.pieces()[coarse_of[k]], sources[k], context);
            how.push_back(is_placed ? Carried::placed : Carried::cut);
            if (is_placed) continue;
            if (!draw_apart(pieces[k], on_paths(pieces[k], sources[k])) || !survives_storing(pieces[k])) return {};
        }
        if (pieces.size() == 1) pieces.front().kind = fine_.kind;
        note_lengths(pieces.front());
        return {std::move(pieces), std::move(how)};
    }

private:
    /// A vertex of a fine piece in the relaxed coarse piece.
    struct Place {
        Index face = -1;  ///< of the coarse piece
        Complex at = 0.0;
        Complex shift = 0.0;  ///< in the uncut map, from the path to the chain
        bool on_path = false;
    };

    /// Both sides of each path, and the boundary: at the same share of each edge's length as on the coarse edge.
    void place_paths(const Straightened& straight)
    {
        pending_.clear();
        for (const auto& [chain, path] : paths_) {
            auto from = path.begin();
            for (const Index h : chain) {
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
            after = h == path.back() ? whole : before + halfedge_length(fine_, h);
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
        const CutCoarsePart::Place here = cut_.place_of(coarse);
        const Triangles& triangles = coarse_.surface.triangles;
        const Complex on_edge = (1.0 - share) * complex_at(coarse_.points, origin(triangles, coarse)) +
                                share * complex_at(coarse_.points, target(triangles, coarse));
        const Complex z = complex_at(fine_.points, origin(fine_.surface.triangles, fine));
        Place place{face_of(here.halfedge), 0.0, straight * (on_edge - z), true};
        const FlatPart& piece = *cut_.pieces()[here.piece];
        place.at = moved(piece, place.face, z + place.shift);
        pending_.push_back({fine_corner_[face_of(fine)], fine % 3, place});
    }

    /// Moves a fine piece to its places in the relaxed coarse piece, with its paths as little straightened as possible.
    /// @return whether it is one to one there
    bool place(FlatPart& piece, std::size_t k, const FlatPart& relaxed, const std::vector<Index>& source,
               const ExecutionContext& context)
    {
        const std::vector<char> none(source.size(), 0);
        for (const Straightened& straight : straightened) {
            std::optional<PlanarPoints> points = places_of(piece, k, relaxed, straight, source);
            // Faces that stay turned over lie away from the paths.
            if (!points ||
                !turn_upright(piece.vertices, piece.surface.triangles, piece.surface.loops, none, *points, context))
                return false;
            if (!lies_one_to_one(piece, *points)) continue;
            std::swap(piece.points, *points);
            if (survives_storing(piece)) return true;
            std::swap(piece.points, *points);
        }
        return false;
    }

    /// (V, 2) of a fine piece, in the relaxed coarse piece; empty if a vertex has no place there.
    std::optional<PlanarPoints> places_of(const FlatPart& piece, std::size_t k, const FlatPart& relaxed,
                                          const Straightened& straight, const std::vector<Index>& source)
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
        if (queue.size() < places.size()) return {};
        PlanarPoints points(piece.points.rows(), 2);
        for (std::size_t v = 0; v < places.size(); ++v) put_complex(points, static_cast<Eigen::Index>(v), places[v].at);
        if (!points.allFinite()) return {};
        return points;
    }

    /// The coarse part's vertex at a corner of a relaxed coarse piece.
    Index coarse_corner_of(const FlatPart& relaxed, Eigen::Index c) const
    {
        return coarse_.surface.triangles(cut_.face_of_whole(relaxed.faces[static_cast<std::size_t>(c / 3)]), c % 3);
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
            coarse += path_length(coarse_, chain);
        }
        const double share = coarse > 0.0 ? fine / coarse : 1.0;
        first.slit = fine_.slit;
        first.dart_length = fine_.dart_length;
        for (const FlatPart* piece : cut_.pieces()) {
            first.slit += share * piece->slit;
            first.dart_length += share * piece->dart_length;
        }
        first.slit -= share * coarse_.slit;
    }

    struct Pending {
        CutCoarsePart::Place corner;
        Index k;
        Place place;
    };

    const FlatPart &fine_, &coarse_;
    const CutCoarsePart& cut_;
    const std::vector<Index>& vertex_;  // (V) of the coarse part: the fine vertex
    std::vector<CarriedPath> paths_;
    std::vector<CutCoarsePart::Place> fine_corner_;  // (F) of each fine face: the piece, and its first half-edge there
    std::vector<Pending> pending_;
};

}  // namespace

CarriedParts carried(const std::vector<FlatPart>& fine, const CoarseParts& before, const std::vector<FlatPart>& after,
                     const ExecutionContext& context)
{
    std::vector<CutCoarsePart> coarse;
    std::unordered_map<Index, std::size_t> part_of;  // by a face of the whole
    for (std::size_t k = 0; k < fine.size(); ++k) {
        coarse.emplace_back(before.parts[k]);
        for (const Index f : before.parts[k].faces) part_of.emplace(f, k);
    }
    for (const FlatPart& piece : after) coarse[part_of.at(piece.faces.front())].add(piece);
    std::vector<std::vector<CarriedPath>> paths = carried_paths(fine, coarse, before.vertex, context);
    CarriedParts result;
    for (std::size_t k = 0; k < fine.size(); ++k) {
        CarriedParts own = CarriedPieces(fine[k], coarse[k], before.vertex[k], std::move(paths[k])).pieces(context);
        if (own.parts.empty()) own = {{fine[k]}, {Carried::whole}};
        std::ranges::move(own.parts, std::back_inserter(result.parts));
        result.how.insert(result.how.end(), own.how.begin(), own.how.end());
    }
    return result;
}

}  // namespace koebe
