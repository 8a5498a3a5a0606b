#include "lift/clipped_outlines.h"

#include "core/connectivity.h"
#include "core/numbering.h"
#include "core/sort_unique.h"
#include "cut/disjoint_sets.h"

#include <algorithm>
#include <iterator>
#include <set>
#include <utility>

namespace koebe {
namespace {

/// The pieces of the surface inside outlines, and how they lie at its loops.
class TakenPieces {
public:
    TakenPieces(const FlatSheet& filled, const Overlay& overlay)
        : overlay_(overlay),
          twin_(pair_halfedges(overlay.triangles, static_cast<Index>(overlay.vertices.rows()))),
          piece_(overlay.face.size(), -1)
    {
        gap_ = values_at(filled.gap, overlay.face);
        for (Index f = 0; f < static_cast<Index>(piece_.size()); ++f)
            if (gap_[f] < 0 && overlay.region[f] >= 0 && piece_[f] < 0) take_piece(f);
    }

    /// How much the Euler characteristic falls when the pieces are cut out: theirs less that of what they share with
    /// the rest.
    Index lost_euler() const
    {
        std::vector<char> taken(overlay_.vertices.rows(), 0), left(overlay_.vertices.rows(), 0);
        Index half_edges = 0, faces = 0, shared = 0;
        for (Index f = 0; f < static_cast<Index>(piece_.size()); ++f) {
            if (gap_[f] >= 0) continue;
            const bool own = piece_[f] >= 0;
            faces += own;
            for (Index h = 3 * f; h < 3 * f + 3; ++h) {
                (own ? taken : left)[origin(overlay_.triangles, h)] = 1;
                if (!own) continue;
                const Index beyond = twin_[h] == no_twin ? -1 : face_of(twin_[h]);
                half_edges += beyond >= 0 && piece_[beyond] >= 0 ? 1 : 2;
                shared -= beyond >= 0 && gap_[beyond] < 0 && piece_[beyond] < 0;
            }
        }
        Index vertices = 0;
        for (std::size_t v = 0; v < taken.size(); ++v) {
            vertices += taken[v];
            shared += taken[v] && left[v];
        }
        return vertices - half_edges / 2 + faces - shared;
    }

    /// Outlines that would divide the surface: their pieces join loops that are joined already.
    std::vector<Index> dividing() const
    {
        const Index gaps = gap_.empty() ? 0 : std::ranges::max(gap_) + 1;
        DisjointSets joined(static_cast<std::size_t>(gaps + pieces_));
        std::vector<Index> found;
        for (Index h = 0; h < static_cast<Index>(twin_.size()); ++h) {
            if (!at_edge(h) || at_rim(h) || !at_rim(next_at_edge(h))) continue;
            const Index beyond = twin_[next_at_edge(h)], piece = piece_[face_of(h)];
            if (beyond != no_twin && !joined.join(gap_[face_of(beyond)], gaps + piece))
                found.push_back(overlay_.region[face_of(h)]);
        }
        return found;
    }

    /// Outlines at vertices where the faces of a set are not connected. @param inside the set (F)
    std::vector<Index> pinching(const std::vector<char>& inside) const
    {
        std::vector<Index> leaving(overlay_.vertices.rows(), 0), found;
        for (Index h = 0; h < static_cast<Index>(twin_.size()); ++h)
            if (is_in(inside, face_of(h)) && (twin_[h] == no_twin || !is_in(inside, face_of(twin_[h]))))
                ++leaving[origin(overlay_.triangles, h)];
        for (Index h = 0; h < static_cast<Index>(twin_.size()); ++h)
            if (leaving[origin(overlay_.triangles, h)] > 1 && overlay_.region[face_of(h)] >= 0)
                found.push_back(overlay_.region[face_of(h)]);
        return found;
    }

private:
    bool is_in(const std::vector<char>& inside, Index f) const { return inside[f] != 0 && gap_[f] < 0; }
    bool same_piece(Index h) const { return twin_[h] != no_twin && piece_[face_of(twin_[h])] == piece_[face_of(h)]; }
    bool at_edge(Index h) const { return piece_[face_of(h)] >= 0 && !same_piece(h); }
    /// Whether a piece ends there because the surface ends.
    bool at_rim(Index h) const { return at_edge(h) && (twin_[h] == no_twin || gap_[face_of(twin_[h])] >= 0); }

    /// The next half-edge along the piece's edge.
    Index next_at_edge(Index h) const
    {
        Index next = next_halfedge(h);
        while (same_piece(next)) next = next_halfedge(twin_[next]);
        return next;
    }

    void take_piece(Index first)
    {
        std::vector<Index> faces{first};
        piece_[first] = pieces_;
        for (std::size_t k = 0; k < faces.size(); ++k)
            for (Index h = 3 * faces[k]; h < 3 * faces[k] + 3; ++h) {
                const Index beyond = twin_[h] == no_twin ? -1 : face_of(twin_[h]);
                if (beyond < 0 || gap_[beyond] >= 0 || piece_[beyond] >= 0) continue;
                if (overlay_.region[beyond] != overlay_.region[first]) continue;
                piece_[beyond] = pieces_;
                faces.push_back(beyond);
            }
        ++pieces_;
    }

    const Overlay& overlay_;
    std::vector<Index> twin_, gap_, piece_;
    Index pieces_ = 0;
};

/// Takes outlines out with their groups, and counts the groups that have a face of the surface.
void drop_groups(const FlatSheet& filled, const std::vector<Index>& wrong, std::vector<DrawnOutline>& outlines,
                 LeftOut& left_out)
{
    std::set<Index> groups;
    for (const Index o : wrong) groups.insert(outlines[o].group);
    left_out.at_border += static_cast<Index>(groups.size());
    for (const DrawnOutline& one : outlines)
        if (groups.contains(one.group) && one.face >= 0 && filled.on_surface(one.face))
            left_out.faces.push_back(one.face);
    std::erase_if(outlines, [&](const DrawnOutline& one) { return groups.contains(one.group); });
}

std::vector<Index> wrong_outlines(const Overlay& overlay, const TakenPieces& pieces, bool cut_out)
{
    std::vector<char> raised(overlay.face.size()), ground(raised.size());
    for (std::size_t f = 0; f < raised.size(); ++f) {
        raised[f] = overlay.in_pattern(static_cast<Index>(f));
        ground[f] = raised[f] == 0;
    }
    std::vector<Index> wrong = pieces.pinching(ground);
    if (cut_out) {
        std::ranges::copy(pieces.dividing(), std::back_inserter(wrong));
    } else {
        std::ranges::copy(pieces.pinching(raised), std::back_inserter(wrong));
    }
    sort_unique(wrong);
    return wrong;
}

}  // namespace

ClippedOverlay draw_clipped_outlines(const FlatSheet& filled, std::vector<DrawnOutline> outlines,
                                     const std::vector<FlatSheet>& charts, bool cut_out)
{
    LeftOut left_out;
    double drawn = 0.0;
    // Draw all, and again without the outlines that came out wrong. Each round has fewer, so this ends.
    while (true) {
        ClippedOverlay result;
        result.overlay = draw_outlines(filled, std::move(outlines), charts, drawn);
        drawn = result.overlay.drawn;
        left_out.add(result.overlay.left_out);
        TakenPieces pieces(filled, result.overlay);
        const std::vector<Index> wrong = wrong_outlines(result.overlay, pieces, cut_out);
        outlines = result.overlay.outlines;
        if (!wrong.empty()) {
            drop_groups(filled, wrong, outlines, left_out);
            continue;
        }
        // Count the outlines that show on the surface.
        std::vector<char> seen(outlines.size(), 0);
        for (std::size_t f = 0; f < result.overlay.face.size(); ++f)
            if (result.overlay.region[f] >= 0 && filled.on_surface(result.overlay.face[f]))
                seen[result.overlay.region[f]] = 1;
        for (std::size_t o = 0; o < outlines.size(); ++o) result.outlines += seen[o] != 0 && !outlines[o].hole;
        result.holes = cut_out ? pieces.lost_euler() : 0;
        sort_unique(left_out.faces);
        result.overlay.left_out = std::move(left_out);
        return result;
    }
}

}  // namespace koebe
