#include "even/even_forces.h"

#include "even/even_map.h"
#include "foldover/face_energy.h"
#include "foldover/patch_shapes.h"
#include "planar/lifted_corners.h"

#include <numeric>

namespace koebe {

EvenForces even_forces(const Vertices& vertices, const Triangles& triangles, const PlanarPoints& points, double even)
{
    std::vector<Index> all(static_cast<std::size_t>(triangles.rows()));
    std::iota(all.begin(), all.end(), 0);
    const PatchShapes shapes = patch_shapes(vertices, triangles, points, all, PatchShape::true_size);
    const double weight = area_weight(even);
    constexpr double unregularized = 1e-9;
    const FaceEnergy energy{weight, 1.0, 0.0, unregularized};
    EvenForces forces{VectorXd(triangles.rows()), {}};
    forces.pull.resize(all.size());
    for (Eigen::Index f = 0; f < triangles.rows(); ++f) {
        const WantedShape shape(shapes.references[f]);
        const CornerPlaces at = corners_of(points, triangles, f);
        const FaceDerivatives face =
            energy.derivatives(shape.map_to(at[1] - at[0], at[2] - at[0]), 0.0, shapes.areas[f], shape);
        forces.energy[f] = face.term - 2.0 * (1.0 + weight) * shapes.areas[f];
        for (int k = 0; k < 3; ++k) forces.pull[f][k] = -face.gradient[k];
    }
    return forces;
}

}  // namespace koebe
