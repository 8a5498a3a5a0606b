#include "circle_domain.h"
#include "surface/free_flattening.h"

#include <Eigen/Geometry>
#include <gtest/gtest.h>

using namespace koebe;
using namespace koebe::test;

TEST(FreeFlattening, a_flat_mesh_turned_in_space_comes_back_up_to_the_similarity_of_the_pins)
{
    const CircleDomain domain = make_circle_domain({Circle{}}, 500);
    const Eigen::Matrix3d turn = Eigen::AngleAxisd(1.1, Eigen::Vector3d(1, 2, 3).normalized()).toRotationMatrix();
    const Vertices surface = lift(domain.points, Lift::plane) * turn.transpose();
    const Complex factor(0.3, -2.0), shift(5.0, 1.0);
    const Index first = domain.loops[0][0], second = domain.loops[0][9];
    const VectorXcd image =
        flatten_freely(surface, domain.triangles, {first, second},
                       {factor * domain.points[first] + shift, factor * domain.points[second] + shift});
    EXPECT_LT((image.array() - factor * domain.points.array() - shift).abs().maxCoeff(), 1e-9);
}

TEST(FreeFlattening, a_face_without_area_gets_some)
{
    Vertices line(3, 3);
    line << 0, 0, 0, 1, 0, 0, 0.5, 0, 0;
    Triangles face(1, 3);
    face << 0, 1, 2;
    const VectorXcd image = flatten_freely(line, face, {0, 1}, {{0.0, 0.0}, {1.0, 0.0}});
    EXPECT_GT(image[2].imag(), 1e-4);
    EXPECT_NEAR(image[2].real(), 0.5, 1e-12);
}
