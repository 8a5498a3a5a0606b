// Bends a circle domain while its circles move, one to one all the way.
#pragma once

#include "bending/circle_path.h"
#include "bending/template_rim.h"
#include "circles/circle.h"
#include "core/types.h"
#include "execution/execution.h"

#include <vector>

namespace koebe {

/// A circle domain and how its rims may move.
struct BendingInput {
    const Triangles& triangles;            ///< (F, 3), of vertices that all lie in faces
    const std::vector<VertexLoop>& loops;  ///< the outer one first
    const std::vector<Index>& off_circle;  ///< loop vertices off their circles, ascending
    PlanarPoints undistorted;              ///< (V, 2) the domain whose |mu| is 0
    PlanarPoints start;                    ///< (V, 2) the domain to begin with, its rims on the path's first circles
    VectorXd weight;                       ///< (F) areas on the surface, in any unit
    std::vector<TemplateRim> rims;         ///< of the loops; vertices are those of this mesh
};

struct BendingResult {
    bool arrived = false;
    double reached = 0.0;        ///< share of the way, if it did not arrive
    std::vector<Index> blocked;  ///< then the loops at the faces that would turn over; or none
    PlanarPoints uv;             ///< (V, 2)
    int steps = 0, newton_steps = 0;
    bool settled = false;  ///< whether the minimization ended by itself
    bool straight = true;  ///< whether centres went straight; else on bows, which chose the isotopy class
};

/// How the largest |mu| is lowered at the end.
struct Extremal {
    std::vector<double> powers = {};  ///< of the sum's terms, one after another; empty: the sum itself is least
    /// Rims may stretch as the faces do: their triangles count only where they bend more than the faces.
    bool free_rims = false;

    /// The circles' way, as a share of the progress.
    double way() const { return powers.empty() ? 0.8 : 0.2; }
};

/// Takes the circles along the path in steps. In a step the ring around each hole moves, and is scaled and turned by a
/// power of the distance from the centre: the map of least |mu| between two rings. Where circles are too near each
/// other for rings, the inside follows by the harmonic displacement of the present domain. A step that turns a face
/// over is halved. Each step ends with Newton steps that turn no face over (minimize_foldover_free), rim vertices
/// sliding. At the end they minimize sum a_f (K_f + 1 / K_f - 2) = sum a_f 4 |mu_f|^2 / (1 - |mu_f|^2): a_f is a face's
/// area on the surface, K_f its dilatation (Hormann and Greiner 2000). To the sum are added triangles between each
/// circle's centre and its rim, for each rim with the weight of all faces. Without them the vertices of a rim would
/// gather on an arc, and its polygon would not be round.
/// @throws Cancelled
BendingResult bend_along(const BendingInput& input, const CirclePath& path, const Extremal& extremal,
                         ExecutionContext& context);

}  // namespace koebe
