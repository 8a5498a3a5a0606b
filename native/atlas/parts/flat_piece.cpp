#include "parts/flat_piece.h"

#include "core/numbering.h"
#include "cost/costs.h"
#include "splitting/hidden_cuts.h"
#include "splitting/mirror_symmetry.h"
#include "splitting/straight_borders.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <utility>

namespace koebe {
namespace {

constexpr int rounds = 2;  // of splitting and merging

double overflow_of(const std::vector<PartPointer>& parts)
{
    double sum = 0.0;
    for (const PartPointer& part : parts) sum += part->map.overflow;
    return sum;
}

/// Splits and merges parts, and maps them. A cut that pays only together with later cuts is found at lower prices;
/// merging takes back what did not pay in the end. The parts stay as they were if cuts bring next to nothing, for
/// example between many tight holes. @param first faces of the first parts; empty: one part with all faces
std::vector<PartPointer> even_parts(const CutSurface& whole, std::vector<std::vector<Index>> first,
                                    const SplitOptions& options, ExecutionContext& context, SplitEffort& effort)
{
    std::vector<PartPointer> uncut = first_parts(whole, std::move(first), context, effort);
    std::vector<PartPointer> parts = uncut;
    const SplitOptions eagerly{options.eager(), options.threads};
    RefusedMerges refused;
    for (int round = 0; round < rounds; ++round) {
        parts = split_parts(whole, eagerly, std::move(parts), context, effort);
        if (parts.size() > uncut.size() && overflow_of(parts) > overflow_of(uncut)) return uncut;
        if (parts.size() == 1 || !merge_parts(whole, options, parts, refused, context, effort)) break;
    }
    merge_small_parts(whole, options, parts, context, effort);
    return parts;
}

/// The part from which all parts were cut; null: there is none.
std::shared_ptr<const Part> root_of(const std::vector<PartPointer>& parts, const CutSurface& whole)
{
    std::shared_ptr<const Part> root = parts.front();
    while (root->parent) root = root->parent;
    return root->mesh.faces.size() == static_cast<std::size_t>(whole.areas.size()) ? root : nullptr;
}

}  // namespace

EvenOptions evening_of(const PartsOptions& options, bool roomy, int threads)
{
    const bool round = options.loops == LoopForm::round || (options.loops == LoopForm::automatic && options.round_cuts);
    return {options.even, round ? LoopForm::round : LoopForm::free, options.darts, part_as_length(options.price), roomy,
            threads};
}

bool rims_are_free(const PartsOptions& options)
{
    return options.slits.empty() && !options.round_cuts && options.even != 0.0 &&
           evening_of(options, false, 1).loops == LoopForm::free;
}

FlatParts flat_piece(const PieceInput& input, PieceSurface surface, const PartsOptions& options, int threads,
                     ExecutionContext& context, SplitEffort& effort)
{
    // Cut it where that pays, alike on both sides of a mirror, and hide and straighten the cuts.
    CutSurface& whole = surface.whole;
    const bool is_closed = whole.surface.loops.empty();
    const SplitOptions prices{prices_of_piece(whole.areas.sum(), options.price), threads};
    std::vector<PartPointer> parts = even_parts(whole, std::move(surface.first), prices, context, effort);
    const Mirror mirror = find_mirror(whole.vertices, whole.surface.triangles, whole.polygon);
    bool is_symmetric = make_symmetric(whole, prices, mirror, parts, context, effort);
    if (!is_symmetric && !mirror.image.empty()) {  // begin with the sides of the plane
        std::vector<PartPointer> own = even_parts(whole, faces_of_sides(whole, mirror), prices, context, effort);
        is_symmetric =
            make_symmetric(whole, prices, mirror, own, context, effort) && is_worth_symmetry(whole, prices, own, parts);
        if (is_symmetric) parts = std::move(own);
    }
    const std::vector<PartPointer> before = parts;
    hide_cuts(whole, prices, parts, context, effort);
    straighten_borders(whole, prices, parts, context, effort);
    if (is_symmetric && !make_symmetric(whole, prices, mirror, parts, context, effort)) parts = before;
    merge_small_parts(whole, prices, parts, context, effort);
    std::ranges::sort(parts, [](const PartPointer& a, const PartPointer& b) { return a->mesh.faces < b->mesh.faces; });

    // Lay the parts flat. A part that was cut for its flaws has been tried as one part.
    const std::shared_ptr<const Part> root = root_of(parts, whole);
    const bool is_cut = parts.size() > 1;
    FlatParts flats = flat_parts(whole, mirror, parts, {prices, options.round_cuts}, threads, context, effort);
    if (is_cut || flats.parts.size() == 1)
        if (auto one = better_as_one(is_closed ? opened_surface(input) : whole, root.get(), flats, prices.part_price,
                                     context)) {
            flats.parts.clear();
            flats.parts.push_back(std::move(*one));
        }
    for (FlatPart& part : flats.parts) part.image = values_at(mirror.vertex, part.original);
    note_shown(input.shown, flats.parts);
    return flats;
}

}  // namespace koebe
