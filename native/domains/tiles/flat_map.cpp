#include "tiles/flat_map.h"

#include "linear/sparse_cholesky.h"
#include "planar/planar_predicates.h"
#include "surface/curvature_weights.h"

#include <cmath>

namespace koebe {

bool apart_in_tile(const std::vector<Circle>& circles, const std::vector<Complex>& periods)
{
    const Complex first = periods.front(), second = periods.size() > 1 ? periods[1] : 0.0;
    const int window = 2, rows = periods.size() > 1 ? window : 0;
    for (std::size_t i = 0; i < circles.size(); ++i)
        for (std::size_t j = 0; j <= i; ++j) {
            const Complex between = circles[i].center - circles[j].center;
            const double q = rows > 0 ? std::round(cross(first, between) / cross(first, second)) : 0.0;
            const double p = std::round(dot(first, between - q * second) / std::norm(first));
            for (int a = -window; a <= window; ++a)
                for (int b = -rows; b <= rows; ++b) {
                    const double along = p + a, up = q + b;
                    if (i == j && along == 0.0 && up == 0.0) continue;
                    const Complex copy = along * first + up * second;
                    if (!(std::abs(between - copy) > circles[i].radius + circles[j].radius)) return false;
                }
        }
    return true;
}

VectorXd jump_load(const PeriodicSurface& domain, const OneForm& form)
{
    return divergence(domain.metric.triangles, curvature_weights(domain.metric, domain.surface.vertex_count), form,
                      domain.surface.vertex_count);
}

SparseMatrix laplacian_of(const PeriodicSurface& domain)
{
    return cotan_laplacian(domain.metric.triangles, curvature_weights(domain.metric, domain.surface.vertex_count),
                           domain.surface.vertex_count);
}

void move_boundary(const PeriodicSurface& domain, const VectorXcd& places, const std::vector<char>& moved, VectorXcd& z)
{
    MatrixXd displacement = MatrixXd::Zero(z.size(), 2);
    for (Index v = 0; v < static_cast<Index>(z.size()); ++v)
        if (moved[v]) displacement.row(v) << places[v].real() - z[v].real(), places[v].imag() - z[v].imag();
    displacement = DirichletSolver(laplacian_of(domain), boundary_mask(domain.surface)).solve(displacement);
    for (Index v = 0; v < static_cast<Index>(z.size()); ++v)
        z[v] = moved[v] ? places[v] : z[v] + Complex(displacement(v, 0), displacement(v, 1));
}

}  // namespace koebe
