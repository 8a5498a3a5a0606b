// Takes points of one surface to another through their circle domains.
#pragma once

#include "core/api.h"
#include "core/warning.h"
#include "execution/execution.h"
#include "pipeline/result.h"
#include "shape/domain_alignment.h"
#include "surface/nearest_triangles.h"
#include "transfer/landmark_map.h"

#include <optional>
#include <vector>

namespace koebe {

struct CorrespondenceOptions {
    std::vector<int> match;                ///< as in align_domains, or empty to search it
    bool fit_holes = true;                 ///< bend the target's domain until its holes are the source's
    std::vector<Landmark> landmarks = {};  ///< then bend it until these points correspond
    bool extremal = false;                 ///< with landmarks: the largest |mu| becomes nearly as small as it can
};

struct Correspondence {
    DomainAlignment alignment;
    bool fitted = false;            ///< whether holes were bent onto each other; not done if faces would turn over
    PlanarPoints uv;                ///< (V_b, 2) the target's domain as laid over the source's
    Beltrami beltrami;              ///< of the bending from the aligned domain, else 0; counts faces cut at landmarks
    std::size_t folded = 0;         ///< faces that the bending has turned over
    PlacesInTriangles places;       ///< (V_a) places of the source's vertices in the target's triangles
    std::vector<Warning> warnings;  ///< ambiguous_match, not_fitted
    Vertices points;                ///< (V_a, 3) the same places in space: a target point per source vertex
};

/// Bends the target's domain until its holes are the source's circles, one to one all the way. Of such maps it is the
/// one of least distortion (bend_along), rim vertices sliding. Its start is a harmonic displacement, in steps that turn
/// no face over, or else the way of the circles (paths_between). With more than 20,000 faces a harmonic map stays as it
/// is.
/// @param uv (V_b, 2) the target's aligned domain @param alignment of these points
/// @return nothing if holes block each other
/// @throws SolverError, Cancelled
std::optional<PlanarPoints> with_fitted_holes(const std::vector<Circle>& source, const MappedSurface& target,
                                              const DomainAlignment& alignment, const PlanarPoints& uv,
                                              ExecutionContext& context);

/// Lays the target's circle domain over the source's (align_domains); up to five holes landmarks help to choose the
/// match. Without a hole or with one, the freedom left is used to bring landmarks near each other (nearest_symmetry).
/// Then bends the target's holes onto the source's, and its landmarks onto the source's (map_with_landmarks), and looks
/// up the source's vertices in it. A vertex outside, by the height of an arc over its edge at a rim, takes the nearest
/// point, so every vertex has a place.
/// @throws InputError as align_domains and map_with_landmarks; circles that are not the surfaces' own
/// (require_own_circles); SolverError, Cancelled
KOEBE_API Correspondence correspond(const MappedSurface& source, const MappedSurface& target,
                                    const CorrespondenceOptions& options, ExecutionContext& context);

}  // namespace koebe
