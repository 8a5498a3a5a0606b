// Splits a surface into parts where that pays, maps the parts, and merges them again where a cut does not pay.
#pragma once

#include "cost/costs.h"
#include "part_maps/part_map.h"

#include <memory>
#include <set>
#include <utility>
#include <vector>

namespace koebe {

struct SplitOptions : CutPrices {
    int threads = 1;  ///< most threads; 0: one for each core. The result is the same for any number
};

struct Part {
    PartMesh mesh;
    PartMap map;
    std::shared_ptr<const Part> parent = {};  ///< the part from which it was cut
    bool settled = false;                     ///< no split of this part pays
};

using PartPointer = std::shared_ptr<Part>;

/// The work of splitting.
struct SplitEffort {
    double maps = 0.0;  ///< number of faces mapped, over the faces of the surface
    int cuts = 0;       ///< number of minimum cuts
};

/// Maps a part anew. The map only judges if that is its purpose, or that of all maps of the whole.
void map_anew(const CutSurface& whole, Part& part, ExecutionContext& context, SplitEffort& effort,
              MapPurpose purpose = MapPurpose::result);

/// Maps parts anew, side by side.
void map_all(const CutSurface& whole, const std::vector<Part*>& parts, int threads, ExecutionContext& context,
             SplitEffort& effort);

/// Makes and maps the parts with these faces. Without faces: one part with all faces.
std::vector<PartPointer> first_parts(const CutSurface& whole, std::vector<std::vector<Index>> faces,
                                     ExecutionContext& context, SplitEffort& effort);

/// Cuts a part in two across its length (halving.h), whatever its map says. Maps each piece. @return empty if no curve
/// was found
std::vector<PartPointer> halved(const CutSurface& whole, const PartPointer& part, int threads,
                                ExecutionContext& context, SplitEffort& effort);

/// Splits each part by the proposal of most gain, until no split pays. The parent's map judges the children. A child is
/// mapped before it is judged if its loops are not round in the parent's map. Every part that stays has a map of its
/// own.
std::vector<PartPointer> split_parts(const CutSurface& whole, const SplitOptions& options,
                                     std::vector<PartPointer> parts, ExecutionContext& context, SplitEffort& effort);

/// Pairs of neighbours that must not be merged: they are better apart.
using RefusedMerges = std::set<std::pair<PartPointer, PartPointer>>;

/// Merges neighbours whose cut does not pay, the longest common border first. The map of their common origin judges
/// them. Then the merged part is mapped.
/// @param refused pairs from earlier calls; new pairs are added @return whether any parts were merged
bool merge_parts(const CutSurface& whole, const SplitOptions& options, std::vector<PartPointer>& parts,
                 RefusedMerges& refused, ExecutionContext& context, SplitEffort& effort);

/// Merges each part of a few faces with a neighbour: the neighbour for which the merged part costs least. It does so
/// even if the cut pays by up to the price of a part: nobody wants to paint on small parts.
void merge_small_parts(const CutSurface& whole, const SplitOptions& options, std::vector<PartPointer>& parts,
                       ExecutionContext& context, SplitEffort& effort);

}  // namespace koebe
