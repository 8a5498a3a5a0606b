// Flat parts packed into the unit square, or onto tiles.
#pragma once

#include "execution/execution.h"
#include "flat/flat_part.h"
#include "parts/twins.h"

#include <optional>
#include <vector>

namespace koebe {

/// A scale that all parts get, in place of the largest scale at which they fit.
struct WantedScale {
    double scale = 1.0;    ///< sides of the square per unit of the points
    double density = 1.0;  ///< texel density at this scale, for messages
};

struct PackOptions {
    std::optional<WantedScale> wanted = {};       ///< with it the parts lie together at the corner of the square
    int tiles = 1;                                ///< tiles (tile_packing.h); 0: as many as the wanted scale needs
    std::vector<std::optional<Twin>> twins = {};  ///< of parts, if they shall lie on each other; empty: no part shall
    double margin = 0.0;                          ///< between parts, in sides of the square
    int threads = 0;
};

struct PackedParts {
    std::vector<PlanarPoints> places;        ///< of each part, its points (V, 2) in [0, 1]^2, or on its tile
    std::vector<char> anew;                  ///< 1: the part overlapped itself there, and was drawn anew, less even
    std::vector<std::optional<Twin>> twins;  ///< of each part, if it lies on another part
    int tiles = 1;                           ///< tiles with parts: the first ones
    double margin = 0.0;                     ///< that was kept
};

/// Packs parts into the unit square or onto tiles, then turns flipped faces back there. If a repair changes an outline,
/// all parts are packed again. In the last round a repair may not change an outline. A twin that would not lie as it
/// should there is packed by itself.
/// @param flats their kinds and points may change
/// @throws InputError the parts do not fit at the wanted scale; SolverError, Cancelled
PackedParts pack_parts(std::vector<FlatPart>& flats, const PackOptions& options, ExecutionContext& context);

}  // namespace koebe
