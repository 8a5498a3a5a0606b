// A circle domain bent so that landmarks lie where they are wanted.
#pragma once

#include "circles/circle.h"
#include "execution/execution.h"
#include "pipeline/result.h"
#include "transfer/cut_mesh.h"

#include <vector>

namespace koebe {

/// A surface and its map.
struct MappedSurface {
    Vertices vertices;
    Triangles triangles;
    PlanarPoints uv;                ///< points of the unit disk
    std::vector<LoopReport> loops;  ///< of the map, the outer one first
};

/// Two points that shall correspond.
struct Landmark {
    SurfacePoint target, source;
};

struct LandmarkMap {
    CutMesh mesh;     ///< the target's, cut so that its landmarks are vertices
    PlanarPoints uv;  ///< (V + added, 2)
};

/// The landmarks are held at their places, and of the maps that keep them there and take rims to their circles, along
/// which rims' vertices slide, that with the least sum of a_f (2 |mu_f|^2 / (1 - |mu_f|^2) + 1e-4)^2 is taken: a_f a
/// face's area on the surface, mu_f its Beltrami coefficient from the aligned domain. So it is the fourth power of |mu|
/// that counts: with the second the distortion would gather at the landmarks, the more the finer the mesh, as points
/// have no capacity in the plane. Extremal maps in the sense of Teichmueller are the limit of large powers.
///
/// The landmarks go to their places in steps, the inside after them by the displacement of least squared Laplacian on
/// the surface, and each step ends with Newton steps that turn no face over (minimize_foldover_free). Straight on, else
/// on arcs to either side, at last at once; where a short step folds faces they are turned back, a few times. Landmarks
/// at vertices of rims slide to places on the same rim.
/// @param circles of the target's loops, in their order @param aligned (V, 2) the domain that is without distortion
/// @param bent (V, 2) the same with its rims on the circles: the start
/// @param places (n) of the landmarks in the plane
/// @throws InputError landmarks that exclude each other, or lie on a rim on one side alone (landmarks listed);
///         SolverError no such map was found (landmarks listed); Cancelled
LandmarkMap map_with_landmarks(const MappedSurface& target, const std::vector<Circle>& circles,
                               const PlanarPoints& aligned, const PlanarPoints& bent,
                               const std::vector<SurfacePoint>& landmarks, const VectorXcd& places,
                               const ExecutionContext& context = {});

/// Faces whose area is not positive in 64 bits.
std::vector<Index> folded_faces(const Triangles& triangles, const PlanarPoints& uv);

}  // namespace koebe
