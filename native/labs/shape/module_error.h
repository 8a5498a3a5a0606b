// Estimates the error of a conformal module against the smooth surface that the mesh approximates.
#pragma once

#include "core/api.h"
#include "core/types.h"
#include "execution/execution.h"
#include "pipeline/options.h"
#include "pipeline/result.h"

#include <vector>

namespace koebe {

/// The circles of the same surface on a mesh with four times as many faces (refine_smoothly), in the order of `loops`.
/// @param loops of the given mesh's map @param options of that map; the outer loop stays the first
/// @throws errors of uniformize; InputError circles that are not the surface's own (require_own_circles)
KOEBE_API std::vector<Circle> refined_circles(const Vertices& vertices, const Triangles& triangles,
                                              const std::vector<LoopReport>& loops, UniformizeOptions options,
                                              ExecutionContext& context);

/// Error bars of a module, which hold as a rule: twice the change of each number to the finer mesh plus the root mean
/// square of all changes. For second order the error is 4/3 of the change (Richardson); the rest covers numbers that
/// change little by chance. Measured on exact domains: docs/shapes.md.
KOEBE_API VectorXd module_error(const VectorXd& module, const VectorXd& refined);

}  // namespace koebe
