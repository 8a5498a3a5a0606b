#include "core/connectivity.h"
#include "execution/profile.h"
#include "execution/side_by_side.h"
#include "splitting/piece_forecast.h"
#include "splitting/splitting.h"

#include <algorithm>
#include <map>
#include <set>

namespace koebe {
namespace {

constexpr double worth_mapping = -0.25;  // of a part's price: with a larger predicted gain the merged part is mapped
constexpr std::size_t most_at_once = 4;  // merges tried side by side, for any number of threads
constexpr std::size_t few = 20;          // a part with fewer faces is small, and
constexpr std::size_t small = 400;       // a part with less than one face in so many of the whole
constexpr double sure = 0.5;             // of price and forecast: a larger gain needs no map

/// The smallest part from which both parts come.
std::shared_ptr<const Part> common_origin(const Part& a, const Part& b)
{
    std::set<const Part*> origins;
    for (auto p = a.parent; p; p = p->parent) origins.insert(p.get());
    for (auto p = b.parent; p; p = p->parent)
        if (origins.contains(p.get())) return p;
    return {};
}

/// Lengths of the borders between parts, as cuts.
std::map<std::pair<int, int>, double> borders(const CutSurface& whole, const std::vector<PartPointer>& parts)
{
    std::vector<int> label(whole.areas.size(), -1);
    for (std::size_t k = 0; k < parts.size(); ++k)
        for (const Index f : parts[k]->mesh.faces) label[f] = static_cast<int>(k);
    std::map<std::pair<int, int>, double> result;
    for (Index h = 0; h < static_cast<Index>(whole.surface.twin.size()); ++h) {
        const Index t = whole.surface.twin[h];
        if (t == no_twin || t < h) continue;
        const int a = label[face_of(h)], b = label[face_of(t)];
        if (a != b) result[std::minmax(a, b)] += length_as_cut(whole, h);
    }
    return result;
}

/// Both parts as one, not mapped yet; empty if they are all faces of a closed surface.
PartPointer joined(const CutSurface& whole, const Part& a, const Part& b, std::shared_ptr<const Part> origin)
{
    std::vector<Index> faces = a.mesh.faces;
    faces.insert(faces.end(), b.mesh.faces.begin(), b.mesh.faces.end());
    if (faces.size() == static_cast<std::size_t>(whole.areas.size()) && whole.surface.loops.empty()) return {};
    auto both = std::make_shared<Part>();
    both->mesh = part_mesh(whole, std::move(faces));
    both->parent = std::move(origin);
    return both;
}

/// The cost of both parts, and the price of having two.
double cost_apart(const Part& a, const Part& b, double border, const SplitOptions& options)
{
    return a.map.overflow + b.map.overflow + options.of(1.0, border);
}

/// The most that both parts may cost as one: less than apart, and not so much that any cut in two is better.
double most_as_one(const Part& a, const Part& b, double border, const SplitOptions& options)
{
    return std::min(cost_apart(a, b, border, options), most_uncut(a.mesh.area + b.mesh.area, options.part_price));
}

/// Both parts as one, if that is better. For parts of the two halves of a closed surface: they have no common origin.
PartPointer merged_halves(const CutSurface& whole, const Part& a, const Part& b, double saved,
                          ExecutionContext& context, SplitEffort& effort)
{
    PartPointer both = joined(whole, a, b, {});
    if (!both) return {};
    map_anew(whole, *both, context, effort);
    return both->map.overflow < saved ? both : PartPointer{};
}

/// Both parts as one, if that is better.
PartPointer merged(const CutSurface& whole, const SplitOptions& options, const Part& a, const Part& b, double border,
                   ExecutionContext& context, SplitEffort& effort)
{
    const double saved = most_as_one(a, b, border, options);
    const auto origin = common_origin(a, b);
    if (!origin) return merged_halves(whole, a, b, saved, context, effort);
    std::vector<Index> piece(origin->mesh.faces.size(), -1);
    for (const Part* part : {&a, &b}) {
        auto at = origin->mesh.faces.begin();
        for (const Index f : part->mesh.faces) {
            at = std::lower_bound(at, origin->mesh.faces.end(), f);
            piece[at - origin->mesh.faces.begin()] = 0;
        }
    }
    if (origin->map.measured && std::ranges::count(piece, 0) == static_cast<std::ptrdiff_t>(piece.size())) {
        // The cut that was made there is taken back, and not made again.
        if (!(origin->map.overflow < saved)) return {};
        return std::make_shared<Part>(Part{origin->mesh, origin->map, origin->parent, true});
    }
    const PieceForecast forecast = forecast_pieces(origin->mesh, origin->map, piece, 1).front();
    if (forecast.lost_area > 0.0 || saved - forecast.overflow < worth_mapping * options.part_price) return {};
    PartPointer both = joined(whole, a, b, origin);
    if (saved - forecast.overflow > sure * (options.part_price + forecast.overflow)) {
        both->map =
            restricted_map(origin->mesh, origin->map, both->mesh);  // mapped when nothing more is merged into it
        if (both->map.overflow < saved) return both;
    }
    map_anew(whole, *both, context, effort);
    return both->map.overflow < saved ? both : PartPointer{};
}

}  // namespace

bool merge_parts(const CutSurface& whole, const SplitOptions& options, std::vector<PartPointer>& parts,
                 RefusedMerges& refused, ExecutionContext& context, SplitEffort& effort)
{
    const ProfiledStage profiled("merge");
    struct Candidate {
        PartPointer a, b;
        double border;
    };
    std::map<std::pair<PartPointer, PartPointer>, PartPointer> tried;  // with the result, perhaps empty
    const auto try_all = [&](const std::vector<Candidate>& wave) {
        std::vector<PartPointer> results(wave.size());
        std::vector<SplitEffort> efforts(wave.size());
        side_by_side(wave.size(), options.threads, context, [&](std::size_t i, ExecutionContext& own) {
            results[i] = merged(whole, options, *wave[i].a, *wave[i].b, wave[i].border, own, efforts[i]);
        });
        for (std::size_t i = 0; i < wave.size(); ++i) {
            tried[{wave[i].a, wave[i].b}] = std::move(results[i]);
            effort.maps += efforts[i].maps;
        }
    };
    bool any = false;
    for (bool changed = true; changed;) {
        changed = false;
        std::vector<Candidate> order;
        for (const auto& [pair, length] : borders(whole, parts))
            if (const Candidate next{parts[pair.first], parts[pair.second], length};
                !refused.contains({next.a, next.b}))
                order.push_back(next);
        std::ranges::reverse(order);
        std::ranges::stable_sort(order, [](const Candidate& x, const Candidate& y) { return x.border > y.border; });
        for (std::size_t i = 0; i < order.size() && !changed; ++i) {
            context.checkpoint();
            const auto& [a, b, border] = order[i];
            if (!tried.contains({a, b})) {
                // Together with the next pairs that share no part: their results stay valid.
                std::vector<Candidate> wave;
                std::set<PartPointer> taken;
                for (std::size_t k = i; k < order.size() && wave.size() < most_at_once; ++k) {
                    const Candidate& next = order[k];
                    const bool is_free = !taken.contains(next.a) && !taken.contains(next.b);
                    taken.insert({next.a, next.b});
                    if (is_free && !tried.contains({next.a, next.b})) wave.push_back(next);
                }
                try_all(wave);
            }
            if (PartPointer both = tried.at({a, b})) {
                std::erase(parts, b);
                *std::ranges::find(parts, a) = std::move(both);
                any = changed = true;
            } else {
                refused.insert({a, b});
            }
        }
    }
    std::vector<Part*> unmapped;
    for (const PartPointer& part : parts)
        if (!part->map.measured) unmapped.push_back(part.get());
    map_all(whole, unmapped, options.threads, context, effort);
    return any;
}

void merge_small_parts(const CutSurface& whole, const SplitOptions& options, std::vector<PartPointer>& parts,
                       ExecutionContext& context, SplitEffort& effort)
{
    std::set<PartPointer> kept;
    const std::size_t largest = std::max(few, static_cast<std::size_t>(whole.areas.size()) / small);
    for (;;) {
        const auto found = std::ranges::find_if(
            parts, [&](const PartPointer& part) { return part->mesh.faces.size() < largest && !kept.contains(part); });
        if (found == parts.end()) return;
        // The neighbour for which both as one cost least, if they lose no more area.
        const int own = static_cast<int>(found - parts.begin());
        PartPointer best;
        int neighbour = -1;
        double best_gain = -options.part_price;
        for (const auto& [pair, length] : borders(whole, parts)) {
            if (pair.first != own && pair.second != own) continue;
            context.checkpoint();
            const int other = pair.first == own ? pair.second : pair.first;
            const Part& a = *parts[own];
            const Part& b = *parts[other];
            PartPointer both = joined(whole, a, b, common_origin(a, b));
            if (!both) continue;
            map_anew(whole, *both, context, effort);
            if (both->map.overflow > most_uncut(both->mesh.area, options.part_price)) continue;
            const double gain = cost_apart(a, b, length, options) - both->map.overflow;
            if (both->map.lost_area > a.map.lost_area + b.map.lost_area || gain <= best_gain) continue;
            best_gain = gain;
            best = std::move(both);
            neighbour = other;
        }
        // Merge them, or let the part be.
        if (neighbour < 0) {
            kept.insert(*found);
            continue;
        }
        parts[std::min(own, neighbour)] = std::move(best);
        parts.erase(parts.begin() + std::max(own, neighbour));
    }
}

}  // namespace koebe
