#include "core/connectivity.h"
#include "cut_samples.h"
#include "grids.h"
#include "mesh/connected_pieces.h"
#include "mesh/topology.h"
#include "splitting/straight_borders.h"
#include "splitting/straight_paths.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <random>
#include <set>
#include <utility>
#include <vector>

using namespace koebe;
using namespace koebe::test;

namespace {

/// A tube with rows of squares, halved.
CutSurface tube(int around, int rows)
{
    std::vector<std::pair<double, double>> profile;
    for (int k = 0; k <= rows; ++k) profile.emplace_back(1.0, 2.0 * pi / around * k);
    const Mesh mesh = revolved(profile, around);
    CutSurface whole = cut_surface(mesh.vertices, mesh.triangles, {});
    return cut_surface(mesh.vertices / std::sqrt(whole.areas.sum()), mesh.triangles, {});
}

/// A square grid whose vertices are moved a little, with the faces nearest to some random places as regions.
struct Regions {
    CutSurface whole;
    std::vector<int> label;  // (F)
};

Regions random_regions(std::mt19937& random, int side, int places)
{
    std::uniform_real_distribution<double> any(0.0, 1.0);
    Vertices vertices((side + 1) * (side + 1), 3);
    const auto at = [&](int i, int j) { return static_cast<Index>(j * (side + 1) + i); };
    for (int j = 0; j <= side; ++j)
        for (int i = 0; i <= side; ++i)
            vertices.row(at(i, j)) << (i + 0.3 * any(random)) / side, (j + 0.3 * any(random)) / side,
                0.02 * any(random);
    Triangles triangles(2 * side * side, 3);
    for (int j = 0; j < side; ++j)
        for (int i = 0; i < side; ++i) {
            const Index k = 2 * (j * side + i);
            if (random() % 2 == 0) {
                triangles.row(k) << at(i, j), at(i + 1, j), at(i + 1, j + 1);
                triangles.row(k + 1) << at(i, j), at(i + 1, j + 1), at(i, j + 1);
            } else {
                triangles.row(k) << at(i, j), at(i + 1, j), at(i, j + 1);
                triangles.row(k + 1) << at(i + 1, j), at(i + 1, j + 1), at(i, j + 1);
            }
        }
    Regions regions{cut_surface(vertices, triangles, {}), {}};
    Vertices seeds(places, 3);
    for (int k = 0; k < places; ++k) seeds.row(k) << any(random), any(random), 0.0;
    for (Index f = 0; f < static_cast<Index>(triangles.rows()); ++f) {
        const Eigen::RowVector3d middle = vertices(triangles.row(f), Eigen::all).colwise().mean();
        Eigen::Index nearest = 0;
        (seeds.rowwise() - middle).rowwise().squaredNorm().minCoeff(&nearest);
        regions.label.push_back(static_cast<int>(nearest));
    }
    // A ragged border: some faces go to a neighbour.
    for (Index h = 0; h < static_cast<Index>(regions.whole.surface.twin.size()); ++h)
        if (const Index t = regions.whole.surface.twin[h]; t != no_twin && random() % 6 == 0)
            regions.label[face_of(h)] = regions.label[face_of(t)];
    return regions;
}

std::vector<char> borders_of(const CutSurface& whole, const std::vector<int>& label)
{
    std::vector<char> is_border(whole.surface.twin.size(), 0);
    for (Index h = 0; h < static_cast<Index>(is_border.size()); ++h)
        if (const Index t = whole.surface.twin[h]; t != no_twin && label[face_of(h)] != label[face_of(t)])
            is_border[h] = 1;
    return is_border;
}

/// How many pieces the paths leave.
Index pieces_between(const CutSurface& whole, const std::vector<Path>& paths)
{
    std::vector<Index> twin = whole.surface.twin;
    for (const Path& path : paths)
        for (const Index h : path) twin[whole.surface.twin[h]] = twin[h] = no_twin;
    Index count = 0;
    connected_pieces(twin, std::vector<int>(twin.size() / 3, 0), count);
    return count;
}

double length_of(const CutSurface& whole, const std::vector<Path>& paths)
{
    double sum = 0.0;
    for (const Path& path : paths)
        for (const Index h : path) sum += whole.lengths[h];
    return sum;
}

/// A flat square grid of squares that are polygons, so that no path goes along a diagonal.
CutSurface squares(int side)
{
    Vertices vertices((side + 1) * (side + 1), 3);
    const auto at = [&](int i, int j) { return static_cast<Index>(j * (side + 1) + i); };
    for (int j = 0; j <= side; ++j)
        for (int i = 0; i <= side; ++i) vertices.row(at(i, j)) << i / double(side), j / double(side), 0.0;
    std::vector<Index> polygon;
    for (Index k = 0; k < side * side; ++k) polygon.insert(polygon.end(), 2, k);
    return cut_surface(vertices, test::grid(side, side, at), polygon);
}

/// The path of edges through these vertices.
Path path_through(const CutSurface& whole, const std::vector<Index>& vertices)
{
    const Triangles& triangles = whole.surface.triangles;
    Path path;
    for (std::size_t i = 0; i + 1 < vertices.size(); ++i)
        for (Index h = 0; h < static_cast<Index>(triangles.size()); ++h)
            if (origin(triangles, h) == vertices[i] && target(triangles, h) == vertices[i + 1]) path.push_back(h);
    return path;
}

std::vector<Index> vertices_of(const CutSurface& whole, const Path& path)
{
    std::vector<Index> vertices{origin(whole.surface.triangles, path.front())};
    for (const Index h : path) vertices.push_back(target(whole.surface.triangles, h));
    return vertices;
}

/// For each vertex where paths end their numbers, counter-clockwise from the lowest one; without the boundary.
std::map<Index, std::vector<int>> orders_of(const CutSurface& whole, const std::vector<Path>& paths)
{
    std::map<Index, int> number;  // by the half-edge with which a path leaves its end: twice its own, or one more
    for (std::size_t k = 0; k < paths.size(); ++k) {
        number[paths[k].front()] = 2 * static_cast<int>(k);
        number[whole.surface.twin[paths[k].back()]] = 2 * static_cast<int>(k) + 1;
    }
    const std::vector<char> outside = boundary_mask(whole.surface);
    std::map<Index, std::vector<int>> orders;
    for (const auto& [leaving, own] : number) {
        const Index v = origin(whole.surface.triangles, leaving);
        if (outside[v] || orders.contains(v)) continue;
        std::vector<int>& order = orders[v];
        Index h = leaving;
        do {
            if (number.contains(h)) order.push_back(number.at(h));
            h = whole.surface.twin[previous_halfedge(h)];
        } while (h != leaving);
        std::ranges::rotate(order, std::ranges::min_element(order));
    }
    return orders;
}

}  // namespace

TEST(StraightPaths, a_staircase_gets_fewer_steps_of_the_same_length)
{
    const CutSurface whole = squares(20);
    std::vector<Index> stairs;
    for (int k = 4; k <= 14; ++k) {
        stairs.push_back(21 * k + k);
        if (k < 14) stairs.push_back(21 * k + k + 1);
    }
    std::vector<Path> paths{path_through(whole, stairs)};
    straighten(whole, paths, ExecutionContext());
    ASSERT_EQ(paths[0].size(), 20U);
    int turns = 0;
    const std::vector<Index> now = vertices_of(whole, paths[0]);
    for (std::size_t i = 1; i + 1 < now.size(); ++i) turns += now[i] - now[i - 1] != now[i + 1] - now[i];
    EXPECT_LE(turns, 10);  // of 19
    EXPECT_EQ(now.front(), stairs.front());
    EXPECT_EQ(now.back(), stairs.back());
}

TEST(StraightPaths, stay_where_another_path_ends_on_them_or_a_loop_begins)
{
    const CutSurface whole = squares(20);
    const auto at = [](int i, int j) { return static_cast<Index>(21 * j + i); };
    // Along a row with a bump at (10, 11), where another path ends that comes from above.
    std::vector<Index> along, stem;
    for (int i = 4; i <= 9; ++i) along.push_back(at(i, 10));
    along.insert(along.end(), {at(9, 11), at(10, 11), at(11, 11)});
    for (int i = 11; i <= 16; ++i) along.push_back(at(i, 10));
    for (int j = 20; j >= 11; --j) stem.push_back(at(10, j));
    std::vector<Path> paths{path_through(whole, along), path_through(whole, stem)};
    straighten(whole, paths, ExecutionContext());
    const std::vector<Index> row = vertices_of(whole, paths[0]);
    EXPECT_EQ(std::ranges::count(row, at(10, 11)), 1);
    EXPECT_EQ(vertices_of(whole, paths[1]).back(), at(10, 11));

    // A loop of 8 x 8 squares with its beginning at a spike, where a path to the boundary ends.
    std::vector<Index> loop{at(10, 15), at(10, 14)};
    for (int i = 9; i >= 6; --i) loop.push_back(at(i, 14));
    for (int j = 13; j >= 6; --j) loop.push_back(at(6, j));
    for (int i = 7; i <= 14; ++i) loop.push_back(at(i, 6));
    for (int j = 7; j <= 14; ++j) loop.push_back(at(14, j));
    for (int i = 13; i >= 11; --i) loop.push_back(at(i, 14));
    loop.insert(loop.end(), {at(11, 15), at(10, 15)});
    stem.clear();
    for (int j = 20; j >= 15; --j) stem.push_back(at(10, j));
    paths = {path_through(whole, loop), path_through(whole, stem)};
    straighten(whole, paths, ExecutionContext());
    EXPECT_EQ(vertices_of(whole, paths[0]).front(), at(10, 15));
    EXPECT_EQ(vertices_of(whole, paths[0]).back(), at(10, 15));
    EXPECT_EQ(pieces_between(whole, paths), 2);
    // The same where the loop begins elsewhere.
    loop.pop_back();
    std::ranges::rotate(loop, loop.begin() + 12);
    loop.push_back(loop.front());
    paths = {path_through(whole, loop), path_through(whole, stem)};
    straighten(whole, paths, ExecutionContext());
    EXPECT_EQ(std::ranges::count(vertices_of(whole, paths[0]), at(10, 15)), 1);
    EXPECT_EQ(pieces_between(whole, paths), 2);
}

TEST(StraightPaths, a_ring_that_steps_up_and_down_becomes_a_row)
{
    const int around = 48;
    const CutSurface whole = tube(around, 20);
    // Faces below a border that goes up and down by a row, four edges at a time.
    std::vector<int> label;
    for (Index f = 0; f < static_cast<Index>(whole.areas.size()); ++f) {
        const Index column = f / 2 % around, row = f / 2 / around;
        label.push_back(row < (column / 4 % 2 == 0 ? 10 : 11));
    }
    std::vector<Path> paths = chains_of(whole.surface, borders_of(whole, label));
    ASSERT_EQ(paths.size(), 1U);
    ASSERT_EQ(paths[0].size(), 60U);
    straighten(whole, paths, ExecutionContext());
    EXPECT_EQ(paths[0].size(), 48U);
    std::set<double> heights;
    for (const Index h : paths[0])
        heights.insert(std::round(1e9 * whole.vertices(origin(whole.surface.triangles, h), 2)));
    EXPECT_EQ(heights.size(), 1U);
}

TEST(StraightPaths, keep_their_ends_and_all_regions_and_meet_nowhere_else)
{
    std::mt19937 random(7);
    double before = 0.0, after = 0.0;
    for (int time = 0; time < 100; ++time) {
        const Regions regions = random_regions(random, 24, 3 + static_cast<int>(random() % 8));
        const CutSurface& whole = regions.whole;
        const Triangles& triangles = whole.surface.triangles;
        const std::vector<Path> old = chains_of(whole.surface, borders_of(whole, regions.label));
        std::vector<Path> paths = old;
        straighten(whole, paths, ExecutionContext());
        EXPECT_EQ(pieces_between(whole, paths), pieces_between(whole, old)) << time;
        std::map<Index, std::vector<int>> orders = orders_of(whole, old);
        for (const auto& [v, order] : orders_of(whole, paths))
            if (order.size() > 2) EXPECT_EQ(order, orders[v]) << time;
        std::map<Index, int> inside;
        std::set<Index> ends;
        for (std::size_t k = 0; k < paths.size(); ++k) {
            const Path& path = paths[k];
            ASSERT_FALSE(path.empty());
            for (std::size_t i = 0; i + 1 < path.size(); ++i) {
                EXPECT_EQ(target(triangles, path[i]), origin(triangles, path[i + 1]));
                ++inside[target(triangles, path[i])];
            }
            const bool closes = origin(triangles, old[k].front()) == target(triangles, old[k].back());
            if (!closes) {
                EXPECT_EQ(origin(triangles, path.front()), origin(triangles, old[k].front()));
                EXPECT_EQ(target(triangles, path.back()), target(triangles, old[k].back()));
            }
            EXPECT_EQ(origin(triangles, path.front()) == target(triangles, path.back()), closes);
            ends.insert({origin(triangles, path.front()), target(triangles, path.back())});
        }
        const std::vector<char> outside = boundary_mask(whole.surface);
        for (const auto& [v, count] : inside) {
            EXPECT_EQ(count, 1) << time;
            EXPECT_FALSE(ends.contains(v) || outside[v]) << time;
        }
        before += length_of(whole, old);
        after += length_of(whole, paths);
    }
    EXPECT_LT(after, 0.75 * before);
}

TEST(StraightBorders, parts_keep_their_faces_between_straight_borders)
{
    const int around = 48;
    const CutSurface whole = tube(around, 20);
    std::vector<std::vector<Index>> faces(2);
    for (Index f = 0; f < static_cast<Index>(whole.areas.size()); ++f)
        faces[f / 2 / around < (f / 2 % around / 4 % 2 == 0 ? 10 : 11)].push_back(f);
    ExecutionContext context;
    SplitEffort effort;
    std::vector<PartPointer> parts = first_parts(whole, faces, context, effort);
    straighten_borders(whole, {{.part_price = 0.03, .cut_price = 0.03}}, parts, context, effort);
    ASSERT_EQ(parts.size(), 2U);
    // Whole rows of faces, and each face in one part.
    for (const PartPointer& part : parts) {
        EXPECT_TRUE(part->map.measured);
        EXPECT_EQ(part->mesh.surface.loops.size(), 2U);
        EXPECT_EQ(part->mesh.faces.size() % (2U * around), 0U);
    }
    EXPECT_EQ(parts[0]->mesh.faces.size() + parts[1]->mesh.faces.size(), static_cast<std::size_t>(whole.areas.size()));
}
