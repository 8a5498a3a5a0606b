#include "surface/importance.h"

#include "core/errors.h"
#include "surface/laplacian.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace koebe {

VectorXd importance_factors(const Triangles& triangles, const VectorXd& importance)
{
    VectorXd factors(triangles.rows());
    for (Eigen::Index f = 0; f < triangles.rows(); ++f) {
        const double sum = importance[triangles(f, 0)] + importance[triangles(f, 1)] + importance[triangles(f, 2)];
        factors[f] = std::pow(most_important, 2.0 * sum / 3.0);
    }
    return factors;
}

VectorXd size_factors(const Vertices& vertices, const Triangles& triangles, const VectorXd& importance)
{
    if (importance.size() == 0 || triangles.rows() == 0) return {};
    double least = std::numeric_limits<double>::infinity(), most = -least;
    for (const Index v : triangles.reshaped()) {
        least = std::min(least, importance[v]);
        most = std::max(most, importance[v]);
    }
    if (!(most > least)) return {};
    VectorXd factors = importance_factors(triangles, importance.array() - least);
    const EdgeLengths lengths = edge_lengths(vertices, triangles);
    double area = 0.0, wanted = 0.0;
    for (Eigen::Index f = 0; f < triangles.rows(); ++f) {
        const double own = triangle_area(lengths(f, 0), lengths(f, 1), lengths(f, 2));
        area += own;
        wanted += own * factors[f];
    }
    const double scale = area / wanted;
    if (!std::isfinite(scale) || !(scale > 0.0)) return {};
    return factors * scale;
}

void require_use_of_importance(const std::vector<double>& importance, double even, bool balanced)
{
    if (!importance.empty() && !balanced && !(even > 0.0))
        throw InputError("importance needs even above 0, or balance area: it weighs them");
}

}  // namespace koebe
