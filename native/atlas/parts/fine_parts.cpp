#include "parts/fine_parts.h"

#include "cost/costs.h"
#include "cut/disjoint_sets.h"
#include "darts/own_start.h"
#include "execution/side_by_side.h"
#include "mesh/connected_pieces.h"
#include "parts/pinholes.h"
#include "proxies/carried_parts.h"
#include "proxies/near_faces.h"
#include "surface/mirror.h"

#include <algorithm>
#include <memory>
#include <utility>

namespace koebe {
namespace {

/// (F) The number of the part with each face. @param faces of the surface
std::vector<std::size_t> owners_of_faces(const std::vector<FlatPart>& parts, Eigen::Index faces)
{
    std::vector<std::size_t> owner(static_cast<std::size_t>(faces), 0);
    for (std::size_t k = 0; k < parts.size(); ++k)
        for (const Index f : parts[k].faces) owner[f] = k;
    return owner;
}

/// For each part the number of the other part with its first face. @param owner_of_face of the others
std::vector<std::size_t> owners(const std::vector<FlatPart>& parts, const std::vector<std::size_t>& owner_of_face)
{
    std::vector<std::size_t> owner;
    for (const FlatPart& part : parts) owner.push_back(owner_of_face[part.faces.front()]);
    return owner;
}

/// numbers[i] for each i.
std::vector<std::size_t> numbers_of(std::vector<std::size_t> of, const std::vector<std::size_t>& numbers)
{
    for (std::size_t& i : of) i = numbers[i];
    return of;
}

/// For each part before, the number of its group: parts that were joined are in one group.
std::vector<std::size_t> groups_before(const std::vector<FlatPart>& before, const std::vector<FlatPart>& parts,
                                       const std::vector<std::size_t>& owner_of_face)
{
    DisjointSets sets(before.size());
    for (const FlatPart& part : parts)
        for (const Index f : part.faces)
            sets.join(static_cast<Index>(owner_of_face[part.faces.front()]), static_cast<Index>(owner_of_face[f]));
    std::vector<std::size_t> group;
    for (std::size_t k = 0; k < before.size(); ++k)
        group.push_back(static_cast<std::size_t>(sets.find(static_cast<Index>(k))));
    return group;
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
        const std::vector<std::size_t> owner = owners_of_faces(before, own.named().triangles.rows());
        own.uncut_group = groups_before(before, own.parts, owner);
        own.group = numbers_of(owners(own.parts, owner), own.uncut_group);
        own.conformal = std::move(before);
        return;
    }
    std::vector<FlatPart> fine = carried_parts(*own.proxy, own.parts, options_.threads, context_);
    if (fine.empty()) {
        own.parts = std::move(before);
        lay(own);
        carry(own, own.parts);
        return;
    }

    // Parts of the proxy: those of one group were one part there before darts and through cuts. Where parts were
    // joined, each face is in the part before that has the coarse face near it.
    const std::vector<std::size_t> owner = owners_of_faces(before, own.proxy->surface.triangles.rows());
    const std::vector<std::size_t> first = owners(own.parts, owner), joined = groups_before(before, own.parts, owner);
    own.group = numbers_of(first, joined);
    for (std::size_t k = 0; k < joined.size(); ++k) own.is_joined = own.is_joined || joined[k] != k;
    const NearFaces near(*own.proxy);
    std::vector<std::vector<Index>> faces(before.size());
    for (std::size_t k = 0; k < fine.size(); ++k)
        for (const Index f : fine[k].faces) {
            const Index at = own.is_joined ? near.nearest(f) : -1;
            faces[at >= 0 && joined[owner[at]] == own.group[k] ? owner[at] : first[k]].push_back(f);
        }
    own.conformal = laid(own, faces, MapPurpose::judging);
    own.uncut_group =
        numbers_of(owners(own.conformal, owners_of_faces(fine, own.proxy->fine.whole.areas.size())), own.group);
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
    own.uncut_group =
        numbers_of(owners(exact, owners_of_faces(own.conformal, own.proxy->fine.whole.areas.size())), own.uncut_group);
    own.conformal = std::move(exact);
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

bool FineParts::can_go_back(const std::vector<std::size_t>& groups) const
{
    std::size_t first = 0;
    for (const MeshPiece& own : pieces_) {
        const std::size_t end = first + groups_of(own);
        if (own.is_joined && std::ranges::any_of(groups, [&](std::size_t k) { return k >= first && k < end; }))
            return false;
        first = end;
    }
    return true;
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
