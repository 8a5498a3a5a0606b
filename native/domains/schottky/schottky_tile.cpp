#include "schottky/schottky_tile.h"

#include "circles/circle_projection.h"
#include "core/connectivity.h"
#include "core/errors.h"
#include "core/numbering.h"
#include "core/sort_unique.h"
#include "core/uv_resolution.h"
#include "foldover/untangle.h"
#include "planar/boundary_crossings.h"
#include "quality/stored_uv.h"
#include "quality/verdict.h"

#include <algorithm>
#include <iterator>
#include <map>
#include <utility>

namespace koebe {
namespace {

/// Numbers the copies of vertices.
class Copies {
public:
    Copies(Index vertex_count, SchottkyTile& tile) : plain_(static_cast<std::size_t>(vertex_count), -1), tile_(tile) {}

    Index number(Index vertex, const GroupWord& word)
    {
        Index& known = word.empty() ? plain_[vertex] : others_.try_emplace({vertex, word}, -1).first->second;
        if (known < 0) {
            known = static_cast<Index>(tile_.vertex.size());
            tile_.vertex.push_back(vertex);
            tile_.word.push_back(word);
        }
        return known;
    }

private:
    std::vector<Index> plain_;
    std::map<std::pair<Index, GroupWord>, Index> others_;
    SchottkyTile& tile_;
};

/// The boundary of a tile. Where it touches itself in a vertex, it continues along the same fan of faces.
std::vector<VertexLoop> tile_boundary(const Triangles& triangles)
{
    std::map<std::pair<Index, Index>, Index> at;
    const auto count = static_cast<Index>(triangles.size());
    for (Index h = 0; h < count; ++h) at[{origin(triangles, h), target(triangles, h)}] = h;
    const auto twin = [&](Index h) {
        const auto other = at.find({target(triangles, h), origin(triangles, h)});
        return other == at.end() ? no_twin : other->second;
    };
    std::vector<char> seen(static_cast<std::size_t>(count), 0);
    std::vector<VertexLoop> loops;
    for (Index start = 0; start < count; ++start) {
        if (seen[start] || twin(start) != no_twin) continue;
        VertexLoop& loop = loops.emplace_back();
        for (Index h = start; !seen[h];) {
            seen[h] = 1;
            loop.push_back(origin(triangles, h));
            h = next_halfedge(h);
            for (Index other = twin(h); other != no_twin; other = twin(h)) h = next_halfedge(other);
        }
    }
    return loops;
}

/// Puts the loop with the largest area first.
void put_outer_first(std::vector<VertexLoop>& loops, const PlanarPoints& points)
{
    const auto outer =
        std::ranges::max_element(loops, {}, [&](const VertexLoop& loop) { return enclosed_area(loop, points); });
    if (outer != loops.end()) std::iter_swap(loops.begin(), outer);
}

}  // namespace

SchottkyTiling::SchottkyTiling(const HandleCut& cut, const FinerFaces& faces, const std::vector<Index>& polygon)
    : cut_(cut),
      faces_(faces),
      across_(static_cast<std::size_t>(cut.surface.triangles.size())),
      letter_(cut.original.size(), 0)
{
    const Triangles& triangles = cut.surface.triangles;
    first_side_ = numbers_below(cut.original.size());
    for (std::size_t h = 0; h < across_.size(); ++h) across_[h].halfedge = cut.surface.twin[h];
    std::vector<Index> border(cut.original.size(), -1);  // boundary half-edge from each vertex
    for (Index h = 0; h < static_cast<Index>(across_.size()); ++h)
        if (cut.surface.twin[h] == no_twin) border[origin(triangles, h)] = h;
    for (std::size_t k = 0; k < cut.loops.size(); ++k) {
        const CutLoop& loop = cut.loops[k];
        if (loop.handle < 0) continue;
        const bool is_first = loop.partner > static_cast<int>(k);
        const CutLoop& other = cut.loops[loop.partner];
        const std::size_t n = loop.vertices.size();
        for (std::size_t i = 0; i < n; ++i) {
            // A copy w of the first side lies on the copy w g^-1 of the second.
            across_[border[loop.vertices[i]]] = {border[other.vertices[loop.matches[(i + 1) % n]]],
                                                 is_first ? -(loop.handle + 1) : loop.handle + 1};
            if (!is_first) {
                first_side_[loop.vertices[i]] = other.vertices[loop.matches[i]];
                letter_[loop.vertices[i]] = loop.handle + 1;
            }
        }
    }
    const bool joins =
        !polygon.empty() || cut.surface.triangles.rows() > static_cast<Eigen::Index>(faces.corners.size());
    const auto number = [&](Index face) {
        const Index own = faces.input_face[cut.input_face[face]];
        return polygon.empty() ? own : polygon[own];
    };
    const auto face_count = static_cast<Index>(triangles.rows());
    unit_.assign(face_count, -1);
    in_unit_.resize(face_count);
    for (Index start = 0; start < face_count; ++start) {
        if (unit_[start] >= 0) continue;
        const auto own = static_cast<Index>(faces_of_.size());
        unit_[start] = own;
        faces_of_.push_back({start});
        for (std::size_t head = 0; joins && head < faces_of_.back().size(); ++head) {
            const Index face = faces_of_.back()[head];
            for (Index h = 3 * face; h < 3 * face + 3; ++h) {
                if (across_[h].halfedge < 0) continue;
                const Index next = face_of(across_[h].halfedge);
                if (unit_[next] >= 0 || number(next) != number(face)) continue;
                unit_[next] = own;
                in_unit_[next] = in_unit_[face];
                append_letter(in_unit_[next], across_[h].letter);
                faces_of_.back().push_back(next);
            }
        }
    }
}

GroupWord SchottkyTiling::word_of(const GroupWord& unit, Index face) const { return product(unit, in_unit_[face]); }

GroupWord SchottkyTiling::corner_word(Index halfedge) const
{
    GroupWord word = in_unit_[face_of(halfedge)];
    append_letter(word, letter_[origin(cut_.surface.triangles, halfedge)]);
    return word;
}

SchottkyTile SchottkyTiling::as_cut(const SchottkyPlane& plane) const
{
    return put_together(plane, joined(std::vector<GroupWord>(faces_of_.size())));
}

SchottkyTile SchottkyTiling::by_circles(const SchottkyPlane& plane, const FundamentalCircles& circles) const
{
    const Triangles& triangles = cut_.surface.triangles;
    // The word that brings each hole into the fundamental domain.
    std::vector<int> hole_at(cut_.original.size(), -1);
    std::vector<GroupWord> hole_word;
    for (std::size_t k = 0; k < cut_.holes; ++k) {
        for (const Index v : cut_.loops[k].vertices) hole_at[v] = static_cast<int>(k);
        hole_word.push_back(k == 0 ? GroupWord{} : way_out(plane.holes[k].center, plane, circles));
    }
    std::vector<GroupWord> words(faces_of_.size());
    // Faces that touch a hole go with it, so that the hole stays whole; others go by their middle.
    for (std::size_t u = 0; u < words.size(); ++u) {
        int hole = -1;
        GroupWord of_hole;
        Complex middle = 0.0;
        for (const Index face : faces_of_[u])
            for (const Index v : triangles.row(face)) {
                middle += applied(in_unit_[face], plane.generators, plane.z[v]) /
                          (3.0 * static_cast<double>(faces_of_[u].size()));
                if (hole < 0 && hole_at[v] >= 0) {
                    hole = hole_at[v];
                    of_hole = product(hole_word[hole], inverse_of(in_unit_[face]));
                }
            }
        words[u] = hole >= 0 ? of_hole : way_out(middle, plane, circles);
    }
    return put_together(plane, joined(std::move(words)));
}

/// Changes words so that edges join all units. The largest piece does not move.
std::vector<GroupWord> SchottkyTiling::joined(std::vector<GroupWord> words) const
{
    // The word of a unit such that no seam runs along h: the word on this side, and the letter of the cut.
    const auto next_to = [&](Index face, Index h) {
        GroupWord word = word_of(words[unit_[face]], face);
        append_letter(word, across_[h].letter);
        return product(word, inverse_of(in_unit_[face_of(across_[h].halfedge)]));
    };
    std::vector<int> piece(words.size(), -1);
    std::vector<Index> largest;
    // Walks over units that lie side by side already, or moves them there.
    const auto spread = [&](std::vector<Index> units, int own, bool move) {
        for (std::size_t head = 0; head < units.size(); ++head)
            for (const Index face : faces_of_[units[head]])
                for (Index h = 3 * face; h < 3 * face + 3; ++h) {
                    if (across_[h].halfedge < 0) continue;
                    const Index other = unit_[face_of(across_[h].halfedge)];
                    if (piece[other] >= 0) continue;
                    GroupWord word = next_to(face, h);
                    if (!move && word != words[other]) continue;
                    words[other] = std::move(word);
                    piece[other] = own;
                    units.push_back(other);
                }
        return units;
    };
    // The largest connected piece stays, and all others come to it.
    for (std::size_t u = 0; u < words.size(); ++u) {
        if (piece[u] >= 0) continue;
        piece[u] = static_cast<int>(u);
        std::vector<Index> units = spread({static_cast<Index>(u)}, static_cast<int>(u), false);
        if (units.size() > largest.size()) largest = std::move(units);
    }
    std::ranges::fill(piece, -1);
    for (const Index u : largest) piece[u] = 0;
    spread(std::move(largest), 0, true);
    return words;
}

SchottkyTile SchottkyTiling::put_together(const SchottkyPlane& plane, const std::vector<GroupWord>& words) const
{
    SchottkyTile tile;
    tile.triangles.resize(static_cast<Eigen::Index>(faces_.corners.size()), 3);
    Copies copies(static_cast<Index>(cut_.original.size()), tile);
    for (std::size_t f = 0; f < faces_.corners.size(); ++f)
        for (int k = 0; k < 3; ++k) {
            const Index corner = faces_.corners[f][k], h = cut_.corners[corner / 3][corner % 3];
            tile.triangles(static_cast<Eigen::Index>(f), k) = copies.number(
                first_side_[origin(cut_.surface.triangles, h)], product(words[unit_[face_of(h)]], corner_word(h)));
        }
    tile.points.resize(static_cast<Eigen::Index>(tile.vertex.size()), 2);
    for (std::size_t i = 0; i < tile.vertex.size(); ++i) {
        const Complex at = applied(tile.word[i], plane.generators, plane.z[tile.vertex[i]]);
        tile.points.row(static_cast<Eigen::Index>(i)) << at.real(), at.imag();
    }
    tile.loops = tile_boundary(tile.triangles);
    put_outer_first(tile.loops, tile.points);
    return tile;
}

void SchottkyTiling::turn_back(const SchottkyTile& tile, SchottkyPlane& plane, const ExecutionContext& context) const
{
    Surface surface;
    try {
        surface = require_bordered_genus_zero(tile.triangles, static_cast<Index>(tile.vertex.size()));
    } catch (const TopologyError&) {
        return;  // the boundary touches itself in a vertex
    }
    std::vector<int> hole_at(cut_.original.size(), -1);
    for (std::size_t k = 0; k < cut_.holes; ++k)
        for (const Index v : cut_.loops[k].vertices) hole_at[v] = static_cast<int>(k);
    std::vector<Circle> circles;
    std::vector<Index> off_circle;
    UntangleOptions options;
    for (const VertexLoop& loop : tile.loops) {
        const int hole = hole_at[tile.vertex[loop.front()]];
        const bool whole = hole >= 0 && std::ranges::all_of(loop, [&](Index v) {
                               return hole_at[tile.vertex[v]] == hole && tile.word[v] == tile.word[loop.front()];
                           });
        Circle circle;
        if (whole) {
            circle = applied(tile.word[loop.front()], plane.generators, plane.holes[hole]);
        } else {
            off_circle.insert(off_circle.end(), loop.begin(), loop.end());
            options.held.insert(options.held.end(), loop.begin(), loop.end());
        }
        circles.push_back(circle);
    }
    sort_unique(off_circle);
    PlanarPoints points = tile.points;
    Vertices vertices(static_cast<Eigen::Index>(tile.vertex.size()), 3);
    for (std::size_t i = 0; i < tile.vertex.size(); ++i)
        vertices.row(static_cast<Eigen::Index>(i)) = cut_.vertices.row(tile.vertex[i]);
    untangle(vertices, surface, tile.loops, circles, off_circle, points, context, options);
    const std::vector<char> boundary = boundary_mask(surface);
    for (Index i = 0; i < static_cast<Index>(tile.vertex.size()); ++i) {
        const Index v = tile.vertex[i];
        if (points.row(i) == tile.points.row(i) || (boundary[i] && hole_at[v] < 0)) continue;
        plane.z[v] = applied(inverse_of(tile.word[i]), plane.generators, Complex(points(i, 0), points(i, 1)));
    }
    for (const CutLoop& loop : cut_.loops)  // compute the second sides from the first
        if (loop.handle >= 0)
            for (const Index v : loop.vertices)
                if (letter_[v] != 0) plane.z[v] = applied({letter_[v]}, plane.generators, plane.z[first_side_[v]]);
}

SchottkyHole hole_in(const SchottkyTile& tile, const SchottkyPlane& plane, const HandleCut& cut, std::size_t k,
                     Index vertex_count)
{
    SchottkyHole hole;
    std::vector<char> here(cut.original.size(), 0);
    for (const Index v : cut.loops[k].vertices) {
        here[v] = 1;
        if (cut.original[v] < vertex_count) hole.vertices.push_back(cut.original[v]);
    }
    hole.circle = plane.holes[k];
    hole.roundness = plane.roundness[k];
    const GroupWord* copy = nullptr;
    bool torn = false;
    for (std::size_t i = 0; i < tile.vertex.size(); ++i) {
        if (here[tile.vertex[i]] == 0) continue;
        torn |= copy && *copy != tile.word[i];
        copy = &tile.word[i];
        const auto at = tile.points.row(static_cast<Eigen::Index>(i));
        if (is_off_circle(applied(*copy, plane.generators, plane.holes[k]), {at[0], at[1]}))
            hole.off_circle.push_back(cut.original[tile.vertex[i]]);
    }
    if (copy && !torn) hole.circle = applied(*copy, plane.generators, plane.holes[k]);
    sort_unique(hole.off_circle);
    return hole;
}

SchottkyFaults find_faults(const SchottkyTile& tile)
{
    SchottkyFaults faults;
    if (!tile.points.allFinite()) {
        faults.boundary = true;
        return faults;
    }
    faults.flipped = flipped_faces(tile.triangles, tile.points);
    std::ranges::copy_if(faults.flipped, std::back_inserter(faults.below_resolution),
                         [&](Index f) { return StoredFace(tile.triangles, tile.points, f).below_resolution(); });
    for (std::size_t k = 0; k < tile.loops.size(); ++k)
        faults.boundary |= (enclosed_area(tile.loops[k], tile.points) > 0.0) != (k == 0);
    faults.boundary |= loops_cross(tile.loops, tile.points, 2.0 * uv_resolution);
    return faults;
}

}  // namespace koebe
