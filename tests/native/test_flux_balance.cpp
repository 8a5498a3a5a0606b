#include "balance/flux_balance.h"
#include "circle_domain.h"
#include "circles/moebius.h"
#include "linear/condensed_laplacian.h"
#include "surface/laplacian.h"

#include <gtest/gtest.h>

using namespace koebe;
using namespace koebe::test;

namespace {

/// A domain in its own place, which the balance may then disturb.
struct Balanced {
    explicit Balanced(CircleDomain d)
        : domain(std::move(d)),
          laplacian(plane_laplacian(domain)),
          condensed(laplacian, order(domain)),
          circles(domain.circles),
          boundary(lift(domain.points, Lift::plane)(order(domain), {0, 1}))
    {
    }

    static SparseMatrix plane_laplacian(const CircleDomain& domain)
    {
        const EdgeLengths lengths = edge_lengths(lift(domain.points, Lift::plane), domain.triangles);
        return cotan_laplacian(domain.triangles, half_cotangents(lengths), static_cast<Index>(domain.points.size()));
    }

    static std::vector<Index> order(const CircleDomain& domain)
    {
        std::vector<Index> result;
        for (const VertexLoop& loop : domain.loops) result.insert(result.end(), loop.begin(), loop.end());
        return result;
    }

    CircleDomain domain;
    SparseMatrix laplacian;
    CondensedLaplacian condensed;
    std::vector<Circle> circles;
    MatrixXd boundary;
};

}  // namespace

TEST(FluxBalance, a_hole_put_beside_its_limb_comes_back_to_where_no_flux_runs_to_it)
{
    const double inner = 1e-4;
    Balanced map(make_round_annulus(inner, 16, 24));
    // Off by little in the disk, by much more than the hole.
    map.circles[1].center = {5e-3, 0.0};
    map.boundary.bottomRows(16).col(0).array() += 5e-3;
    EXPECT_FALSE(flipped_faces(map.domain.triangles, map.condensed.extend(map.boundary)).empty());

    balance_flux(map.condensed, map.laplacian, map.domain.loops, map.circles, map.boundary,
                 AnnulusPosition::concentric);
    const PlanarPoints uv = map.condensed.extend(map.boundary);
    EXPECT_TRUE(flipped_faces(map.domain.triangles, uv).empty());
    const MatrixXd flux = map.laplacian * uv;
    for (int c = 0; c < 2; ++c) EXPECT_LT(std::abs(flux(map.domain.loops[1], c).sum()), 1e-6 * inner);
    EXPECT_LT(std::abs(map.circles[1].center), 1e-6 * inner);
    for (Eigen::Index b = 0; b < 32; ++b)
        EXPECT_NEAR(map.boundary.row(b).norm(), b < 16 ? 1.0 : map.circles[1].radius, 1e-12);
}

TEST(FluxBalance, an_annulus_that_is_not_concentric_keeps_its_place_in_the_disk)
{
    const double inner = 1e-4;
    Balanced map(make_round_annulus(inner, 16, 24));
    const Moebius moebius{Complex(0.1, -0.2), 1.0};
    const VectorXcd moved = moebius(VectorXcd(map.boundary.col(0) + Complex(0.0, 1.0) * map.boundary.col(1)));
    map.boundary << moved.real(), moved.imag();
    map.circles[1] = moebius(map.circles[1]);
    const MatrixXd rim = map.boundary.topRows(16);
    // What the mesh resolves is coarser than the hole: where no flux runs is not quite its image.
    balance_flux(map.condensed, map.laplacian, map.domain.loops, map.circles, map.boundary, AnnulusPosition::free);
    const Circle first = map.circles[1];
    EXPECT_LT(std::abs(first.center - moebius(Complex(0.0, 0.0))), 1e-2);
    map.circles[1].center += 5e-3;
    map.boundary.bottomRows(16).col(0).array() += 5e-3;
    balance_flux(map.condensed, map.laplacian, map.domain.loops, map.circles, map.boundary, AnnulusPosition::free);
    EXPECT_LT(std::abs(map.circles[1].center - first.center), 1e-4 * inner);
    EXPECT_EQ(map.boundary.topRows(16), rim);
    const MatrixXd flux = map.laplacian * map.condensed.extend(map.boundary);
    for (int c = 0; c < 2; ++c) EXPECT_LT(std::abs(flux(map.domain.loops[1], c).sum()), 1e-6 * inner);
}

TEST(FluxBalance, a_small_hole_finds_its_place_turn_and_size)
{
    std::vector<Circle> circles = five_circles();
    circles.push_back({{0.05, 0.1}, 8e-4});
    Balanced map(make_circle_domain(circles, 4000));
    const Eigen::Index count = static_cast<Eigen::Index>(map.domain.loops[5].size());
    auto hole = map.boundary.bottomRows(count);
    const MatrixXd expected = map.boundary;
    for (Eigen::Index b = 0; b < count; ++b) {
        const Complex arm = Complex(hole(b, 0), hole(b, 1)) - circles[5].center;
        const Complex image = Complex(0.06, 0.09) + 0.1 * std::polar(1.0, 2.0) * arm;
        hole.row(b) << image.real(), image.imag();
    }
    map.circles[5] = {{0.06, 0.09}, 8e-5};
    balance_flux(map.condensed, map.laplacian, map.domain.loops, map.circles, map.boundary,
                 AnnulusPosition::concentric);
    EXPECT_LT((map.boundary - expected).cwiseAbs().maxCoeff(), 0.1 * circles[5].radius);
    EXPECT_NEAR(map.circles[5].radius, circles[5].radius, 0.1 * circles[5].radius);
    for (Eigen::Index b = 0; b < count; ++b)
        EXPECT_NEAR(std::abs(Complex(hole(b, 0), hole(b, 1)) - map.circles[5].center), map.circles[5].radius, 1e-15);
}
