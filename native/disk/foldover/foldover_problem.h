// A planar triangle mesh with a wanted shape for each face.
#pragma once

#include "circles/circle.h"
#include "foldover/track.h"
#include "planar/lifted_corners.h"

#include <Eigen/Core>

#include <vector>

namespace koebe {

/// The places that a minimization changes.
struct FoldoverPlaces {
    PlanarPoints points;           ///< (V, 2)
    std::vector<Track> tracks;     ///< tracks that vertices ride on
    std::vector<Complex> periods;  ///< the first period changes only its length, not its direction
};

struct FoldoverProblem : FoldoverPlaces {
    /// How a vertex moves. sliding: along a fixed circle. riding: along a track that moves.
    enum class Mobility : char { held, sliding, free, riding };

    Triangles triangles;                     ///< (F, 3)
    std::vector<Eigen::Matrix2d> reference;  ///< (F) columns: edges 0-1 and 0-2 of the wanted shape, of positive area
    VectorXd floor;                          ///< (F) lower bound of the determinant, in the reference's areas
    VectorXd weight;                         ///< (F) weights of faces in the sum; empty: 1
    std::vector<Mobility> mobility;          ///< (V)
    std::vector<Circle> circles;             ///< (V) circles of sliding and of pulled vertices
    bool bends = false;                      ///< Newton steps count the curvature of sliding vertices' circles, too
    VectorXd pull;                           ///< (V) pull of free vertices to their circles, dimensionless; empty: 0
    std::vector<char> pull_inside;           ///< (V) 1: pulled to the circle's centre instead; empty: 0
    std::vector<int> track_of;               ///< (V) track of riding vertices; empty: no vertex rides
    CornerLifts lift;                        ///< (F) numbers of periods; empty without periods
};

}  // namespace koebe
