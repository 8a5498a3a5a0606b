// Points of one surface on another, through their circle domains.
#pragma once

#include "core/api.h"
#include "core/warning.h"
#include "execution/execution.h"
#include "pipeline/result.h"
#include "shape/domain_alignment.h"
#include "transfer/landmark_map.h"
#include "transfer/nearest_triangle.h"

#include <optional>
#include <vector>

namespace koebe {

struct CorrespondenceOptions {
    std::vector<int> match;                ///< as of align_domains, or empty to look for it
    bool fit_holes = true;                 ///< bend the target's domain until its holes are the source's
    std::vector<Landmark> landmarks = {};  ///< then bend it until they correspond
};

struct Correspondence {
    DomainAlignment alignment;
    bool fitted = false;     ///< whether the holes were then bent onto each other; not where that would turn faces over
    PlanarPoints uv;         ///< (V_b, 2) the target's domain as it was laid over the source's
    Beltrami beltrami;       ///< of the bending, from the aligned domain: 0 without any; faces cut at landmarks count
    std::size_t folded = 0;  ///< faces that it has turned over
    PlacesInTriangles places;       ///< (V_a) where the source's vertices lie in the target's triangles
    std::vector<Warning> warnings;  ///< not_fitted
    Vertices points;                ///< (V_a, 3) the same in space: a point of the target for each vertex of the source
};

/// The target's domain with its holes bent onto the source's circles, in steps: the rims are moved and scaled as their
/// circles are, the inside follows by the harmonic displacement of the present domain. A step that turns faces over is
/// halved. So the map is one to one, but quasi-conformal where the holes differ.
/// @param uv (V_b, 2) the target's aligned domain @param alignment that of these points
/// @return nothing if holes get into each other's way
/// @throws SolverError, Cancelled
std::optional<PlanarPoints> with_fitted_holes(const std::vector<Circle>& source, const MappedSurface& target,
                                              const DomainAlignment& alignment, const PlanarPoints& uv,
                                              const ExecutionContext& context = {});

/// Lays the target's circle domain over the source's (align_domains; of up to five holes landmarks choose the match),
/// with the freedom that no circle or one hole leaves so that landmarks lie near each other (nearest_symmetry), bends
/// its holes onto the source's, and then until its landmarks lie on the source's (map_with_landmarks), and looks up
/// where the source's vertices lie in it. A vertex that lies outside, by the height of an arc over its edge at a rim,
/// takes the nearest point: none is lost.
/// @throws InputError as align_domains and map_with_landmarks; circles that are not the surfaces'
/// (require_own_circles); SolverError, Cancelled
KOEBE_API Correspondence correspond(const MappedSurface& source, const MappedSurface& target,
                                    const CorrespondenceOptions& options, const ExecutionContext& context = {});

}  // namespace koebe
