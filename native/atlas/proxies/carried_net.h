// The net of cuts of a coarse surface, drawn along the edges of the fine one.
#pragma once

#include "execution/execution.h"
#include "proxies/proxy.h"
#include "splitting/straight_paths.h"

#include <optional>
#include <vector>

namespace koebe {

/// How flat parts cut the coarse surface.
struct CoarseNet {
    /// A face in its part.
    struct Place {
        int part = -1;
        Index face = -1;
    };
    std::vector<Place> place;  ///< (F)
    std::vector<char> open;    ///< (3F) 1 for half-edges on the boundary of a part

    bool parts_differ(const Surface& surface, Index halfedge) const;
};

/// @param parts they name faces and vertices of the coarse surface @return no value if they do not hold each face once
std::optional<CoarseNet> coarse_net(const Proxy& proxy, const std::vector<FlatPart>& parts);

/// A chain of coarse edges, from one fork, tip or place of the boundary to the next, and its path of fine edges.
struct CarriedPath {
    Path chain, path;
};

/// A short path of fine edges near each chain of the net. Paths do not meet, except at their ends, do not touch the
/// boundary between them, and spare polygons. A dart or slit may have no path.
std::vector<CarriedPath> carried_paths(const Proxy& proxy, const CoarseNet& net, const ExecutionContext& context);

/// The same paths, straightened (straight_paths.h).
std::vector<CarriedPath> straightened(const Proxy& proxy, std::vector<CarriedPath> paths,
                                      const ExecutionContext& context);

}  // namespace koebe
