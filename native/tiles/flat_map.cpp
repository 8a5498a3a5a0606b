#include "tiles/flat_map.h"

#include "linear/sparse_cholesky.h"

namespace koebe {

VectorXd jump_load(const PeriodicSurface& domain, const OneForm& form)
{
    return divergence(domain.metric.triangles, half_cotangents(domain.metric.lengths), form,
                      domain.surface.vertex_count);
}

SparseMatrix laplacian_of(const PeriodicSurface& domain)
{
    return cotan_laplacian(domain.metric.triangles, half_cotangents(domain.metric.lengths),
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
