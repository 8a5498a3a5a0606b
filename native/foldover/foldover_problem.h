// A planar triangle mesh with the shape each face is to take.
#pragma once

#include "circles/circle.h"
#include "foldover/track.h"
#include "planar/lifted_corners.h"

#include <Eigen/Core>

#include <vector>

namespace koebe {

/// What moves.
struct FoldoverPlaces {
    PlanarPoints points;           ///< (V, 2)
    std::vector<Track> tracks;     ///< that vertices ride on
    std::vector<Complex> periods;  ///< of which only the length changes of the first one, not its direction
};

struct FoldoverProblem : FoldoverPlaces {
    /// sliding: along its circle, which stays. riding: along its track, which moves.
    enum class Mobility : char { held, sliding, free, riding };

    Triangles triangles;                     ///< (F, 3)
    std::vector<Eigen::Matrix2d> reference;  ///< (F) columns: edges 0-1 and 0-2 of the wanted shape, of positive area
    VectorXd floor;                          ///< (F) the determinant to stay above, in the reference's areas
    VectorXd weight;                         ///< (F) of each face in the sum; empty: 1
    std::vector<Mobility> mobility;          ///< (V)
    std::vector<Circle> circles;             ///< (V) of sliding and of pulled vertices
    VectorXd pull;                           ///< (V) of free vertices to their circles, dimensionless; empty: none
    std::vector<char> pull_inside;           ///< (V) 1: to the circle's centre instead; empty: nowhere
    std::vector<int> track_of;               ///< (V) of riding vertices; empty: none rides
    CornerLifts lift;                        ///< (F) of the periods; empty without periods
};

}  // namespace koebe
