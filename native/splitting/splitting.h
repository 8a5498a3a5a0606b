// The parts of a surface: split where it pays, mapped, and merged again where a cut does not.
#pragma once

#include "evenness/part_map.h"

#include <memory>
#include <set>
#include <utility>
#include <vector>

namespace koebe {

struct SplitOptions {
    double part_price = 0.0037;  ///< of a part, in overflow
    double cut_price = 0.0037;   ///< of a cut as long as the root of the area
    int threads = 1;             ///< at most; 0: as many as the machine has. The result is the same for any number
};

struct Part {
    PartMesh mesh;
    PartMap map;
    std::shared_ptr<const Part> parent = {};  ///< of which it is some of the faces
    bool settled = false;                     ///< no split of it pays
};

using PartPointer = std::shared_ptr<Part>;

/// What the splitting took.
struct SplitEffort {
    double maps = 0.0;  ///< faces mapped, in faces of the surface
    int cuts = 0;       ///< minimum cuts
};

/// Maps a part anew.
void map_anew(const CutSurface& whole, Part& part, ExecutionContext& context, SplitEffort& effort);

/// Maps parts anew, side by side.
void map_all(const CutSurface& whole, const std::vector<Part*>& parts, int threads, ExecutionContext& context,
             SplitEffort& effort);

/// Parts of these faces, mapped; of all, as one, if there are none.
std::vector<PartPointer> first_parts(const CutSurface& whole, std::vector<std::vector<Index>> faces,
                                     ExecutionContext& context, SplitEffort& effort);

/// The part cut in two across its length (halving.h), whatever its map says, each piece with a map of its own; none if
/// no curve was found.
std::vector<PartPointer> halved(const CutSurface& whole, const PartPointer& part, int threads,
                                ExecutionContext& context, SplitEffort& effort);

/// Splits each part by the proposal of most gain, children judged by the parent's map, until nothing pays.
/// Children whose loops are not round there are mapped before they are judged. Every part that stays has a map of its
/// own.
std::vector<PartPointer> split_parts(const CutSurface& whole, const SplitOptions& options,
                                     std::vector<PartPointer> parts, ExecutionContext& context, SplitEffort& effort);

/// Pairs of neighbours that are better apart.
using RefusedMerges = std::set<std::pair<PartPointer, PartPointer>>;

/// Merges neighbours whose cut does not pay, the longest common border first: judged by the map of a part that both
/// come from, and then mapped.
/// @param refused known from an earlier call, and more of them @return whether any were
bool merge_parts(const CutSurface& whole, const SplitOptions& options, std::vector<PartPointer>& parts,
                 RefusedMerges& refused, ExecutionContext& context, SplitEffort& effort);

/// Merges parts of a few faces, which nobody wants to paint on or to stitch, with the neighbour that they cost the
/// least in, even where a cut pays by a few prices of a part.
void merge_crumbs(const CutSurface& whole, const SplitOptions& options, std::vector<PartPointer>& parts,
                  ExecutionContext& context, SplitEffort& effort);

}  // namespace koebe
