// Passes over large surfaces and files: whatever number of threads they take, each gives the same bits.
#include "circle_domain.h"
#include "temporary_folder.h"

#include "canonical/canonical_form.h"
#include "core/connectivity.h"
#include "core/errors.h"
#include "execution/thread_share.h"
#include "files/file_error.h"
#include "io/mesh_reader.h"
#include "io/mesh_writer.h"
#include "io/polygon_triangulation.h"
#include "linear/condensed_laplacian.h"
#include "linear/dense_spd.h"
#include "mesh/topology.h"
#include "surface/intrinsic_metric.h"
#include "surface/laplacian.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <csignal>
#include <cstring>
#include <numeric>
#include <random>

#include <sys/resource.h>

using namespace koebe;
using namespace koebe::test;

namespace {

/// A pair of rims with all edges of each equally long; vertices and faces in no order.
struct LargeSurface {
    Vertices vertices;
    Triangles triangles;
};

LargeSurface large_surface()
{
    const CircleDomain ring = make_round_annulus(0.4, 500, 160);  // several pieces and ranges
    const Vertices ordered = lift(ring.points, Lift::enneper);
    std::mt19937 random(7);
    std::vector<Index> place(static_cast<std::size_t>(ordered.rows())), face(ring.triangles.rows());
    std::iota(place.begin(), place.end(), 0);
    std::iota(face.begin(), face.end(), 0);
    std::ranges::shuffle(place, random);
    std::ranges::shuffle(face, random);
    LargeSurface result{Vertices(ordered.rows(), 3), Triangles(ring.triangles.rows(), 3)};
    for (Eigen::Index v = 0; v < ordered.rows(); ++v) result.vertices.row(place[v]) = ordered.row(v);
    for (Eigen::Index f = 0; f < result.triangles.rows(); ++f)
        for (int k = 0; k < 3; ++k) result.triangles(f, k) = place[ring.triangles(face[f], (k + face[f]) % 3)];
    return result;
}

/// @param work gives what can be compared
template <class Work>
void expect_same_bits(const Work& work)
{
    const auto one = [&] {
        const ThreadShare threads(1);
        return work();
    }();
    for (const int count : {2, 3}) {
        const ThreadShare threads(count);
        EXPECT_TRUE(work() == one) << count << " threads";
    }
}

auto entries_of(const SparseMatrix& matrix)
{
    return std::pair(std::vector<Index>(matrix.innerIndexPtr(), matrix.innerIndexPtr() + matrix.nonZeros()),
                     std::vector<double>(matrix.valuePtr(), matrix.valuePtr() + matrix.nonZeros()));
}

template <class Number>
std::string raw(Number number)
{
    std::string bytes(sizeof number, '\0');
    std::memcpy(bytes.data(), &number, sizeof number);
    return bytes;
}

constexpr Index column_count = 300;

/// Triangles and quadrilaterals, more than one piece of each.
PolygonMesh mixed_polygons()
{
    constexpr Index rows = 260;
    PolygonMesh mesh;
    mesh.vertices.resize(rows * column_count, 3);
    for (Index v = 0; v < rows * column_count; ++v) {
        const Index row = v / column_count;
        mesh.vertices.row(v) << v % column_count, row, 0.1 * ((7 * v) % 11);
    }
    const auto add = [&](std::initializer_list<Index> face) {
        mesh.corners.insert(mesh.corners.end(), face);
        mesh.face_begin.push_back(static_cast<Index>(mesh.corners.size()));
    };
    for (Index v = 0; v + column_count + 1 < rows * column_count; ++v) {
        if (v % column_count == column_count - 1) continue;
        if (v % 3 == 0) {
            add({v, v + 1, v + column_count + 1});
            add({v, v + column_count + 1, v + column_count});
        } else {
            add({v, v + 1, v + column_count + 1, v + column_count});
        }
    }
    return mesh;
}

/// With properties of other sizes around those that count.
std::string binary_ply(const PolygonMesh& mesh)
{
    std::string bytes = "ply\nformat binary_little_endian 1.0\nelement vertex " + std::to_string(mesh.vertices.rows()) +
                        "\nproperty uchar red\nproperty double x\nproperty double y\nproperty short w\n"
                        "property double z\nelement face " +
                        std::to_string(mesh.face_count()) +
                        "\nproperty short before\nproperty list uchar int vertex_indices\nproperty float after\n"
                        "end_header\n";
    for (Eigen::Index v = 0; v < mesh.vertices.rows(); ++v)
        bytes +=
            'r' + raw(mesh.vertices(v, 0)) + raw(mesh.vertices(v, 1)) + raw(std::int16_t{1}) + raw(mesh.vertices(v, 2));
    for (Index f = 0; f < mesh.face_count(); ++f) {
        bytes += raw(std::int16_t{3}) + static_cast<char>(mesh.face(f).size());
        for (const Index v : mesh.face(f)) bytes += raw(v);
        bytes += raw(0.5F);
    }
    return bytes;
}

/// No file may grow above a megabyte for the object's lifetime.
class SmallFiles {
public:
    SmallFiles() : handler_(std::signal(SIGXFSZ, SIG_IGN))
    {
        ::getrlimit(RLIMIT_FSIZE, &before_);
        rlimit small = before_;
        small.rlim_cur = 1 << 20;
        ::setrlimit(RLIMIT_FSIZE, &small);
    }
    ~SmallFiles()
    {
        ::setrlimit(RLIMIT_FSIZE, &before_);
        std::signal(SIGXFSZ, handler_);
    }
    SmallFiles(const SmallFiles&) = delete;
    SmallFiles& operator=(const SmallFiles&) = delete;

private:
    void (*handler_)(int);
    rlimit before_{};
};

bool same(const PolygonMesh& a, const PolygonMesh& b)
{
    return a.vertices == b.vertices && a.corners == b.corners && a.face_begin == b.face_begin;
}

}  // namespace

TEST(Passes, ranges_cover_all_once)
{
    for (const int threads : {1, 2, 3, 20})
        for (const std::size_t size : {0, 1, 16383, 16384, 100001}) {
            const ThreadShare share(threads);
            std::vector<char> seen(size, 0);
            in_ranges(size, [&](std::size_t begin, std::size_t end) {
                for (std::size_t i = begin; i < end; ++i) ++seen[i];
            });
            EXPECT_EQ(std::ranges::count(seen, 1), static_cast<std::ptrdiff_t>(size)) << threads;
        }
}

TEST(Passes, topology)
{
    const LargeSurface surface = large_surface();
    expect_same_bits([&] {
        const Surface found = analyze_surface(surface.triangles, static_cast<Index>(surface.vertices.rows()));
        EXPECT_EQ(found.loops.size(), 2U);
        return std::tuple(found.twin, found.loops, found.euler_characteristic, found.genus);
    });
}

TEST(Passes, the_canonical_form)
{
    const LargeSurface given = large_surface();
    const Surface surface = analyze_surface(given.triangles, static_cast<Index>(given.vertices.rows()));
    expect_same_bits([&] {
        CanonicalForm form = canonical_form(surface, given.vertices);
        EXPECT_EQ(form.surface.twin, pair_halfedges(form.surface.triangles, form.surface.vertex_count));
        for (Index f = 0; f < static_cast<Index>(form.original_faces.size()); f += 7) {
            const auto corner = [&](int k) { return form.original_vertices[form.surface.triangles(f, k % 3)]; };
            const auto of_input = [&](int k) { return given.triangles(form.original_faces[f], k); };
            int first = 0;
            while (first < 2 && corner(first) != of_input(0)) ++first;
            for (int k = 0; k < 3; ++k) EXPECT_EQ(corner(first + k), of_input(k));
        }
        return std::tuple(Triangles(form.surface.triangles), form.surface.twin, form.surface.loops,
                          Vertices(form.vertices), form.original_vertices, form.original_faces, form.thinnest);
    });
}

TEST(Passes, metric_and_laplacian)
{
    const LargeSurface given = large_surface();
    const Surface surface = analyze_surface(given.triangles, static_cast<Index>(given.vertices.rows()));
    expect_same_bits([&] {
        const IntrinsicMetric metric = intrinsic_metric(given.vertices, surface);
        EXPECT_FALSE(metric.flips.empty());
        return std::tuple(
            metric.flips, EdgeLengths(metric.lengths),
            entries_of(cotan_laplacian(metric.triangles, half_cotangents(metric.lengths), surface.vertex_count)),
            VectorXd(vertex_areas(metric.triangles, metric.lengths, surface.vertex_count)));
    });
}

TEST(Passes, extensions_and_fluxes)
{
    fix_product_blocks();
    const LargeSurface given = large_surface();
    const Surface surface = analyze_surface(given.triangles, static_cast<Index>(given.vertices.rows()));
    const SparseMatrix laplacian = cotan_laplacian(
        surface.triangles, half_cotangents(edge_lengths(given.vertices, surface.triangles)), surface.vertex_count);
    std::vector<Index> boundary = surface.loops[0];
    boundary.insert(boundary.end(), surface.loops[1].begin(), surface.loops[1].end());
    const Index outer = static_cast<Index>(surface.loops[0].size());
    MatrixXd values(boundary.size(), 2);
    for (Eigen::Index b = 0; b < values.rows(); ++b) values.row(b) << std::sin(0.1 * b), std::cos(0.3 * b);
    for (const Index grounded : {Index{0}, outer})
        expect_same_bits([&] {
            CondensedLaplacian condensed(laplacian, boundary, grounded);
            MatrixXd extension = condensed.extend(values);
            const VectorXd load = extension.col(0);
            InteriorSolution inner = condensed.solve_interior(load);
            VectorXd flux;
            if (grounded > 0) {
                // The flux into what is grounded, from the whole product.
                VectorXd on_rest = values.col(0);
                on_rest.head(grounded).setZero();
                const VectorXd whole = -(laplacian * VectorXd(condensed.extend(on_rest).col(0)));
                flux = condensed.flux_to_grounded(values.col(0).tail(values.rows() - grounded));
                EXPECT_EQ(flux, VectorXd(whole(surface.loops[0])));
            }
            return std::tuple(std::move(extension), std::move(inner.values), std::move(inner.boundary_flux),
                              MatrixXd(condensed.sigma()), std::move(flux));
        });
}

TEST(Passes, a_written_file)
{
    const TemporaryFolder folder;
    const PolygonMesh mesh = mixed_polygons();
    const PlanarPoints uv = mesh.vertices.leftCols(2) / 1000.0;
    for (const char* const extension : {".ply", ".obj"})
        expect_same_bits([&] {
            AtomicFile file(folder.path() / "out");
            write_with_uvs(file, *io::mesh_format(extension), mesh, uv, {MeshFile{}});
            file.commit();
            return bytes_of(folder.path() / "out");
        });
}

// The failure comes in a piece, while others wait for their turn.
TEST(Passes, a_file_that_cannot_be_written_fails_on_all_threads)
{
    const TemporaryFolder folder;
    const PolygonMesh mesh = mixed_polygons();
    const SmallFiles small;
    for (const int count : {1, 2, 3}) {
        const ThreadShare threads(count);
        AtomicFile file(folder.path() / "out.ply");
        EXPECT_THROW(write_with_uvs(file, *io::mesh_format(".ply"), mesh, mesh.vertices.leftCols(2), {MeshFile{}}),
                     FileError);
    }
}

TEST(Passes, a_read_file)
{
    const PolygonMesh mesh = mixed_polygons();
    const std::string bytes = binary_ply(mesh);
    for (const int count : {1, 2, 3}) {
        const ThreadShare threads(count);
        const PolygonMesh read = parse_mesh(bytes, ".ply");
        EXPECT_TRUE(same(read, mesh)) << count;
    }
    // What ends too early, or names no vertex, is told as it was.
    for (const std::size_t missing : {1, 4, 5, 5000}) {
        try {
            parse_mesh(std::string_view(bytes).substr(0, bytes.size() - missing), ".ply");
            ADD_FAILURE() << missing;
        } catch (const InputError& error) {
            EXPECT_NE(std::string(error.what()).find("is cut short"), std::string::npos) << error.what();
        }
    }
    PolygonMesh wrong = mesh;
    wrong.corners[200001] = -1;
    expect_same_bits([&] {
        try {
            parse_mesh(binary_ply(wrong), ".ply");
        } catch (const InputError& error) {
            return error.elements();
        }
        return std::vector<Index>();
    });
}

TEST(Passes, triangles_of_a_file)
{
    const LargeSurface given = large_surface();
    PolygonMesh mesh;
    mesh.vertices = given.vertices;
    mesh.corners.assign(given.triangles.data(), given.triangles.data() + given.triangles.size());
    for (Index f = 0; f < static_cast<Index>(given.triangles.rows()); ++f) mesh.face_begin.push_back(3 * f + 3);
    expect_same_bits([&] {
        const Triangulation cut = triangulate(mesh);
        EXPECT_EQ(cut.triangles, given.triangles);
        return std::pair(Triangles(cut.triangles), cut.face);
    });
    mesh.corners[3] = mesh.corners[4];  // one of them is none
    const Triangulation cut = triangulate(mesh);
    EXPECT_EQ(cut.collapsed, std::vector<Index>{1});
    EXPECT_EQ(cut.triangles.bottomRows(cut.triangles.rows() - 1), given.triangles.bottomRows(cut.triangles.rows() - 1));
}
