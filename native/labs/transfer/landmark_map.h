// Bends a circle domain so that landmarks lie at wanted places.
#pragma once

#include "circles/circle.h"
#include "core/api.h"
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

/// The surface with its conformal map, whatever map the result shows.
KOEBE_API MappedSurface conformal_surface(const Vertices& vertices, const Triangles& triangles,
                                          const UniformizeResult& result);

/// Two points that must correspond.
struct Landmark {
    SurfacePoint target, source;
};

struct LandmarkMap {
    CutMesh mesh;     ///< the target's, cut so that its landmarks are vertices
    PlanarPoints uv;  ///< (V + added, 2)
    /// (F') in which the map is linear: the mesh's. For the extremal map each ear of the outer rim, a face with two
    /// edges of it, and the face behind the ear have their common edge flipped.
    Triangles triangles;
};

/// Holds the landmarks at their places and keeps rims on their circles, along which their vertices slide. Of these maps
/// it takes the one with the least sum of a_f (2 |mu_f|^2 / (1 - |mu_f|^2) + 1e-4)^2: a_f is a face's area on the
/// surface, mu_f its Beltrami coefficient from the aligned domain. So the fourth power of |mu| counts. With the second
/// power the distortion would gather at the landmarks on fine meshes, as points have no capacity in the plane. Extremal
/// maps in the sense of Teichmueller are the limit of large powers.
///
/// The landmarks move in steps. The inside follows by the displacement of least squared Laplacian on the surface, and
/// each step ends with Newton steps that turn no face over (minimize_foldover_free). Landmarks move straight, then on
/// arcs to either side, at last all the way at once. If a short step folds faces they are turned back, a few times.
/// Landmarks at rim vertices slide to places on the same rim. For the extremal map the sums of rising powers of |mu|
/// are minimized at the end, up to the 128th.
/// @param circles of the target's loops, in their order @param aligned (V, 2) the domain without distortion
/// @param bent (V, 2) the domain with its rims on the circles: the start
/// @param places (n) of the landmarks in the plane @param extremal the largest |mu| becomes nearly as small as it can
/// @throws InputError landmarks that exclude each other, or lie on a rim in one domain only (landmarks listed);
/// SolverError no such map was found (landmarks listed); Cancelled
LandmarkMap map_with_landmarks(const MappedSurface& target, const std::vector<Circle>& circles,
                               const PlanarPoints& aligned, const PlanarPoints& bent,
                               const std::vector<SurfacePoint>& landmarks, const VectorXcd& places, bool extremal,
                               ExecutionContext& context);

/// Faces whose area is not positive in 64 bits.
std::vector<Index> folded_faces(const Triangles& triangles, const PlanarPoints& uv);

}  // namespace koebe
