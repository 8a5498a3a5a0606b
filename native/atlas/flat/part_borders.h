// The borders along which flat parts of one surface meet.
#pragma once

#include "core/connectivity.h"
#include "flat/flat_part.h"

#include <map>
#include <optional>
#include <vector>

namespace koebe {

/// An edge on the boundary of a part.
struct PartEdge {
    std::size_t part = 0;
    Index halfedge = no_twin;
};

/// Edges of two parts, one after the other in both. In the second part they run backwards.
struct PartBorder {
    std::size_t first = 0, second = 0;       ///< parts
    std::vector<Index> of_first, of_second;  ///< half-edges; those at the same place are one edge
    bool is_ring = false;                    ///< the last edge ends where the first one begins

    std::size_t edges() const { return of_first.size(); }
    bool is_slit() const { return first == second; }
};

class PartBorders {
public:
    /// @param parts they stay while this is used
    explicit PartBorders(const std::vector<FlatPart>& parts);

    const std::vector<PartBorder>& all() const { return borders_; }

    /// The vertices of a border in its first part and in its second, from 0 to edges().
    std::pair<Index, Index> vertices_at(const PartBorder& border, std::size_t place) const;

    /// The edge as it is named in the whole, and its mirror image, of a part that has one.
    EdgeEnds name(const PartEdge& edge) const;
    EdgeEnds image(const PartEdge& edge) const;

    /// The two places of an edge that lies between two parts; empty if it does not.
    const std::vector<PartEdge>* find(const EdgeEnds& name) const;

private:
    std::optional<PartEdge> beyond(const PartEdge& edge) const;
    std::optional<PartEdge> after(const PartEdge& edge) const;
    PartBorder border_through(const PartEdge& edge) const;

    const std::vector<FlatPart>& parts_;
    std::vector<std::vector<Index>> leaving_;          // (parts, V) the half-edge of the boundary that leaves a vertex
    std::map<EdgeEnds, std::vector<PartEdge>> edges_;  // of all boundaries
    std::vector<PartBorder> borders_;
};

}  // namespace koebe
