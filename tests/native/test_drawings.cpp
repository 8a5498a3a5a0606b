#include "lift/svg_drawing.h"
#include "planar/filled_paths.h"

#include "core/errors.h"
#include "planar/planar_predicates.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <string>

using namespace koebe;

namespace {

double area_of(const std::vector<FilledBoundary>& boundaries)
{
    double twice = 0.0;
    for (const FilledBoundary& b : boundaries)
        for (std::size_t i = 0; i < b.points.size(); ++i)
            twice += cross(b.points[i], b.points[(i + 1) % b.points.size()]);
    return 0.5 * twice;
}

std::vector<Complex> box(double x, double y, double width, double height)
{
    return {{x, y}, {x + width, y}, {x + width, y + height}, {x, y + height}};
}

SvgDrawing drawing_of(const std::string& inside)
{
    return parse_svg("<svg xmlns='http://www.w3.org/2000/svg'>" + inside + "</svg>");
}

}  // namespace

TEST(FilledPaths, TheRuleDecidesAboutAHole)
{
    const std::vector<std::vector<Complex>> rings{box(0, 0, 4, 4), box(1, 1, 2, 2)};
    EXPECT_DOUBLE_EQ(area_of(united_paths({{false, rings}})), 16.0);
    const std::vector<FilledBoundary> ring = united_paths({{true, rings}});
    ASSERT_EQ(ring.size(), 2U);
    EXPECT_NE(ring[0].hole, ring[1].hole);
    EXPECT_EQ(ring[0].area, ring[1].area);
    EXPECT_DOUBLE_EQ(area_of(ring), 12.0);
    EXPECT_DOUBLE_EQ(area_of(united_paths({{true, rings}, {false, {box(1, 1, 2, 2)}}})), 16.0) << "the hole is filled";
}

TEST(FilledPaths, DegenerateRingsFillNothing)
{
    EXPECT_TRUE(united_paths({}).empty());
    EXPECT_TRUE(united_paths({{false, {{}, {1.0}, {1.0, 1.0}, {0.0, 1.0, 2.0}}}}).empty());
    EXPECT_TRUE(united_paths({{true, {box(0, 0, 1, 1), box(0, 0, 1, 1)}}}).empty()) << "twice round is outside";
}

TEST(FilledPaths, RandomBoxesCoverAsManyCellsAsTheyHold)
{
    std::mt19937 random(35);
    for (int trial = 0; trial < 40; ++trial) {
        bool inside[12][12] = {};
        std::vector<FilledPath> paths;
        for (int k = 0; k < 5; ++k) {
            const int x = random() % 6, y = random() % 6, w = 1 + random() % 6, h = 1 + random() % 6;
            paths.push_back({k % 2 == 0, {box(x, y, w, h)}});
            for (int i = x; i < x + w; ++i)
                for (int j = y; j < y + h; ++j) inside[i][j] = true;
        }
        double cells = 0.0;
        for (const auto& row : inside)
            for (const bool cell : row) cells += cell;
        EXPECT_NEAR(area_of(united_paths(paths)), cells, 1e-9);
    }
}

TEST(SvgDrawing, AttributesMayComeInAnyOrder)
{
    const SvgDrawing last = drawing_of("<path d='M0 0H2V1H0Z' transform='scale(3)' fill-rule='evenodd'/>");
    EXPECT_EQ(last.high - last.low, Complex(6.0, 3.0));
    EXPECT_TRUE(last.paths.at(0).even_odd);
    EXPECT_THROW(drawing_of("<path d='M0 0H2V1H0Z' display='none'/>"), InputError);
}

TEST(SvgDrawing, CurvesLieWithinTheTolerance)
{
    const SvgDrawing drawing = drawing_of("<circle cx='7' cy='-2' r='5'/>");
    for (const double tolerance : {0.5, 0.01, 1e-4}) {
        const std::vector<Complex> polygon = flattened(drawing.paths.at(0), tolerance).at(0);
        for (std::size_t i = 0; i < polygon.size(); ++i) {
            const Complex middle = 0.5 * (polygon[i] + polygon[(i + 1) % polygon.size()]);
            EXPECT_NEAR(std::abs(middle - Complex(7.0, 2.0)), 5.0, tolerance + 2e-3)
                << "an arc is a Bezier curve to 3e-4";
        }
    }
}
