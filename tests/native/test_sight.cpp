#include "core/types.h"
#include "cost/costs.h"
#include "even/even_map.h"
#include "surface/local_density.h"

#include <gtest/gtest.h>

#include <cmath>

using namespace koebe;

namespace {

struct Strip {
    Vertices vertices;
    Triangles triangles;
    VectorXd areas;  // of the faces round each vertex
};

/// A strip of squares, whose right half has squares of half the side.
Strip strip()
{
    std::vector<Eigen::RowVector3d> places;
    constexpr int coarse = 40, rows = 8;
    const auto x_of = [](int i) { return i <= coarse ? double(i) : coarse + 0.5 * (i - coarse); };
    for (int i = 0; i <= 3 * coarse; ++i)
        for (int j = 0; j <= rows; ++j) places.emplace_back(x_of(i), j, 0.0);
    Strip made;
    made.vertices.resize(static_cast<Eigen::Index>(places.size()), 3);
    for (std::size_t v = 0; v < places.size(); ++v) made.vertices.row(static_cast<Eigen::Index>(v)) = places[v];
    made.triangles.resize(2 * 3 * coarse * rows, 3);
    made.areas = VectorXd::Zero(made.vertices.rows());
    Eigen::Index f = 0;
    for (int i = 0; i < 3 * coarse; ++i)
        for (int j = 0; j < rows; ++j) {
            const Index a = i * (rows + 1) + j, b = a + rows + 1;
            made.triangles.row(f++) << a, b, b + 1;
            made.triangles.row(f++) << a, b + 1, a + 1;
            for (const Index v : {a, b, b + 1, a, b + 1, a + 1}) made.areas[v] += (x_of(i + 1) - x_of(i)) / 6.0;
        }
    return made;
}

TEST(LocalDensity, fine_halves_have_twice_the_vertices)
{
    const Strip made = strip();
    const VectorXd density =
        local_density(made.vertices, made.triangles, VectorXd::Ones(made.vertices.rows()), made.areas, 2.0);
    const auto at = [](int i) { return i * 9 + 4; };  // in the middle row
    EXPECT_NEAR(density[at(10)], 1.0, 0.05);
    EXPECT_NEAR(density[at(100)], 2.0, 0.1);
    EXPECT_GT(density[at(41)], 1.1);
    EXPECT_LT(density[at(41)], 1.9);
}

TEST(Detail, cuts_are_dearer_only_where_the_mesh_is_finer_than_in_the_mean)
{
    const VectorXd areas{{1.0, 1.0, 2.0}};
    const VectorXd factors = detail_factors(VectorXd{{1.0, 4.0, 0.25}}, areas);  // finenesses 1, 2, 0.5: mean 1
    EXPECT_DOUBLE_EQ(factors[0], 1.0);
    EXPECT_DOUBLE_EQ(factors[1], 2.0);
    EXPECT_DOUBLE_EQ(factors[2], 1.0);
    EXPECT_DOUBLE_EQ(detail_factors(VectorXd{{1.0, 1e6, 1.0}}, areas)[1], tuning::most_detailed);
}

TEST(FaceWeight, what_nobody_sees_counts_less)
{
    EXPECT_DOUBLE_EQ(weight_of_face(2.0), 1.0);
    EXPECT_DOUBLE_EQ(weight_of_face(0.5 * tuning::seen_well), 0.5);
    EXPECT_DOUBLE_EQ(weight_of_face(0.0), tuning::hidden_weight);
}

/// A pyramid seen from above, whose faces cannot all keep their areas.
TEST(FaceWeight, an_even_map_favours_heavy_faces)
{
    Vertices vertices(5, 3);
    vertices << -1, -1, 0, 1, -1, 0, 1, 1, 0, -1, 1, 0, 0, 0, 3;
    Triangles triangles(4, 3);
    triangles << 0, 1, 4, 1, 2, 4, 2, 3, 4, 3, 0, 4;
    const std::vector<VertexLoop> loops{{0, 1, 2, 3}};
    const auto error_of_first = [&](const VectorXd& weights) {
        PlanarPoints points = vertices.leftCols<2>();
        std::vector<RoundLoop> none;
        FlatSurface flat{vertices, triangles, loops, points, none};
        flat.weights = weights;
        ExecutionContext context;
        EXPECT_TRUE(make_even(flat, 0.5, 4.0, context).moved);
        double longest = 0.0;
        for (int k = 0; k < 3; ++k) {
            const Index a = triangles(0, k), b = triangles(0, (k + 1) % 3);
            longest = std::max(longest, std::abs(std::log((points.row(a) - points.row(b)).norm() /
                                                          (vertices.row(a) - vertices.row(b)).norm())));
        }
        return longest;
    };
    const double alike = error_of_first({}), heavy = error_of_first(VectorXd{{1.0, 0.05, 0.05, 0.05}});
    EXPECT_LT(heavy, 0.6 * alike);
    EXPECT_DOUBLE_EQ(error_of_first(VectorXd::Ones(4)), alike);
}

}  // namespace
