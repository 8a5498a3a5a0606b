#include "parts/fine_parts.h"

#include "cost/costs.h"
#include "execution/side_by_side.h"
#include "mesh/connected_pieces.h"
#include "parts/carried_parts.h"
#include "parts/pinholes.h"
#include "surface/mirror.h"

#include <algorithm>
#include <memory>
#include <numeric>
#include <utility>

namespace koebe {
namespace {

/// For each part the number of the other part with its first face. @param faces of the surface
std::vector<std::size_t> owners(const std::vector<FlatPart>& parts, const std::vector<FlatPart>& others,
                                Eigen::Index faces)
{
    std::vector<std::size_t> other(static_cast<std::size_t>(faces), 0), owner;
    for (std::size_t k = 0; k < others.size(); ++k)
        for (const Index f : others[k].faces) other[f] = k;
    for (const FlatPart& part : parts) owner.push_back(other[part.faces.front()]);
    return owner;
}

std::size_t groups_of(const MeshPiece& own)
{
    return std::max(*std::ranges::max_element(own.group), *std::ranges::max_element(own.uncut_group)) + 1;
}

}  // namespace

void FineParts::lay(MeshPiece& own) const
{
    SplitEffort effort;
    const std::vector<std::vector<Index>> faces = carried_faces(*own.proxy, own.parts, context_);
    own.is_fine = true;
    own.parts = faces.empty() ? flat_piece(own.input, own.surface(), options_, options_.threads, context_, effort).parts
                              : laid(own, faces);
}

void FineParts::carry(std::vector<std::vector<FlatPart>> before)
{
    for (std::size_t i = 0; i < pieces_.size(); ++i) carry(pieces_[i], std::move(before[i]));
}

void FineParts::carry(MeshPiece& own, std::vector<FlatPart> before)
{
    // Parts of the piece itself are compared with what they were before.
    if (own.is_fine) {
        own.group = owners(own.parts, before, own.named().triangles.rows());
        own.conformal = std::move(before);
        own.uncut_group.resize(own.conformal.size());
        std::iota(own.uncut_group.begin(), own.uncut_group.end(), 0);
        return;
    }
    std::vector<FlatPart> fine = carried_parts(*own.proxy, own.parts, options_.threads, context_);
    if (fine.empty()) {
        own.parts = std::move(before);
        lay(own);
        carry(own, own.parts);
        return;
    }

    // Parts of the proxy: those of one group were one part there before darts and through cuts.
    own.group = owners(own.parts, before, own.proxy->surface.triangles.rows());
    std::vector<std::vector<Index>> faces(before.size());
    for (std::size_t k = 0; k < fine.size(); ++k)
        faces[own.group[k]].insert(faces[own.group[k]].end(), fine[k].faces.begin(), fine[k].faces.end());
    own.conformal = laid(own, faces, MapPurpose::judging);
    own.uncut_group = owners(own.conformal, fine, own.proxy->fine.whole.areas.size());
    for (std::size_t& group : own.uncut_group) group = own.group[group];
    own.is_measured = true;

    // Pieces that found no place in their part start from what they are at E = 0.
    side_by_side(fine.size(), options_.threads, context_, [&](std::size_t k, ExecutionContext& context) {
        if (!fine[k].is_near) start_by_itself(own.conformal, fine[k], context);
    });
    own.parts = std::move(fine);
    own.is_fine = true;
}

/// Makes parts that were only measured anew, as they would be stored.
void FineParts::make_exact(MeshPiece& own) const
{
    if (!std::exchange(own.is_measured, false)) return;
    std::vector<std::vector<Index>> faces;
    for (const FlatPart& part : own.conformal) faces.push_back(part.faces);
    std::vector<FlatPart> exact = laid(own, faces);
    std::vector<std::size_t> group = owners(exact, own.conformal, own.proxy->fine.whole.areas.size());
    for (std::size_t& k : group) k = own.uncut_group[k];
    own.conformal = std::move(exact);
    own.uncut_group = std::move(group);
}

AngleBounds FineParts::angle_bounds()
{
    AngleBounds bounds;
    if (options_.even) return bounds;
    for (const MeshPiece& own : pieces_) {
        const std::size_t first = bounds.most.size();
        for (const std::size_t group : own.group) bounds.group.push_back(first + group);
        bounds.most.resize(first + groups_of(own), 0.0);
        for (std::size_t k = 0; k < own.conformal.size(); ++k)
            bounds.most[first + own.uncut_group[k]] +=
                own.is_measured ? sum_of_upright_angle_errors(own.conformal[k]) : sum_of_angle_errors(own.conformal[k]);
    }
    if (std::ranges::any_of(pieces_, &MeshPiece::is_measured))
        bounds.exact = [this] {
            for (MeshPiece& own : pieces_) make_exact(own);
            return angle_bounds();
        };
    return bounds;
}

void FineParts::open_pinholes()
{
    for (MeshPiece& own : pieces_) {
        if (!own.filled) continue;
        std::vector<FlatPart> parts;
        std::vector<std::size_t> group;
        for (std::size_t k = 0; k < own.parts.size(); ++k)
            for (FlatPart& part :
                 with_pinholes(std::move(own.parts[k]), static_cast<Index>(own.input.piece.triangles.rows()))) {
                parts.push_back(std::move(part));
                group.push_back(own.group[k]);
            }
        own.parts = std::move(parts);
        own.group = std::move(group);
    }
}

std::vector<Index> FineParts::go_back(const std::vector<std::size_t>& groups)
{
    std::vector<Index> not_even;
    std::size_t first = 0;
    for (MeshPiece& own : pieces_) {
        const std::size_t end = first + groups_of(own);
        std::vector<FlatPart> parts;
        const auto goes_back = [&](std::size_t group) { return std::ranges::count(groups, first + group) > 0; };
        for (std::size_t k = 0; k < own.parts.size(); ++k)
            if (!goes_back(own.group[k])) parts.push_back(std::move(own.parts[k]));
        for (std::size_t k = 0; k < own.conformal.size(); ++k) {
            if (!goes_back(own.uncut_group[k])) continue;
            for (const Index f : own.conformal[k].faces) not_even.push_back(own.input.piece.source_face[f]);
            parts.push_back(std::move(own.conformal[k]));
        }
        own.parts = std::move(parts);
        own.conformal.clear();
        first = end;
    }
    return not_even;
}

/// Parts of the fine surface with its pinholes, each mapped by itself. @param faces of each part; if only filled
/// pinholes join them, there are more parts @param purpose judging: they are no result
std::vector<FlatPart> FineParts::laid(const MeshPiece& own, const std::vector<std::vector<Index>>& faces,
                                      MapPurpose purpose) const
{
    SplitEffort effort;
    const CutSurface& whole = own.surface().whole;
    const auto count = static_cast<Index>(whole.areas.size());
    std::vector<int> label(static_cast<std::size_t>(count), -1);
    for (std::size_t k = 0; k < faces.size(); ++k)
        for (const Index f : faces[k])
            if (f < count) label[f] = static_cast<int>(k);
    Index pieces = 0;
    const std::vector<Index> piece = connected_pieces(whole.surface.twin, label, pieces);
    std::vector<std::vector<Index>> faces_of(static_cast<std::size_t>(pieces));
    for (Index f = 0; f < count; ++f)
        if (label[f] >= 0) faces_of[piece[f]].push_back(f);
    std::vector<PartPointer> parts;
    for (std::vector<Index>& of_part : faces_of)
        if (!of_part.empty())
            parts.push_back(std::make_shared<Part>(Part{part_mesh(whole, std::move(of_part)), {}, {}}));
    const CutPrices prices = prices_of_piece(whole.areas.sum(), options_.price);
    return flat_parts(whole, find_mirror(whole.vertices, whole.surface.triangles, whole.polygon), parts,
                      {prices, options_.round_cuts, purpose}, options_.threads, context_, effort)
        .parts;
}

}  // namespace koebe
