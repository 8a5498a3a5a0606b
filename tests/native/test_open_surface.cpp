// Laws of open_surface: whatever comes in, what comes out can be mapped, and every face is accounted for.
#include "core/errors.h"
#include "cut/open_surface.h"
#include "damaged_meshes.h"
#include "mesh/topology.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>
#include <utility>

using namespace koebe;
using namespace koebe::test;

namespace {

std::set<std::pair<Index, Index>> edges_of(const Triangles& triangles)
{
    std::set<std::pair<Index, Index>> edges;
    for (Eigen::Index f = 0; f < triangles.rows(); ++f)
        for (int k = 0; k < 3; ++k) edges.insert(std::minmax({triangles(f, k), triangles(f, (k + 1) % 3)}));
    return edges;
}

void expect_faces_of_input(const NamedMesh& mesh, const SurfacePiece& piece)
{
    EXPECT_TRUE(std::ranges::is_sorted(piece.source_face));
    ASSERT_EQ(piece.source_face.size(), static_cast<std::size_t>(piece.triangles.rows()));
    for (std::size_t f = 0; f < piece.source_face.size(); ++f) {
        const auto own = static_cast<Eigen::Index>(f);
        Eigen::RowVector3i corners = mesh.triangles.row(piece.source_face[f]);
        if (piece.turned[f]) std::swap(corners[1], corners[2]);
        for (int k = 0; k < 3; ++k) {
            const Index v = piece.triangles(own, k);
            EXPECT_EQ(piece.source_vertex[v], corners[k]);
            EXPECT_EQ(piece.vertices.row(v), mesh.vertices.row(corners[k]));
        }
    }
}

void expect_laws(const NamedMesh& mesh, const OpenedSurface& opened)
{
    std::vector<int> times(static_cast<std::size_t>(mesh.triangles.rows()), 0);
    for (const SurfacePiece& piece : opened.pieces) {
        const Surface surface = require_bordered_genus_zero(piece.triangles, static_cast<Index>(piece.vertices.rows()));
        EXPECT_TRUE(surface.reoriented.empty());
        EXPECT_TRUE(surface.unused.empty());
        expect_faces_of_input(mesh, piece);
        for (const Index f : piece.source_face) ++times[f];
    }
    for (const LeftOutFace& out : opened.left_out) {
        ++times[out.face];
        EXPECT_TRUE(out.degenerate || out.like < out.face);
    }
    EXPECT_EQ(std::ranges::count(times, 1), mesh.triangles.rows());
    const auto edges = edges_of(mesh.triangles);
    for (const SurfaceCut& cut : opened.cuts)
        for (std::size_t i = 0; cut.kind != CutKind::bow_tie && i + 1 < cut.vertices.size(); ++i)
            EXPECT_TRUE(edges.count(std::minmax({cut.vertices[i], cut.vertices[i + 1]})));
}

OpenedSurface opened_by_law(const NamedMesh& mesh, const OpenOptions& options = {})
{
    SCOPED_TRACE(mesh.name);
    OpenedSurface opened = open_surface(mesh.vertices, mesh.triangles, options);
    expect_laws(mesh, opened);
    return opened;
}

std::size_t cuts_of(const OpenedSurface& opened, CutKind kind)
{
    return static_cast<std::size_t>(std::ranges::count(opened.cuts, kind, &SurfaceCut::kind));
}

}  // namespace

TEST(OpenSurface, a_closed_sphere_is_opened_by_one_slit_from_end_to_end)
{
    const OpenedSurface opened = opened_by_law(coarse_sphere(10, 12));
    ASSERT_EQ(opened.pieces.size(), 1u);
    ASSERT_EQ(opened.cuts.size(), 1u);
    EXPECT_EQ(opened.cuts[0].kind, CutKind::opening);
    EXPECT_GE(opened.cuts[0].vertices.size(), 8u);
}

TEST(OpenSurface, a_short_slit_has_two_edges)
{
    const OpenedSurface opened = opened_by_law(coarse_sphere(10, 12), {.long_slit = false});
    ASSERT_EQ(opened.cuts.size(), 1u);
    EXPECT_EQ(opened.cuts[0].vertices.size(), 3u);
}

TEST(OpenSurface, as_many_handles_are_cut_as_the_genus)
{
    for (const int holes : {0, 1, 2, 7}) {
        const OpenedSurface opened = opened_by_law(plate_with_holes(holes, 2));
        EXPECT_EQ(opened.handles, holes);
        EXPECT_EQ(cuts_of(opened, CutKind::handle), static_cast<std::size_t>(holes));
        EXPECT_EQ(opened.pieces.size(), 1u);
    }
}

TEST(OpenSurface, a_handle_is_cut_along_its_shortest_loop)
{
    const NamedMesh ring = coarse_torus(24, 9, 0.2);
    const OpenedSurface opened = opened_by_law(ring, {.long_slit = false});
    ASSERT_EQ(opened.cuts.size(), 1u);
    EXPECT_EQ(opened.cuts[0].vertices.size(), 10u);  // nine edges round the tube, closed
    EXPECT_EQ(opened.cuts[0].vertices.front(), opened.cuts[0].vertices.back());
}

TEST(OpenSurface, what_can_be_mapped_already_stays_whole)
{
    NamedMesh cap = coarse_sphere(8, 9);
    cap.triangles = cap.triangles.bottomRows(cap.triangles.rows() - 1).eval();
    const OpenedSurface opened = opened_by_law(cap);
    EXPECT_TRUE(opened.cuts.empty());
    EXPECT_TRUE(opened.left_out.empty());
    ASSERT_EQ(opened.pieces.size(), 1u);
    EXPECT_EQ(opened.pieces[0].triangles.rows(), cap.triangles.rows());
    EXPECT_EQ(opened.pieces[0].vertices.rows(), cap.vertices.rows());
}

TEST(OpenSurface, one_sided_surfaces_are_cut_where_the_side_changes)
{
    EXPECT_GE(cuts_of(opened_by_law(moebius_band(12, 3)), CutKind::orientation), 1u);
    EXPECT_GE(cuts_of(opened_by_law(klein_bottle(12, 8)), CutKind::orientation), 1u);
}

TEST(OpenSurface, disagreeing_faces_are_turned_and_nothing_is_cut)
{
    NamedMesh cap = coarse_sphere(8, 9);
    cap.triangles = cap.triangles.bottomRows(cap.triangles.rows() - 1).eval();
    for (const Index f : {3, 20, 21}) std::swap(cap.triangles(f, 0), cap.triangles(f, 1));
    const OpenedSurface opened = opened_by_law(cap);
    ASSERT_EQ(opened.pieces.size(), 1u);
    EXPECT_TRUE(opened.cuts.empty());
    EXPECT_EQ(std::ranges::count(opened.pieces[0].turned, 1), 3);
}

TEST(OpenSurface, three_sheets_at_an_edge_come_apart)
{
    NamedMesh book{"book", Vertices(5, 3), Triangles(3, 3)};
    book.vertices << 0, 0, 0, 0, 0, 1, 1, 0, 0, 0, 1, 0, -1, 0, 0;
    book.triangles << 0, 1, 2, 0, 1, 3, 0, 1, 4;
    const OpenedSurface opened = opened_by_law(book);
    EXPECT_EQ(opened.pieces.size(), 3u);
    ASSERT_EQ(opened.cuts.size(), 1u);
    EXPECT_EQ(opened.cuts[0].kind, CutKind::crowded_edge);
    EXPECT_EQ(opened.cuts[0].vertices, (std::vector<Index>{0, 1}));
}

TEST(OpenSurface, a_bow_tie_comes_apart_in_its_vertex)
{
    NamedMesh tie{"bow tie", Vertices(5, 3), Triangles(2, 3)};
    tie.vertices << 0, 0, 0, 1, 0, 0, 1, 1, 0, -1, 0, 0, -1, -1, 0;
    tie.triangles << 0, 1, 2, 0, 3, 4;
    const OpenedSurface opened = opened_by_law(tie);
    EXPECT_EQ(opened.pieces.size(), 2u);
    ASSERT_EQ(opened.cuts.size(), 1u);
    EXPECT_EQ(opened.cuts[0].kind, CutKind::bow_tie);
    EXPECT_EQ(opened.cuts[0].vertices, (std::vector<Index>{0}));
}

TEST(OpenSurface, duplicates_and_collapsed_faces_are_left_out)
{
    NamedMesh pair{"pair", Vertices(4, 3), Triangles(4, 3)};
    pair.vertices << 0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, 0;
    pair.triangles << 0, 1, 2, 1, 3, 2, 2, 1, 0, 3, 3, 1;
    const OpenedSurface opened = opened_by_law(pair);
    ASSERT_EQ(opened.pieces.size(), 1u);
    EXPECT_TRUE(opened.cuts.empty());
    ASSERT_EQ(opened.left_out.size(), 2u);
    EXPECT_EQ(opened.left_out[0].like, 0);
    EXPECT_FALSE(opened.left_out[0].degenerate);
    EXPECT_EQ(opened.left_out[1].like, 1);
    EXPECT_TRUE(opened.left_out[1].degenerate);
}

TEST(OpenSurface, polygons_are_not_cut_apart)
{
    for (const NamedMesh& mesh :
         {plate_with_holes(3), coarse_torus(4, 4, 0.3), klein_bottle(5, 4), moebius_band(5, 2)}) {
        OpenOptions options;
        for (Index f = 0; f < static_cast<Index>(mesh.triangles.rows()); ++f) options.polygon.push_back(f / 2);
        const OpenedSurface opened = opened_by_law(mesh, options);
        for (const SurfacePiece& piece : opened.pieces)
            for (std::size_t f = 0; f < piece.source_face.size(); f += 2) {  // both halves, and they share an edge
                ASSERT_EQ(piece.source_face[f] / 2, piece.source_face[f + 1] / 2) << mesh.name;
                std::set<Index> corners;
                for (const auto row : {static_cast<Eigen::Index>(f), static_cast<Eigen::Index>(f + 1)})
                    for (int k = 0; k < 3; ++k) corners.insert(piece.triangles(row, k));
                EXPECT_EQ(corners.size(), 4u) << mesh.name;
            }
    }
}

TEST(OpenSurface, no_face_at_all_is_an_input_error)
{
    const Vertices vertices = Vertices::Zero(3, 3);
    EXPECT_THROW(open_surface(vertices, Triangles(0, 3)), InputError);
    EXPECT_THROW(open_surface(vertices, Triangles::Constant(2, 3, 1)), InputError);
    EXPECT_THROW(open_surface(vertices, Triangles::Constant(1, 3, 7)), InputError);
}

TEST(OpenSurface, its_laws_hold_for_thousands_of_random_meshes)
{
    for (std::uint32_t seed = 0; seed < 4000; ++seed) {
        SCOPED_TRACE(seed);
        const NamedMesh mesh = random_mesh(seed);
        try {
            for (const bool long_slit : {true, false}) opened_by_law(mesh, {.long_slit = long_slit});
            OpenOptions pairs;
            for (Index f = 0; f < static_cast<Index>(mesh.triangles.rows()); ++f) pairs.polygon.push_back(f / 2);
            opened_by_law(mesh, pairs);
        } catch (const InputError&) {  // no face is left
            for (const auto& face : mesh.triangles.rowwise())
                EXPECT_TRUE(face[0] == face[1] || face[1] == face[2] || face[2] == face[0]);
        }
        if (HasFailure()) break;
    }
}
