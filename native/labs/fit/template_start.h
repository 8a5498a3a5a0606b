// Lays a circle domain over a template, as the start of the bending.
#pragma once

#include "circles/circle.h"
#include "core/types.h"
#include "execution/execution.h"

#include <vector>

namespace koebe {

struct TemplateStart {
    std::vector<int> match;       ///< the domain's loop for each circle of the template, the unit circle first
    std::vector<Circle> circles;  ///< of the domain's loops, moved
    PlanarPoints uv;              ///< (V, 2) the domain, moved
};

/// Moves the domain by the automorphism that brings its circles nearest to the template's. If that would turn faces
/// over, the domain is moved only as far as it turns none.
/// @param domain circles of the domain's loops, the unit circle first @param wanted the template's, likewise
/// @param match as in the result, or empty to search it
/// @throws InputError as align_domains; Cancelled
TemplateStart lay_over_template(const std::vector<Circle>& domain, const std::vector<Circle>& wanted,
                                std::vector<int> match, const Triangles& triangles, const PlanarPoints& uv,
                                const ExecutionContext& context);

}  // namespace koebe
