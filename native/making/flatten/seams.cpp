#include "flatten/seams.h"

#include "core/numbering.h"
#include "parts/flat_mesh.h"

#include <algorithm>
#include <utility>

namespace koebe {
namespace {

/// An edge of a rim, from one vertex of its part to the next.
struct RimEdge {
    std::size_t part;
    Index from, to;
    Index from_place, to_place;
    std::size_t previous, next;  // rim edges
    std::size_t edge = 0;        // of the surface
};

class Rims {
public:
    Rims(const std::vector<FlatPart>& parts, const Vertices& vertices)
    {
        const std::vector<Index> place = first_in_place(vertices);
        for (std::size_t p = 0; p < parts.size(); ++p)
            for (const VertexLoop& loop : parts[p].surface.loops) {
                const std::size_t first = rims_.size(), count = loop.size();
                for (std::size_t i = 0; i < count; ++i) {
                    const Index a = loop[i], b = loop[(i + 1) % count];
                    rims_.push_back({p, a, b, place[parts[p].original[a]], place[parts[p].original[b]],
                                     first + (i + count - 1) % count, first + (i + 1) % count});
                }
            }
        std::vector<std::size_t> order = numbers_below<std::size_t>(rims_.size());
        std::ranges::stable_sort(order, {}, [&](std::size_t r) { return ends(r); });
        for (std::size_t i = 0; i < order.size(); ++i) {
            const auto [low, high] = ends(order[i]);
            if (i == 0 || low == high || ends(order[i]) != ends(order[i - 1])) sides_.emplace_back();
            rims_[order[i]].edge = sides_.size() - 1;
            sides_.back().push_back(order[i]);
        }
    }

    std::vector<Seam> seams() const
    {
        std::vector<Seam> seams;
        std::vector<char> done(sides_.size(), 0);
        for (std::size_t r = 0; r < rims_.size(); ++r) {
            if (done[rims_[r].edge] || sides(r).size() < 2) continue;
            auto [run, closed] = run_through(r);
            for (const std::size_t one : run) done[rims_[one].edge] = 1;
            Seam seam{{}, closed};
            for (const std::size_t side : sides(run.front())) add_side(run, side, seam);
            if (seam.sides.size() > 1) seams.push_back(std::move(seam));
        }
        return seams;
    }

private:
    std::pair<Index, Index> ends(std::size_t r) const { return std::minmax(rims_[r].from_place, rims_[r].to_place); }
    const std::vector<std::size_t>& sides(std::size_t r) const { return sides_[rims_[r].edge]; }
    std::size_t neighbour(std::size_t r, bool forward) const { return forward ? rims_[r].next : rims_[r].previous; }

    /// Whether all sides of an edge go on to the same edge.
    bool goes_on(std::size_t r, bool forward) const
    {
        const std::size_t beside = neighbour(r, forward);
        const Index at = forward ? rims_[r].to_place : rims_[r].from_place;
        if (rims_[beside].edge == rims_[r].edge || sides(beside).size() != sides(r).size()) return false;
        return std::ranges::all_of(sides(r), [&](std::size_t side) {
            return rims_[neighbour(side, rims_[side].to_place == at)].edge == rims_[beside].edge;
        });
    }

    /// The rim edges of a seam along one of its sides; of a closed one from the vertex of the lowest number.
    std::pair<std::vector<std::size_t>, bool> run_through(std::size_t r) const
    {
        std::size_t first = r;
        bool closed = false;
        while (!closed && goes_on(first, false)) {
            first = rims_[first].previous;
            closed = first == r;
        }
        std::vector<std::size_t> run{first};
        while (goes_on(run.back(), true) && rims_[run.back()].next != first) run.push_back(rims_[run.back()].next);
        if (closed)
            std::ranges::rotate(run, std::ranges::min_element(run, {}, [&](auto k) { return rims_[k].from_place; }));
        return {std::move(run), closed};
    }

    void add_side(const std::vector<std::size_t>& run, std::size_t side, Seam& seam) const
    {
        const bool forward = rims_[side].from_place == rims_[run.front()].from_place;
        SeamSide found{rims_[side].part, {forward ? rims_[side].from : rims_[side].to}, forward};
        for (const std::size_t along : run) {
            if (rims_[side].edge != rims_[along].edge) return;
            found.path.push_back(forward ? rims_[side].to : rims_[side].from);
            side = neighbour(side, forward);
        }
        seam.sides.push_back(std::move(found));
    }

    std::vector<RimEdge> rims_;
    std::vector<std::vector<std::size_t>> sides_;  // of each edge of the surface
};

}  // namespace

std::vector<Seam> find_seams(const std::vector<FlatPart>& parts, const Vertices& vertices)
{
    return Rims(parts, vertices).seams();
}

}  // namespace koebe
