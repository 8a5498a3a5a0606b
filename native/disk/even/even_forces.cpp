#include "even/even_forces.h"

#include "even/even_map.h"
#include "even/wanted_shapes.h"
#include "foldover/face_energy.h"
#include "planar/lifted_corners.h"

namespace koebe {

EvenForces even_forces(const Vertices& vertices, const Triangles& triangles, const PlanarPoints& points, double even,
                       const VectorXd& sizes)
{
    const PatchShapes shapes = wanted_shapes(vertices, triangles, points, sizes);
    const double weight = area_weight(even);
    constexpr double unregularized = 1e-9;
    const FaceEnergy energy{weight, 1.0, 0.0, unregularized};
    EvenForces forces{VectorXd(triangles.rows()), {}};
    forces.pull.resize(static_cast<std::size_t>(triangles.rows()));
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
