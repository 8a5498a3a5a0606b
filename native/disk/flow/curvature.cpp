#include "flow/curvature.h"

#include "core/connectivity.h"

#include <cmath>
#include <numbers>

namespace koebe {

EdgeLengths corner_angles(const EdgeLengths& lengths)
{
    EdgeLengths angles(lengths.rows(), 3);
    for (Eigen::Index f = 0; f < lengths.rows(); ++f) {
        const double twice_area = 2.0 * triangle_area(lengths(f, 0), lengths(f, 1), lengths(f, 2));
        for (int k = 0; k < 3; ++k) {
            const double a = lengths(f, k), b = lengths(f, (k + 2) % 3), c = lengths(f, (k + 1) % 3);
            angles(f, k) = std::atan2(2.0 * twice_area, a * a + (b - c) * (b + c));
        }
    }
    return angles;
}

VectorXd discrete_curvature(const Triangles& triangles, const EdgeLengths& lengths, const std::vector<char>& boundary)
{
    const EdgeLengths angles = corner_angles(lengths);
    VectorXd sum = VectorXd::Zero(static_cast<Eigen::Index>(boundary.size()));
    const std::vector<char> unused = unused_vertices(triangles, static_cast<Index>(boundary.size()));
    for (Eigen::Index i = 0; i < triangles.size(); ++i) sum[triangles.data()[i]] += angles.data()[i];
    for (std::size_t v = 0; v < boundary.size(); ++v) {
        const double flat = unused[v] ? 0.0 : (boundary[v] ? 1.0 : 2.0) * std::numbers::pi;
        sum[static_cast<Eigen::Index>(v)] = flat - sum[static_cast<Eigen::Index>(v)];
    }
    return sum;
}

std::vector<Index> collapsed_faces(const EdgeLengths& lengths)
{
    std::vector<Index> collapsed;
    for (Index f = 0; f < static_cast<Index>(lengths.rows()); ++f)
        if (!(triangle_area(lengths(f, 0), lengths(f, 1), lengths(f, 2)) > 0.0)) collapsed.push_back(f);
    return collapsed;
}

}  // namespace koebe
