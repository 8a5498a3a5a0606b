#include "flat/part_borders.h"

#include "core/connectivity.h"

#include <set>
#include <utility>

namespace koebe {

PartBorders::PartBorders(const std::vector<FlatPart>& parts) : parts_(parts)
{
    for (std::size_t k = 0; k < parts.size(); ++k) {
        const Surface& surface = parts[k].surface;
        leaving_.emplace_back(static_cast<std::size_t>(surface.vertex_count), no_twin);
        for (Index h = 0; h < static_cast<Index>(surface.twin.size()); ++h) {
            if (surface.twin[h] != no_twin) continue;
            leaving_.back()[origin(surface.triangles, h)] = h;
            edges_[name({k, h})].push_back({k, h});
        }
    }
    std::set<std::pair<std::size_t, Index>> taken;
    for (std::size_t k = 0; k < parts.size(); ++k)
        for (const Index h : leaving_[k]) {
            if (h == no_twin || taken.contains({k, h})) continue;
            const auto other = beyond({k, h});
            if (!other || other->part < k) continue;
            borders_.push_back(border_through({k, h}));
            for (const Index own : borders_.back().of_first) taken.emplace(k, own);
            if (other->part == k)
                for (const Index own : borders_.back().of_second) taken.emplace(k, own);
        }
}

std::pair<Index, Index> PartBorders::vertices_at(const PartBorder& border, std::size_t place) const
{
    const Triangles &first = parts_[border.first].surface.triangles, &second = parts_[border.second].surface.triangles;
    if (place < border.edges()) return {origin(first, border.of_first[place]), target(second, border.of_second[place])};
    return {target(first, border.of_first.back()), origin(second, border.of_second.back())};
}

EdgeEnds PartBorders::name(const PartEdge& edge) const
{
    const FlatPart& part = parts_[edge.part];
    return sorted_ends(part.original[origin(part.surface.triangles, edge.halfedge)],
                       part.original[target(part.surface.triangles, edge.halfedge)]);
}

EdgeEnds PartBorders::image(const PartEdge& edge) const
{
    const FlatPart& part = parts_[edge.part];
    return sorted_ends(part.image[origin(part.surface.triangles, edge.halfedge)],
                       part.image[target(part.surface.triangles, edge.halfedge)]);
}

const std::vector<PartEdge>* PartBorders::find(const EdgeEnds& name) const
{
    const auto found = edges_.find(name);
    if (found == edges_.end() || found->second.size() != 2) return {};
    return &found->second;
}

/// The same edge in the other part.
std::optional<PartEdge> PartBorders::beyond(const PartEdge& edge) const
{
    const std::vector<PartEdge>* both = find(name(edge));
    if (!both) return {};
    const PartEdge& first = (*both)[0];
    return (*both)[first.part == edge.part && first.halfedge == edge.halfedge ? 1 : 0];
}

/// The next edge of the same border, in the direction of this part's boundary.
std::optional<PartEdge> PartBorders::after(const PartEdge& edge) const
{
    const PartEdge next{edge.part, leaving_[edge.part][target(parts_[edge.part].surface.triangles, edge.halfedge)]};
    const auto here = beyond(edge), there = beyond(next);
    if (!there || there->part != here->part || next.halfedge == here->halfedge) return {};
    const Triangles& triangles = parts_[there->part].surface.triangles;
    if (target(triangles, there->halfedge) != origin(triangles, here->halfedge)) return {};
    return next;
}

PartBorder PartBorders::border_through(const PartEdge& edge) const
{
    // Back to its first edge: in the other part the border runs the other way.
    PartEdge start = edge;
    while (const auto before = after(*beyond(start))) {
        start = *beyond(*before);
        if (start.halfedge == edge.halfedge) break;
    }
    PartBorder border{edge.part, beyond(edge)->part, {}, {}, false};
    for (PartEdge own = start;;) {
        border.of_first.push_back(own.halfedge);
        border.of_second.push_back(beyond(own)->halfedge);
        const auto next = after(own);
        border.is_ring = next && next->halfedge == start.halfedge;
        if (!next || border.is_ring) return border;
        own = *next;
    }
}

}  // namespace koebe
