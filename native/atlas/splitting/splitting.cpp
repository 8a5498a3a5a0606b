#include "splitting/splitting.h"

#include "core/connectivity.h"
#include "core/length.h"
#include "core/numbering.h"
#include "cost/costs.h"
#include "execution/side_by_side.h"
#include "splitting/halving.h"
#include "splitting/piece_forecast.h"
#include "splitting/proposals.h"

#include <algorithm>
#include <utility>

namespace koebe {
namespace {

constexpr std::size_t most_looked_at = 8;  // most proposals of a part
constexpr std::size_t most_verified = 3;   // proposals whose children are mapped
constexpr double worth_verifying = 1.1;    // of the best gain so far, as forecast
constexpr double most_maps = 12.0;         // faces mapped, over the surface's: then parts that are open stay whole
constexpr std::size_t few_open = 3;        // with fewer open parts, the work for each part goes side by side too
constexpr double most_off_round = 0.12;    // radii: a child with a loop less round is mapped before it is judged, if it
                                           // is so large that its cost matters

struct Split {
    double gain = 0.0, border = 0.0;
    std::vector<Index> piece;                ///< (F) of the part
    std::vector<PieceForecast> forecasts;    ///< of each piece
    std::vector<PartPointer> children = {};  ///< of each piece, once they are made
};

double cost_of(const PartMap& map)
{
    return map.measured ? map.overflow : doubtful_overflow(map.overflow, map.lost_area);
}

double cost_of(const PieceForecast& forecast) { return doubtful_overflow(forecast.overflow, forecast.lost_area); }

double border_length(const PartMesh& part, const std::vector<int>& label)
{
    double length = 0.0;
    for (Index h = 0; h < static_cast<Index>(part.surface.twin.size()); ++h) {
        const Index t = part.surface.twin[h];
        if (t == no_twin || t < h || label[face_of(t)] == label[face_of(h)]) continue;
        length += length_of(part.vertices.row(origin(part.surface.triangles, h)) -
                            part.vertices.row(target(part.surface.triangles, h)));
    }
    return length;
}

void make_children(const CutSurface& whole, const PartPointer& part, Split& split)
{
    std::vector<std::vector<Index>> faces(split.forecasts.size());
    for (std::size_t f = 0; f < split.piece.size(); ++f) faces[split.piece[f]].push_back(part->mesh.faces[f]);
    for (auto& own : faces)
        split.children.push_back(std::make_shared<Part>(Part{part_mesh(whole, std::move(own)), {}, part}));
}

/// The gain by the maps of the children, or by forecasts for children without a map. Cutting off a small part must pay
/// by itself, without hope for later splits: otherwise small parts would be cut off one after the other.
double gain_of(const Split& split, const Part& part, const SplitOptions& options)
{
    const double price = options.of(static_cast<double>(split.forecasts.size() - 1), split.border);
    double left = 0.0, expected = 0.0, largest = 0.0;
    for (std::size_t k = 0; k < split.forecasts.size(); ++k) {
        const bool measured = k < split.children.size() && split.children[k]->map.positions.size() > 0;
        const double cost = measured ? cost_of(split.children[k]->map) : cost_of(split.forecasts[k]);
        left += cost;
        largest = std::max(largest, split.forecasts[k].area);
        expected += expected_cost(cost, options.part_price);
    }
    const double before = cost_of(part.map);
    const bool leaves_little = largest > tuning::nearly_all * part.mesh.area;
    return leaves_little && before < left ? -price : before - expected - price;
}

/// The splits that seem to pay, the best first.
std::vector<Split> promising_splits(const PartPointer& part, const SplitOptions& options, int threads,
                                    ExecutionContext& context, SplitEffort& effort)
{
    std::vector<Proposal> all = proposals(part->mesh, part->map, threads, context);
    std::ranges::stable_sort(all, [](const Proposal& a, const Proposal& b) { return a.area > b.area; });
    if (all.size() > most_looked_at) all.resize(most_looked_at);
    // A short border for each proposal, and each border once.
    std::vector<Split> splits;
    std::vector<std::vector<int>> labels(all.size());
    side_by_side(all.size(), threads, context, [&](std::size_t i, ExecutionContext& own) {
        own.checkpoint();
        labels[i] = minimum_cut(part->mesh, all[i].sides);
    });
    effort.cuts += static_cast<int>(all.size());
    std::vector<std::vector<int>> different;
    for (std::vector<int>& label : labels)
        if (!label.empty() && std::ranges::count(different, label) == 0) different.push_back(std::move(label));
    // What the pieces cost by the map of the part.
    splits.resize(different.size());
    side_by_side(different.size(), threads, context, [&](std::size_t i, ExecutionContext& own) {
        own.checkpoint();
        Split& split = splits[i];
        Index count = 0;
        split.border = border_length(part->mesh, different[i]);
        split.piece = connected_pieces(part->mesh, different[i], count);
        split.forecasts = forecast_pieces(part->mesh, part->map, split.piece, count);
        split.gain = gain_of(split, *part, options);
    });
    std::erase_if(splits, [](const Split& split) { return !(split.gain > 0.0); });
    std::ranges::stable_sort(splits, [](const Split& a, const Split& b) { return a.gain > b.gain; });
    return splits;
}

/// The split of most gain, after children that the part's map cannot judge have got maps of their own.
Split best_split(const CutSurface& whole, const PartPointer& part, const SplitOptions& options, int threads,
                 ExecutionContext& context, SplitEffort& effort)
{
    std::vector<Split> splits = promising_splits(part, options, threads, context, effort);
    Split best;
    for (std::size_t i = 0; i < std::min(splits.size(), most_verified); ++i) {
        Split& split = splits[i];
        if (split.gain <= worth_verifying * best.gain) break;
        make_children(whole, part, split);
        std::vector<Part*> unsure;
        for (std::size_t k = 0; k < split.children.size(); ++k)
            if (split.forecasts[k].off_round > most_off_round && split.forecasts[k].area > options.part_price)
                unsure.push_back(split.children[k].get());
        map_all(whole, unsure, threads, context, effort);
        split.gain = gain_of(split, *part, options);
        if (split.gain > best.gain) best = std::move(split);
    }
    for (const PartPointer& child : best.children)
        if (child->map.positions.size() == 0) child->map = restricted_map(part->mesh, part->map, child->mesh);
    return best;
}

}  // namespace

void map_anew(const CutSurface& whole, Part& part, ExecutionContext& context, SplitEffort& effort, MapPurpose purpose)
{
    context.checkpoint();
    part.map = map_part(part.mesh, std::min(purpose, whole.purpose), context);
    effort.maps += static_cast<double>(part.mesh.faces.size()) / static_cast<double>(whole.areas.size());
}

void map_all(const CutSurface& whole, const std::vector<Part*>& parts, int threads, ExecutionContext& context,
             SplitEffort& effort)
{
    std::vector<SplitEffort> efforts(parts.size());
    side_by_side(parts.size(), threads, context,
                 [&](std::size_t i, ExecutionContext& own) { map_anew(whole, *parts[i], own, efforts[i]); });
    for (const SplitEffort& own : efforts) effort.maps += own.maps;
}

std::vector<PartPointer> halved(const CutSurface& whole, const PartPointer& part, int threads,
                                ExecutionContext& context, SplitEffort& effort)
{
    std::vector<PartPointer> children;
    std::vector<Part*> unmapped;
    for (std::vector<Index>& faces : pieces_of(part->mesh, halving(part->mesh))) {
        children.push_back(std::make_shared<Part>(Part{part_mesh(whole, std::move(faces)), {}, part}));
        unmapped.push_back(children.back().get());
    }
    map_all(whole, unmapped, threads, context, effort);
    return children;
}

std::vector<PartPointer> first_parts(const CutSurface& whole, std::vector<std::vector<Index>> faces,
                                     ExecutionContext& context, SplitEffort& effort)
{
    if (faces.empty()) faces.push_back(numbers_below(whole.areas.size()));
    std::vector<PartPointer> parts;
    for (auto& own : faces) {
        parts.push_back(std::make_shared<Part>(Part{part_mesh(whole, std::move(own)), {}, {}}));
        map_anew(whole, *parts.back(), context, effort);
    }
    return parts;
}

namespace {

/// One step for a part: its children, or itself, settled.
struct Step {
    std::vector<PartPointer> open;
    PartPointer settled;
    SplitEffort effort;
};

/// @param is_late no part is split any more
Step take_step(const CutSurface& whole, const SplitOptions& options, const PartPointer& part, bool is_late, int threads,
               ExecutionContext& context)
{
    Step step;
    // A map that lost much of the part says nothing of its splits: map it anew.
    if (!part->map.measured && part->map.lost_area > tuning::noticeable * part->mesh.area)
        map_anew(whole, *part, context, step.effort);
    // Split where it pays.
    Split split;
    if (!part->settled && part->map.overflow > options.part_price && !is_late)
        split = best_split(whole, part, options, threads, context, step.effort);
    if (split.gain > 0.0) {
        step.open = std::move(split.children);
        return step;
    }
    // Else judge by a map of its own, which may show a split after all.
    if (!part->map.measured) {
        map_anew(whole, *part, context, step.effort);
        if (part->map.overflow > options.part_price && !is_late) {
            step.open.push_back(part);
            return step;
        }
    }
    // Texels so uneven that any cut is better.
    if (part->map.overflow > most_uncut(part->mesh.area, options.part_price) && !is_late)
        step.open = halved(whole, part, threads, context, step.effort);
    if (!step.open.empty()) return step;
    part->settled = true;
    step.settled = part;
    return step;
}

}  // namespace

std::vector<PartPointer> split_parts(const CutSurface& whole, const SplitOptions& options,
                                     std::vector<PartPointer> open, ExecutionContext& context, SplitEffort& effort)
{
    std::vector<PartPointer> done;
    while (!open.empty()) {
        // The largest first: they take longest.
        std::ranges::stable_sort(open, [](const PartPointer& a, const PartPointer& b) {
            return a->mesh.faces.size() > b->mesh.faces.size();
        });
        std::vector<Step> steps(open.size());
        const bool is_late = effort.maps > most_maps;
        const int inner = open.size() <= few_open ? options.threads : 1;
        side_by_side(open.size(), options.threads, context, [&](std::size_t i, ExecutionContext& own) {
            steps[i] = take_step(whole, options, open[i], is_late, inner, own);
        });
        open.clear();
        for (Step& step : steps) {
            effort.maps += step.effort.maps;
            effort.cuts += step.effort.cuts;
            std::ranges::move(step.open, std::back_inserter(open));
            if (step.settled) done.push_back(std::move(step.settled));
        }
    }
    return done;
}

}  // namespace koebe
