// Room for the flat regions of hard surfaces: cut between their planes where the pieces fill the square better.
#pragma once

#include "execution/execution.h"
#include "hard/flat_charts.h"

#include <vector>

namespace koebe {

/// Parts, cut between planar regions where the pieces need less room in the square (roomy_cuts.h). No cut runs through
/// a region, a polygon, or between faces that meet at less than a degree.
/// @param parts true to size, laid of these charts @return empty: nowhere
std::vector<FlatPart> cut_between_planes(const CutSurface& surface, const FlatCharts& charts,
                                         const std::vector<FlatPart>& parts, ExecutionContext& context);

/// Whether parts that were cut for room are worth it: their texels must grow by their number to the power
/// larger_by_count.
bool are_worth_their_number(const std::vector<FlatPart>& roomier, const std::vector<FlatPart>& parts);

/// The scale at which parts fill the square, packed quickly with the usual margin.
double quickly_packed_scale(const std::vector<FlatPart>& parts);

}  // namespace koebe
