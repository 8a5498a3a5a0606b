#include "proxies/carried_parts.h"

#include "core/connectivity.h"
#include "darts/through_cuts.h"
#include "execution/side_by_side.h"
#include "mesh/connected_pieces.h"
#include "proxies/carried_places.h"

#include <algorithm>
#include <utility>

namespace koebe {
namespace {

/// For each piece of the fine surface the part to which it corresponds; empty if that is not one piece for each part.
/// @param piece (F) of the fine surface, from 0
std::vector<int> parts_of_pieces(const Proxy& proxy, const CoarseNet& net, const NearFaces& near,
                                 const std::vector<Index>& piece, std::size_t pieces, std::size_t parts)
{
    if (pieces != parts) return {};
    std::vector<std::vector<double>> votes(pieces, std::vector<double>(parts, 0.0));
    for (Index f = 0; f < static_cast<Index>(piece.size()); ++f) {
        const Index face = near.nearest(f);
        if (face >= 0) votes[piece[f]][net.place[face].part] += proxy.fine.whole.areas[f];
    }
    std::vector<int> part_of;
    for (const std::vector<double>& own : votes)
        part_of.push_back(static_cast<int>(std::ranges::max_element(own) - own.begin()));
    std::vector<int> sorted = part_of;
    std::ranges::sort(sorted);
    return std::ranges::adjacent_find(sorted) == sorted.end() ? part_of : std::vector<int>{};
}

double path_length(const Vertices& vertices, const Triangles& triangles, const Path& path)
{
    double sum = 0.0;
    for (const Index h : path) sum += (vertices.row(origin(triangles, h)) - vertices.row(target(triangles, h))).norm();
    return sum;
}

/// A piece of the fine surface for each part.
class Carrying {
public:
    Carrying(const Proxy& proxy, const std::vector<FlatPart>& parts, const CoarseNet& net,
             std::vector<CarriedPath> paths)
        : proxy_(proxy), parts_(parts), net_(net), paths_(std::move(paths)), near_(proxy)
    {
    }

    /// Empty if there is not one for each part.
    std::vector<FlatPart> pieces(int threads, ExecutionContext& context)
    {
        // Cut the fine surface along the paths.
        const FlatPart whole = whole_part(proxy_.fine.whole);
        SeamedMesh mesh = seamed(whole, whole.shown);
        for (const auto& [chain, path] : paths_)
            for (const Index h : path) mesh.cut(h);
        std::vector<FlatPart> pieces;
        std::vector<Index> piece_of(whole.faces.size());
        for (const SeamedMesh& own : connected_parts(mesh)) {
            auto piece = opened_piece(whole, own.face, own.fans, vertices_of_fans(own));
            if (!piece) return {};
            for (const Index f : own.face) piece_of[f] = static_cast<Index>(pieces.size());
            pieces.push_back(std::move(*piece));
        }
        part_of_ = parts_of_pieces(proxy_, net_, near_, piece_of, pieces.size(), parts_.size());
        if (part_of_.empty()) return {};
        note_lengths(pieces, piece_of);
        // Lay each piece where its part lies.
        side_by_side(pieces.size(), threads, context, [&](std::size_t k, ExecutionContext& own) {
            const int part = part_of_[k];
            pieces[k].is_near = take_places(proxy_, net_, near_, parts_[part], part, pieces[k], own);
        });
        std::vector<FlatPart> sorted(pieces.size());
        for (std::size_t k = 0; k < pieces.size(); ++k) sorted[part_of_[k]] = std::move(pieces[k]);
        return sorted;
    }

private:
    /// The length of the paths inside each piece, as slits and darts in the proportion of the part's; and the tips of
    /// darts, where one path ends inside.
    void note_lengths(std::vector<FlatPart>& pieces, const std::vector<Index>& piece_of) const
    {
        const CutSurface& fine = proxy_.fine.whole;
        const Triangles& triangles = fine.surface.triangles;
        std::vector<double> length(pieces.size(), 0.0);
        const std::vector<char> outside = boundary_mask(fine.surface);
        std::vector<char> ends = outside;  // (V) how many paths end there, or the boundary
        for (const auto& [chain, path] : paths_) {
            ends[origin(triangles, path.front())] += 1;
            ends[target(triangles, path.back())] += 1;
            if (net_.parts_differ(proxy_.surface, chain.front())) continue;
            length[piece_of[face_of(path.front())]] += path_length(fine.vertices, triangles, path);
        }
        for (std::size_t k = 0; k < pieces.size(); ++k) {
            const FlatPart& part = parts_[part_of_[k]];
            const double coarse = part.slit + part.dart_length;
            pieces[k].slit = coarse > 0.0 ? length[k] * part.slit / coarse : length[k];
            pieces[k].dart_length = length[k] - pieces[k].slit;
            pieces[k].kind = part.kind;
            for (std::size_t v = 0; v < pieces[k].original.size(); ++v)
                if (const Index name = pieces[k].original[v]; ends[name] == 1 && !outside[name])
                    pieces[k].tips.push_back(static_cast<Index>(v));
        }
    }

    const Proxy& proxy_;
    const std::vector<FlatPart>& parts_;
    const CoarseNet& net_;
    std::vector<CarriedPath> paths_;
    NearFaces near_;
    std::vector<int> part_of_;  // (pieces)
};

}  // namespace

std::vector<std::vector<Index>> carried_faces(const Proxy& proxy, const std::vector<FlatPart>& parts,
                                              const ExecutionContext& context)
{
    const auto net = coarse_net(proxy, parts);
    if (!net) return {};
    const std::vector<CarriedPath> paths = carried_paths(proxy, *net, context);
    const NearFaces near(proxy);
    // Straightened paths first. If their pieces do not correspond to the parts: the paths as found.
    for (const bool is_straight : {true, false}) {
        std::vector<Index> twin = proxy.fine.whole.surface.twin;
        for (const auto& [chain, path] : is_straight ? straightened(proxy, paths, context) : paths)
            if (net->parts_differ(proxy.surface, chain.front()))
                for (const Index h : path) twin[proxy.fine.whole.surface.twin[h]] = twin[h] = no_twin;
        Index count = 0;
        const std::vector<int> same(static_cast<std::size_t>(proxy.fine.whole.areas.size()), 0);
        const std::vector<Index> piece = connected_pieces(twin, same, count);
        const std::vector<int> part_of =
            parts_of_pieces(proxy, *net, near, piece, static_cast<std::size_t>(count), parts.size());
        if (part_of.empty()) continue;
        std::vector<std::vector<Index>> faces(parts.size());
        for (std::size_t f = 0; f < piece.size(); ++f) faces[part_of[piece[f]]].push_back(static_cast<Index>(f));
        return faces;
    }
    return {};
}

std::vector<FlatPart> carried_parts(const Proxy& proxy, const std::vector<FlatPart>& parts, int threads,
                                    ExecutionContext& context)
{
    const auto net = coarse_net(proxy, parts);
    if (!net) return {};
    const std::vector<CarriedPath> paths = carried_paths(proxy, *net, context);
    std::vector<FlatPart> pieces =
        Carrying(proxy, parts, *net, straightened(proxy, paths, context)).pieces(threads, context);
    // Where straight cuts do not make a piece of each part, they stay as they were.
    if (pieces.empty()) pieces = Carrying(proxy, parts, *net, paths).pieces(threads, context);
    return pieces;
}

}  // namespace koebe
