// From the images of the loops to the map: circles, position in the disk, interior.
#pragma once

#include "conformal/koebe_iteration.h"
#include "conformal/result.h"
#include "geometry/condensed_laplacian.h"
#include "pipeline/domain.h"

#include <optional>

namespace koebe {

/// Circles fitted, boundary put on them, interior harmonic, the map balanced if asked for: the domain's vertices.
/// Fills the loop reports.
/// @param condensed of the domain's laplacian @param cut the flaps that will hang on its rim
/// @param outer the rank of the loop that should be the outer one: 0 unless it is to be chosen and another one is
///        better; then the map is not balanced
/// @return nothing if the circles leave the disk, meet, or no finite map extends them
std::optional<PlanarPoints> finish_map(const CondensedLaplacian& condensed, const SparseMatrix& laplacian, const Domain& domain,
                        const FlapCut& cut, const KoebeOutcome& outcome, const UniformizeOptions& options,
                        UniformizeResult& result, int& outer);

}  // namespace koebe
