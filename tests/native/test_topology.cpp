#include "core/connectivity.h"
#include "core/errors.h"
#include "mesh/topology.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>

using namespace koebe;

namespace {

/// A torus grid of n x n cells, two triangles each; cells listed in `removed` are left out.
Triangles grid_torus(Index n, const std::set<Index>& removed = {})
{
    std::vector<Index> corners;
    const auto vertex = [n](Index i, Index j) { return (i % n) * n + j % n; };
    for (Index i = 0; i < n; ++i)
        for (Index j = 0; j < n; ++j) {
            if (removed.count(i * n + j)) continue;
            const Index a = vertex(i, j), b = vertex(i + 1, j), c = vertex(i + 1, j + 1), d = vertex(i, j + 1);
            corners.insert(corners.end(), {a, b, c, a, c, d});
        }
    return Eigen::Map<Triangles>(corners.data(), corners.size() / 3, 3);
}

Triangles faces(std::initializer_list<Index> corners)
{
    std::vector<Index> flat(corners);
    return Eigen::Map<Triangles>(flat.data(), flat.size() / 3, 3);
}

Triangles tetrahedron() { return faces({0, 2, 1, 0, 1, 3, 1, 2, 3, 2, 0, 3}); }

template <class Call>
TopologyError topology_error(Call call)
{
    try {
        call();
    } catch (const TopologyError& error) {
        return error;
    }
    ADD_FAILURE() << "no TopologyError";
    return {TopologyKind::closed, ""};
}

}  // namespace

TEST(Topology, one_triangle_is_a_disk_with_its_own_loop)
{
    const Surface surface = analyze_surface(faces({4, 7, 9}), 10);
    EXPECT_EQ(surface.euler_characteristic, 1);
    EXPECT_EQ(surface.genus, 0);
    ASSERT_EQ(surface.loops.size(), 1u);
    EXPECT_EQ(surface.loops[0], (VertexLoop{4, 7, 9}));
    EXPECT_EQ(surface.unused.size(), 7u);
}

TEST(Topology, euler_characteristic_is_two_minus_two_genus_minus_loops)
{
    for (const auto& removed : {std::set<Index>{}, std::set<Index>{0}, std::set<Index>{0, 14, 28}}) {
        const Surface surface = analyze_surface(grid_torus(6, removed), 36);
        EXPECT_EQ(surface.genus, 1);
        EXPECT_EQ(surface.loops.size(), removed.size());
        EXPECT_EQ(surface.euler_characteristic, 2 - 2 - static_cast<int>(removed.size()));
    }
}

TEST(Topology, loops_keep_the_surface_on_their_left)
{
    const Surface surface = analyze_surface(grid_torus(5, {7}), 25);
    const VertexLoop& loop = surface.loops.at(0);
    std::set<std::pair<Index, Index>> directed;
    for (Index h = 0; h < surface.triangles.size(); ++h)
        directed.emplace(origin(surface.triangles, h), target(surface.triangles, h));
    for (std::size_t i = 0; i < loop.size(); ++i) {
        const Index a = loop[i], b = loop[(i + 1) % loop.size()];
        EXPECT_TRUE(directed.count({a, b}));
        EXPECT_FALSE(directed.count({b, a}));
    }
}

TEST(Topology, faces_are_turned_to_the_majority)
{
    Triangles mesh = grid_torus(6, {0});
    std::vector<Index> turned;
    for (Index f = 3; f < mesh.rows(); f += f % 5 == 3 ? 1 : 4) {  // two of five
        std::swap(mesh(f, 0), mesh(f, 1));
        turned.push_back(f);
    }
    const Surface surface = analyze_surface(mesh, 36);
    EXPECT_EQ(surface.reoriented, turned);
    for (Index h = 0; h < surface.triangles.size(); ++h)
        if (surface.twin[h] != no_twin) {
            EXPECT_EQ(origin(surface.triangles, h), target(surface.triangles, surface.twin[h]));
        }
}

TEST(Topology, a_handle_is_named_by_a_loop_through_it)
{
    const Triangles mesh = grid_torus(6, {0, 14});
    const TopologyError error = topology_error([&] { require_bordered_genus_zero(mesh, 36); });
    EXPECT_EQ(error.kind(), TopologyKind::genus);
    // A closed edge path, and one that does not separate: the faces stay connected when it is cut.
    const auto& loop = error.elements();
    ASSERT_GE(loop.size(), 3u);
    std::set<std::pair<Index, Index>> cut;
    for (std::size_t i = 0; i < loop.size(); ++i) {
        const Index a = loop[i], b = loop[(i + 1) % loop.size()];
        cut.emplace(a, b);
        cut.emplace(b, a);
    }
    const Surface surface = analyze_surface(mesh, 36);
    std::size_t edges_found = 0;
    std::vector<Index> queue{0};
    std::set<Index> reached{0};
    for (Index h = 0; h < surface.triangles.size(); ++h)
        edges_found += cut.count({origin(surface.triangles, h), target(surface.triangles, h)});
    EXPECT_GE(edges_found, loop.size());
    while (!queue.empty()) {
        const Index f = queue.back();
        queue.pop_back();
        for (Index h = 3 * f; h < 3 * f + 3; ++h) {
            if (surface.twin[h] == no_twin) continue;
            if (cut.count({origin(surface.triangles, h), target(surface.triangles, h)})) continue;
            if (reached.insert(face_of(surface.twin[h])).second) queue.push_back(face_of(surface.twin[h]));
        }
    }
    EXPECT_EQ(reached.size(), static_cast<std::size_t>(mesh.rows()));
}

TEST(Topology, errors_name_their_elements)
{
    EXPECT_EQ(topology_error([] { require_bordered_genus_zero(tetrahedron(), 4); }).kind(), TopologyKind::closed);

    const TopologyError edge = topology_error([] { analyze_surface(faces({0, 1, 2, 1, 0, 3, 0, 1, 4}), 5); });
    EXPECT_EQ(edge.kind(), TopologyKind::nonmanifold_edge);
    EXPECT_EQ(edge.elements(), (std::vector<Index>{0, 1}));

    const TopologyError bow_tie = topology_error([] {
        analyze_surface(faces({0, 1, 2, 0, 3, 4, 1, 5, 2, 3, 6, 4, 5, 1, 6, 6, 3, 5}), 7);
    });
    EXPECT_EQ(bow_tie.kind(), TopologyKind::nonmanifold_vertex);
    EXPECT_EQ(bow_tie.elements(), (std::vector<Index>{0}));

    const TopologyError apart = topology_error([] { analyze_surface(faces({0, 1, 2, 2, 1, 3, 4, 5, 6}), 7); });
    EXPECT_EQ(apart.kind(), TopologyKind::disconnected);
    EXPECT_EQ(apart.elements(), (std::vector<Index>{2}));

    const TopologyError moebius = topology_error([] {
        analyze_surface(faces({0, 1, 2, 1, 3, 2, 2, 3, 4, 3, 5, 4, 4, 5, 1, 5, 0, 1}), 6);
    });
    EXPECT_EQ(moebius.kind(), TopologyKind::nonorientable);
    EXPECT_EQ(moebius.elements().size(), 2u);
}

TEST(Topology, arrays_that_are_no_mesh_are_refused)
{
    Vertices vertices = Vertices::Random(4, 3);
    const auto elements = [&](const Vertices& v, const Triangles& t) {
        try {
            validate_arrays(v, t);
        } catch (const InputError& error) {
            return error.elements();
        }
        ADD_FAILURE() << "no InputError";
        return std::vector<Index>{};
    };
    EXPECT_EQ(elements(vertices, faces({0, 1, 2, 1, 2, 4})), (std::vector<Index>{1}));
    EXPECT_EQ(elements(vertices, faces({0, 1, 2, -1, 2, 3})), (std::vector<Index>{1}));
    EXPECT_EQ(elements(vertices, faces({0, 1, 1})), (std::vector<Index>{0}));
    vertices(2, 1) = std::numeric_limits<double>::quiet_NaN();
    EXPECT_EQ(elements(vertices, faces({0, 1, 3})), (std::vector<Index>{2}));
    EXPECT_THROW(validate_arrays(Vertices(0, 3), faces({0, 1, 2})), InputError);
    EXPECT_THROW(validate_arrays(vertices, Triangles(0, 3)), InputError);
}
