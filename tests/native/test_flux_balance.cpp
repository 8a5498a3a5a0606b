#include "circle_domain.h"
#include "conformal/distortion.h"
#include "conformal/flux_balance.h"
#include "geometry/laplacian.h"

#include <gtest/gtest.h>

using namespace koebe;
using namespace koebe::test;

TEST(FluxBalance, a_hole_put_beside_its_limb_comes_back_to_where_no_flux_runs_to_it)
{
    const double inner = 1e-4;
    const CircleDomain domain = make_round_annulus(inner, 16, 24);
    const Index vertex_count = static_cast<Index>(domain.points.size());
    const EdgeLengths lengths = edge_lengths(lift(domain.points, Lift::plane), domain.triangles);
    const SparseMatrix laplacian = cotan_laplacian(domain.triangles, half_cotangents(lengths), vertex_count);
    std::vector<Index> order;
    for (const VertexLoop& loop : domain.loops) order.insert(order.end(), loop.begin(), loop.end());
    const CondensedLaplacian condensed(laplacian, order, Ordering::amd);

    MatrixXd boundary(order.size(), 2);
    for (std::size_t b = 0; b < order.size(); ++b)
        boundary.row(b) << domain.points[order[b]].real(), domain.points[order[b]].imag();
    // Off by little in the disk, by much more than the hole.
    std::vector<Circle> circles = domain.circles;
    circles[1].center = {5e-3, 0.0};
    boundary.bottomRows(16).col(0).array() += 5e-3;
    EXPECT_FALSE(flipped_faces(domain.triangles, condensed.extend(boundary)).empty());

    balance_flux(condensed, laplacian, domain.loops, circles, boundary);
    const PlanarPoints uv = condensed.extend(boundary);
    EXPECT_TRUE(flipped_faces(domain.triangles, uv).empty());
    const MatrixXd flux = laplacian * uv;
    for (int c = 0; c < 2; ++c) EXPECT_LT(std::abs(flux(domain.loops[1], c).sum()), 1e-6 * inner);
    EXPECT_LT(std::abs(circles[1].center), 1e-6 * inner);
    for (std::size_t b = 0; b < order.size(); ++b)
        EXPECT_NEAR(boundary.row(b).norm(), b < 16 ? 1.0 : circles[1].radius, 1e-12);
}
