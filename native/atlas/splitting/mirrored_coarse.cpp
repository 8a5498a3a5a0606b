#include "splitting/mirrored_coarse.h"

#include "core/connectivity.h"
#include "core/errors.h"
#include "core/numbering.h"
#include "cost/tuning.h"
#include "mesh/connected_pieces.h"
#include "mesh/nearest_first.h"
#include "surface/face_vectors.h"
#include "surface/nearest_triangles.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace koebe {
namespace {

constexpr int most_rounds = 30;    // of smoothing the border between the sides
constexpr double sharp_tip = 5.0;  // radians round a vertex: with less it is the tip of a cone

/// Which faces are on the first side. The border between the sides has no corner of one face, and no face or edge
/// leads from one of its vertices to another.
class Sides {
public:
    Sides(const CutSurface& whole, const MirrorPlane& plane)
        : whole_(whole), triangles_(whole.surface.triangles), twin_(whole.surface.twin)
    {
        for (Index f = 0; f < static_cast<Index>(triangles_.rows()); ++f) {
            Eigen::RowVector3d middle = Eigen::RowVector3d::Zero();
            for (const Index v : triangles_.row(f)) middle += whole.vertices.row(v) / 3.0;
            is_first.push_back(plane.distance(middle) > 0.0);
        }
    }

    /// @return whether the first side is one piece, and its border as described
    bool smooth()
    {
        for (int round = 0; round < most_rounds; ++round) {
            const std::vector<char> before = is_first;
            join_small_pieces();
            for (Index f = 0; f < static_cast<Index>(is_first.size()); ++f) {
                int others = 0;
                for (Index h = 3 * f; h < 3 * f + 3; ++h)
                    others += twin_[h] != no_twin && is_first[face_of(twin_[h])] != is_first[f];
                if (others >= 2) is_first[f] = !is_first[f];
            }
            const std::vector<char> border = border_vertices();
            for (Index h = 0; h < static_cast<Index>(twin_.size()); ++h)
                if (is_chord(h, border)) is_first[face_of(h)] = 0;
            if (is_first == before) return pieces_of_first() == 1;
        }
        return false;
    }

    /// (V) 1 between the sides.
    std::vector<char> border_vertices() const
    {
        std::vector<char> border(static_cast<std::size_t>(whole_.surface.vertex_count), 0);
        for (Index h = 0; h < static_cast<Index>(twin_.size()); ++h)
            if (twin_[h] != no_twin && is_first[face_of(h)] != is_first[face_of(twin_[h])])
                border[origin(triangles_, h)] = border[target(triangles_, h)] = 1;
        return border;
    }

    std::vector<char> is_first;  // (F)

private:
    /// An edge inside the first side from one vertex of the border to another.
    bool is_chord(Index h, const std::vector<char>& border) const
    {
        return is_first[face_of(h)] && border[origin(triangles_, h)] && border[target(triangles_, h)] &&
               (twin_[h] == no_twin || is_first[face_of(twin_[h])]);
    }

    std::vector<Index> pieces(Index& count) const
    {
        return connected_pieces(twin_, std::vector<int>(is_first.begin(), is_first.end()), count);
    }

    Index pieces_of_first() const
    {
        Index count = 0;
        const std::vector<Index> piece = pieces(count);
        std::vector<char> seen(static_cast<std::size_t>(count), 0);
        for (std::size_t f = 0; f < piece.size(); ++f)
            if (is_first[f]) seen[piece[f]] = 1;
        return static_cast<Index>(std::ranges::count(seen, 1));
    }

    /// Keeps the largest piece of the first side, and large pieces of the other.
    void join_small_pieces()
    {
        Index count = 0;
        const std::vector<Index> piece = pieces(count);
        std::vector<double> area(static_cast<std::size_t>(count), 0.0);
        std::vector<char> first(area.size(), 0);
        for (std::size_t f = 0; f < piece.size(); ++f) {
            area[piece[f]] += whole_.areas[static_cast<Eigen::Index>(f)];
            first[piece[f]] = is_first[f];
        }
        std::size_t largest = 0;
        for (std::size_t k = 0; k < area.size(); ++k)
            if (first[k] && (!first[largest] || area[k] > area[largest])) largest = k;
        const double least = tuning::noticeable * whole_.areas.sum();
        for (std::size_t f = 0; f < piece.size(); ++f) {
            const auto own = static_cast<std::size_t>(piece[f]);
            if (first[own] ? own != largest : area[own] < least) is_first[f] = !is_first[f];
        }
    }

    const CutSurface& whole_;
    const Triangles& triangles_;
    const std::vector<Index>& twin_;
};

/// Whether the tip of a cone lies in the plane, but not on the border: it would become two tips.
bool has_tip_beside(const CutSurface& whole, const MirrorPlane& plane, const std::vector<char>& border)
{
    const Triangles& triangles = whole.surface.triangles;
    std::vector<char> beside = boundary_mask(whole.surface);
    for (std::size_t v = 0; v < beside.size(); ++v) beside[v] = !beside[v] && !border[v];
    const VectorXd angle = angle_sums(whole.vertices, triangles);
    VectorXd longest = VectorXd::Zero(angle.size());
    for (Index h = 0; h < static_cast<Index>(triangles.size()); ++h)
        longest[origin(triangles, h)] = std::max(longest[origin(triangles, h)], whole.lengths[h]);
    for (Index v = 0; v < static_cast<Index>(beside.size()); ++v)
        if (beside[v] && angle[v] < sharp_tip && std::abs(plane.distance(whole.vertices.row(v))) < longest[v])
            return true;
    return false;
}

/// Fine vertices for the mirror images of coarse vertices, each one once.
class NamesOfImages {
public:
    NamesOfImages(const CutSurface& whole, const Sides& sides, const std::vector<Index>& image)
        : whole_(whole), image_(image), outside_(boundary_mask(whole.surface))
    {
        taken_.assign(outside_.size(), 1);  // also the vertices of the first side
        for (Index f = 0; f < static_cast<Index>(sides.is_first.size()); ++f)
            if (!sides.is_first[f]) {
                others_.push_back(f);
                for (const Index v : whole.surface.triangles.row(f)) taken_[v] = 0;
            }
        for (std::size_t f = 0; f < sides.is_first.size(); ++f)
            if (sides.is_first[f])
                for (const Index v : whole.surface.triangles.row(static_cast<Eigen::Index>(f))) taken_[v] = 1;
        for (Index v = 0; v < static_cast<Index>(outside_.size()); ++v)
            if (outside_[v]) rims_.push_back(v);
        around_.resize(outside_.size());
        for (Index h = 0; h < static_cast<Index>(whole.surface.twin.size()); ++h)
            around_[origin(whole.surface.triangles, h)].push_back(target(whole.surface.triangles, h));
    }

    /// @param vertices fine vertices of the first side @param places their mirror images @return empty if one has none
    std::vector<Index> take(const std::vector<Index>& vertices, const Vertices& places)
    {
        if (others_.empty()) return {};
        const PlacesInTriangles near =
            nearest_triangles(whole_.vertices, whole_.surface.triangles(others_, Eigen::all), places);
        std::vector<Index> names;
        for (std::size_t i = 0; i < vertices.size(); ++i) {
            const Index face = others_[near.face[static_cast<Eigen::Index>(i)]];
            const Index name = nearest(vertices[i], places.row(static_cast<Eigen::Index>(i)), face);
            if (name < 0) return {};
            taken_[name] = 1;
            names.push_back(name);
        }
        return names;
    }

private:
    Index nearest(Index vertex, const Eigen::RowVector3d& place, Index face) const
    {
        if (!image_.empty() && image_[vertex] >= 0 && !taken_[image_[vertex]]) return image_[vertex];
        std::vector<Index> candidates;
        if (outside_[vertex]) {
            candidates = rims_;
        } else {
            for (const Index v : whole_.surface.triangles.row(face)) {
                candidates.push_back(v);
                candidates.insert(candidates.end(), around_[v].begin(), around_[v].end());
            }
        }
        Index best = -1;
        double least = 0.0;
        for (const Index v : candidates) {
            if (taken_[v] || outside_[v] != outside_[vertex]) continue;
            const double own = (whole_.vertices.row(v) - place).squaredNorm();
            if (best >= 0 && !(own < least)) continue;
            best = v;
            least = own;
        }
        return best;
    }

    const CutSurface& whole_;
    const std::vector<Index>& image_;
    std::vector<char> outside_, taken_;       // (V)
    std::vector<Index> rims_;                 // vertices on the boundary
    std::vector<Index> others_;               // faces of the other side
    std::vector<std::vector<Index>> around_;  // (V)
};

/// Whether each loop of the coarse surface runs along one loop of the fine one, in the same direction, and the surfaces
/// have the same topology.
bool corresponds(const Surface& fine, const CoarseSurface& coarse)
{
    Surface own;
    try {
        own = analyze_surface(coarse.triangles, static_cast<Index>(coarse.vertex.size()));
    } catch (const TopologyError&) {
        return false;
    }
    if (own.genus != fine.genus || own.loops.size() != fine.loops.size()) return false;
    // Loop and number of each fine vertex on a rim.
    std::vector<std::pair<int, Index>> place(static_cast<std::size_t>(fine.vertex_count), {-1, -1});
    for (std::size_t k = 0; k < fine.loops.size(); ++k)
        for (std::size_t i = 0; i < fine.loops[k].size(); ++i)
            place[fine.loops[k][i]] = {static_cast<int>(k), static_cast<Index>(i)};
    std::vector<char> taken(fine.loops.size(), 0);
    for (const VertexLoop& loop : own.loops) {
        const int fine_loop = place[coarse.vertex[loop.front()]].first;
        if (fine_loop < 0 || taken[fine_loop]) return false;
        taken[fine_loop] = 1;
        // In the same direction, once round: the number falls exactly once.
        int descents = 0;
        for (std::size_t i = 0; i < loop.size(); ++i) {
            const auto here = place[coarse.vertex[loop[i]]], next = place[coarse.vertex[loop[(i + 1) % loop.size()]]];
            if (here.first != fine_loop || here.second == next.second) return false;
            descents += next.second < here.second;
        }
        if (descents != 1) return false;
    }
    return true;
}

/// Gives the vertices of the other side the coarse vertex that is nearest along edges.
void note_others(const CutSurface& whole, const Sides& sides, CoarseSurface& coarse)
{
    const Triangles& triangles = whole.surface.triangles;
    std::vector<std::vector<Index>> leaving(static_cast<std::size_t>(whole.surface.vertex_count));
    for (Index h = 0; h < static_cast<Index>(whole.surface.twin.size()); ++h)
        if (!sides.is_first[face_of(h)]) {
            leaving[origin(triangles, h)].push_back(target(triangles, h));
            leaving[target(triangles, h)].push_back(origin(triangles, h));
        }
    NearestFirst nearest(whole.surface.vertex_count);
    for (Index v = 0; v < static_cast<Index>(leaving.size()); ++v)
        if (coarse.vertex_at[v] >= 0) nearest.reach(v, 0.0);
    for (Index v = nearest.take(); v >= 0; v = nearest.take())
        for (const Index w : leaving[v])
            if (nearest.reach(w, nearest.distance()[v] + (whole.vertices.row(v) - whole.vertices.row(w)).norm()))
                coarse.vertex_at[w] = coarse.vertex_at[v];
}

/// One side of a surface, with its border in the plane.
struct Half {
    Vertices vertices;
    Triangles triangles;
    std::vector<Index> vertex;  // (V) of the whole
    std::vector<char> border;   // (V) 1 in the plane
};

/// @param border_of_whole (V) 1 between the sides @return nothing if the side is no surface
std::optional<Half> half_of(const CutSurface& whole, const MirrorPlane& plane, const Sides& sides,
                            const std::vector<char>& border_of_whole)
{
    // The faces of the first side, with vertices of their own.
    Half half;
    std::vector<Index> number(border_of_whole.size(), -1), own;
    for (Index f = 0; f < static_cast<Index>(sides.is_first.size()); ++f)
        if (sides.is_first[f]) own.push_back(f);
    half.triangles = whole.surface.triangles(own, Eigen::all);
    for (Index& v : half.triangles.reshaped()) {
        if (number[v] < 0) {
            number[v] = static_cast<Index>(half.vertex.size());
            half.vertex.push_back(v);
        }
        v = number[v];
    }

    // The border goes to its nearest points in the plane.
    half.vertices = whole.vertices(half.vertex, Eigen::all);
    half.border = values_at(border_of_whole, half.vertex);
    for (std::size_t i = 0; i < half.vertex.size(); ++i)
        if (half.border[i]) {
            const auto row = static_cast<Eigen::Index>(i);
            half.vertices.row(row) -= plane.distance(half.vertices.row(row)) * plane.normal;
        }
    try {
        analyze_surface(half.triangles, static_cast<Index>(half.vertex.size()));
    } catch (const TopologyError&) {
        return {};
    }
    return half;
}

/// A coarse side and its mirror image as one surface. Vertices of the other side get the names of fine ones there.
/// @param coarse of the half @return nothing if there are no names, or not the topology of the whole
std::optional<CoarseSurface> doubled(const CutSurface& whole, const MirrorPlane& plane, const Sides& sides,
                                     const Half& half, const CoarseSurface& coarse, const std::vector<Index>& image)
{
    // The image of each vertex: itself in the plane, else a new one.
    CoarseSurface both;
    const auto count = static_cast<Index>(coarse.vertex.size());
    std::vector<Index> twin(coarse.vertex.size()), beside;  // beside the plane
    for (Index v = 0; v < count; ++v) {
        twin[v] = v;
        if (half.border[coarse.vertex[v]]) continue;
        twin[v] = count + static_cast<Index>(beside.size());
        beside.push_back(v);
    }
    both.vertex = values_at(half.vertex, coarse.vertex);
    std::vector<Index> originals;
    Vertices places(static_cast<Eigen::Index>(beside.size()), 3);
    for (std::size_t i = 0; i < beside.size(); ++i) {
        originals.push_back(both.vertex[beside[i]]);
        places.row(static_cast<Eigen::Index>(i)) = plane.image(coarse.vertices.row(beside[i]));
    }
    const std::vector<Index> names = NamesOfImages(whole, sides, image).take(originals, places);
    if (names.empty()) return {};

    // The faces of the side, and their images turned over.
    both.vertex.insert(both.vertex.end(), names.begin(), names.end());
    both.vertices.resize(count + places.rows(), 3);
    both.vertices << coarse.vertices, places;
    const Eigen::Index rows = coarse.triangles.rows();
    both.triangles.resize(2 * rows, 3);
    both.triangles.topRows(rows) = coarse.triangles;
    for (Eigen::Index f = 0; f < rows; ++f)
        both.triangles.row(rows + f) << twin[coarse.triangles(f, 0)], twin[coarse.triangles(f, 2)],
            twin[coarse.triangles(f, 1)];
    if (!corresponds(whole.surface, both)) return {};

    // Where fine vertices are.
    both.vertex_at.assign(static_cast<std::size_t>(whole.surface.vertex_count), -1);
    for (std::size_t i = 0; i < half.vertex.size(); ++i) both.vertex_at[half.vertex[i]] = coarse.vertex_at[i];
    for (std::size_t i = 0; i < names.size(); ++i) both.vertex_at[names[i]] = count + static_cast<Index>(i);
    note_others(whole, sides, both);
    return both;
}

/// Whether a vertex has so many faces that boxes do not tell them apart: images are found in a tree of boxes.
bool has_needles(const CutSurface& whole)
{
    std::vector<int> around(static_cast<std::size_t>(whole.vertices.rows()), 0);
    for (const Index v : whole.surface.triangles.reshaped()) ++around[v];
    return std::ranges::max(around) > hub_faces;
}

}  // namespace

std::optional<CoarseSurface> mirrored_coarse_surface(const CutSurface& whole, const MirrorPlane& plane,
                                                     const std::vector<Index>& image, Index faces,
                                                     ExecutionContext& context)
{
    if (has_needles(whole)) return {};
    Sides sides(whole, plane);
    if (!sides.smooth()) return {};
    const std::vector<char> border = sides.border_vertices();
    if (has_tip_beside(whole, plane, border)) return {};
    const std::optional<Half> half = half_of(whole, plane, sides, border);
    if (!half) return {};
    const CoarseSurface coarse = coarse_surface(half->vertices, half->triangles, faces / 2, {}, context, half->border);
    return doubled(whole, plane, sides, *half, coarse, image);
}

}  // namespace koebe
