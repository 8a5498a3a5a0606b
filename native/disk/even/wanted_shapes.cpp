#include "even/wanted_shapes.h"

#include "core/numbering.h"

#include <cmath>
#include <vector>

namespace koebe {

PatchShapes wanted_shapes(const Vertices& vertices, const Triangles& triangles, const PlanarPoints& points,
                          const VectorXd& sizes)
{
    std::vector<Index> all = numbers_below(triangles.rows());
    PatchShapes shapes = patch_shapes(vertices, triangles, points, all, PatchShape::true_size);
    for (Eigen::Index f = 0; f < sizes.size(); ++f) {
        shapes.references[static_cast<std::size_t>(f)] *= std::sqrt(sizes[f]);
        shapes.areas[f] *= sizes[f];
    }
    return shapes;
}

}  // namespace koebe
