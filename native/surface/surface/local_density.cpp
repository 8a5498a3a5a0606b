#include "surface/local_density.h"

#include "core/connectivity.h"

#include <algorithm>
#include <cmath>

namespace koebe {
namespace {

constexpr double most_rounds = 200;  // on meshes far finer than the radius

}  // namespace

VectorXd local_density(const Vertices& vertices, const Triangles& triangles, VectorXd amount, VectorXd area,
                       double radius)
{
    double length = 0.0;
    for (Index h = 0; h < static_cast<Index>(triangles.size()); ++h)
        length += (vertices.row(target(triangles, h)) - vertices.row(origin(triangles, h))).norm();

    // Averages both over rounds of neighbours: so many that they reach about as far as the radius.
    const double step = length / std::max(static_cast<double>(triangles.size()), 1.0);
    const int rounds =
        static_cast<int>(std::clamp(std::ceil(std::pow(radius / std::max(step, 1e-12), 2)), 1.0, most_rounds));
    for (int round = 0; round < rounds; ++round) {
        VectorXd next_amount = amount, next_area = area, degree = VectorXd::Ones(vertices.rows());
        for (Index h = 0; h < static_cast<Index>(triangles.size()); ++h) {
            const Index v = origin(triangles, h), w = target(triangles, h);
            next_amount[v] += amount[w];
            next_area[v] += area[w];
            degree[v] += 1.0;
        }
        amount = next_amount.cwiseQuotient(degree);
        area = next_area.cwiseQuotient(degree);
    }
    return amount.array() / area.array().max(1e-300);
}

}  // namespace koebe
