// Laws of the PLY writer: what is written reads back to the last bit, with its texture coordinates and patches.
#include "io/ply_writer.h"

#include "core/errors.h"
#include "io/mesh_reader.h"
#include "io/mesh_writer.h"
#include "random_polygons.h"
#include "temporary_folder.h"

#include <CGAL/IO/PLY.h>
#include <CGAL/Simple_cartesian.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <limits>
#include <sstream>

namespace koebe {
namespace {

using test::bytes_of;
using test::points_of_the_disk;
using test::random_polygons;
using test::TemporaryFolder;

template <typename Write>
std::string written(const TemporaryFolder& folder, Write write)
{
    AtomicFile file(folder.path() / "out.ply");
    write(file);
    file.commit();
    return bytes_of(folder.path() / "out.ply");
}

/// The words of the line that the header is followed by, and of those after it.
std::vector<std::vector<double>> rows(const std::string& text)
{
    std::istringstream lines(text.substr(text.find("end_header\n") + 11));
    std::vector<std::vector<double>> result;
    for (std::string line; std::getline(lines, line);) {
        std::istringstream words(line);
        result.emplace_back();
        for (std::string word; words >> word;) result.back().push_back(std::strtod(word.c_str(), nullptr));
    }
    return result;
}

TEST(MeshWriter, ReadsBackToTheLastBitInTheSameOrder)
{
    const TemporaryFolder folder;
    PolygonMesh mesh = random_polygons(5000, 3000);  // several buffers full
    mesh.vertices.row(0) << -0.0, std::numeric_limits<double>::denorm_min(), std::numeric_limits<double>::max();
    for (const std::string extension : {".obj", ".ply"}) {
        AtomicFile file(folder.path() / ("out" + extension));
        write_with_uvs(file, *io::mesh_format(extension), mesh, PlanarPoints::Zero(5000, 2), {MeshFile{}});
        file.commit();
        const PolygonMesh read = read_mesh(folder.path() / ("out" + extension));
        EXPECT_TRUE(read.vertices == mesh.vertices);
        EXPECT_EQ(read.corners, mesh.corners);
        EXPECT_EQ(read.face_begin, mesh.face_begin);
    }
}

TEST(PlyWriter, CgalReadsTheSame)
{
    using Point = CGAL::Simple_cartesian<double>::Point_3;
    const TemporaryFolder folder;
    const PolygonMesh mesh = random_polygons(50, 30);
    written(folder, [&](AtomicFile& file) { write_ply_with_patches(file, mesh, std::vector<Index>(30, -1)); });
    std::vector<Point> points;
    std::vector<std::vector<std::size_t>> polygons;
    std::ifstream stream(folder.path() / "out.ply");
    ASSERT_TRUE(CGAL::IO::read_PLY(stream, points, polygons));
    ASSERT_EQ(points.size(), 50u);
    for (Index v = 0; v < 50; ++v)
        EXPECT_EQ(points[v], Point(mesh.vertices(v, 0), mesh.vertices(v, 1), mesh.vertices(v, 2)));
    ASSERT_EQ(polygons.size(), 30u);
    for (Index f = 0; f < 30; ++f)
        EXPECT_TRUE(std::ranges::equal(polygons[f], mesh.face(f), [](auto a, Index b) { return Index(a) == b; }));
}

TEST(PlyWriter, TextureCoordinatesAreTheDiskMovedIntoTheUnitSquareUnderBothNames)
{
    const TemporaryFolder folder;
    const PlanarPoints points = points_of_the_disk();
    const std::string text =
        written(folder, [&](AtomicFile& file) { write_ply_with_uvs(file, random_polygons(400, 2), points); });
    EXPECT_NE(
        text.find("property double z\nproperty double s\nproperty double t\nproperty double texture_u\n"
                  "property double texture_v\nelement face 2\nproperty list uchar int vertex_indices\nend_header\n"),
        std::string::npos)
        << text.substr(0, 400);
    const auto values = rows(text);
    for (std::size_t v = 0; v < 400; ++v) {
        const double u = std::min(1.0, (1.0 + points(v, 0)) / 2.0), w = std::max(0.0, (1.0 + points(v, 1)) / 2.0);
        EXPECT_EQ(std::vector(values[v].begin() + 3, values[v].end()), (std::vector{u, w, u, w}));
    }
}

TEST(PlyWriter, KeepsWhatTheFileHeldButForTextureCoordinates)
{
    const TemporaryFolder folder;
    const auto rewritten = [&](const std::string& bytes, bool moved = false) {
        const PolygonMesh mesh = parse_mesh(bytes, ".ply");
        const std::string text = written(folder, [&](AtomicFile& file) {
            const PlanarPoints points = PlanarPoints::Zero(mesh.vertices.rows(), 2);
            EXPECT_TRUE(write_ply_with_uvs(file, mesh, points, {bytes, moved}).texture_coordinates);
        });
        return text.substr(text.find('\n', text.find("comment Koebe UV")) + 1);
    };
    const std::string properties =
        "property list uchar int weights\nproperty float x\nproperty float s\nproperty float t\n"
        "property float y\nproperty float z\nproperty float nx\nproperty uchar red\n";
    const std::string faces =
        "property short part\nproperty list uchar int vertex_index\nproperty list uchar float texcoord\n";
    const auto header = [&](const std::string& format) {
        return "ply\nformat " + format + " 1.0\ncomment TextureFile a.png\ncomment Koebe UV 0.0.1\nelement vertex 3\n" +
               properties + "element edge 1\nproperty int vertex1\nproperty double length\nelement face 1\n" + faces +
               "end_header\n";
    };
    const std::string expected =
        "comment TextureFile a.png\nelement vertex 3\nproperty list uchar int weights\nproperty double x\n"
        "property double y\nproperty double z\nproperty float nx\nproperty uchar red\nproperty double s\n"
        "property double t\nproperty double texture_u\nproperty double texture_v\nelement edge 1\n"
        "property int vertex1\nproperty double length\nelement face 1\nproperty short part\n"
        "property list uchar int vertex_indices\nend_header\n"
        "2 7 -8 0 0 0 0.5 255 0.5 0.5 0.5 0.5\n0 1 0 0 0.25 0 0.5 0.5 0.5 0.5\n0 0 1 0 0.125 1 0.5 0.5 0.5 0.5\n"
        "-1 0.1\n-5 3 0 1 2\n";
    EXPECT_EQ(rewritten(header("ascii") + "2 7 -8 0 9 9 0 0 0.5 255\n0 1 9 9 0\n0 0.25 0\n0 0 9 9 1 0 0.125 1\n-1 0.1\n"
                                          "-5 3 0 1 2 2 0.5 0.5\n"),
              expected);
    for (const bool swapped : {false, true}) {
        std::string bytes = header(swapped ? "binary_big_endian" : "binary_little_endian");
        const auto add = [&](auto number) {
            std::string raw(reinterpret_cast<const char*>(&number), sizeof number);
            if (swapped) std::ranges::reverse(raw);
            bytes += raw;
        };
        const auto add_vertex = [&](float x, float y, float nx, int red) {
            for (const float number : {x, 9.0f, 9.0f, y, 0.0f, nx}) add(number);
            add(static_cast<unsigned char>(red));
        };
        bytes += '\2';
        add(7), add(-8), add_vertex(0.0f, 0.0f, 0.5f, 255);
        bytes += '\0';
        add_vertex(1.0f, 0.0f, 0.25f, 0);
        bytes += '\0';
        add_vertex(0.0f, 1.0f, 0.125f, 1);
        add(-1), add(0.1), add(static_cast<short>(-5));
        bytes += '\3';
        add(0), add(1), add(2);
        bytes += '\2';
        add(0.5f), add(0.5f);
        EXPECT_EQ(rewritten(bytes), expected) << swapped;
        EXPECT_EQ(rewritten(bytes, true).find("nx"), std::string::npos);
    }
}

TEST(PlyWriter, PatchesAreAPropertyOfTheFaces)
{
    const TemporaryFolder folder;
    PolygonMesh mesh = random_polygons(4, 0);
    mesh.corners = {0, 1, 2, 3, 1, 2, 0};
    mesh.face_begin = {0, 4, 7};
    const std::string text = written(folder, [&](AtomicFile& file) { write_ply_with_patches(file, mesh, {-1, 2}); });
    EXPECT_NE(text.find("vertex_indices\nproperty int patch\nend_header\n"), std::string::npos) << text;
    EXPECT_TRUE(text.ends_with("\n4 0 1 2 3 -1\n3 1 2 0 2\n")) << text;
}

TEST(PlyWriter, PolygonsOfManyCornersHaveAWiderCount)
{
    const TemporaryFolder folder;
    for (const Index corners : {255, 256, 65535}) {
        PolygonMesh mesh = random_polygons(corners, 0);
        for (Index v = 0; v < corners; ++v) mesh.corners.push_back(v);
        mesh.face_begin = {0, corners};
        const std::string text =
            written(folder, [&](AtomicFile& file) { write_ply_with_uvs(file, mesh, PlanarPoints::Zero(corners, 2)); });
        EXPECT_NE(text.find(corners < 256 ? "list uchar int" : "list ushort int"), std::string::npos);
        EXPECT_EQ(read_mesh(folder.path() / "out.ply").corners, mesh.corners) << corners;
    }
}

TEST(MeshWriter, NeedsAPointForEachVertex)
{
    const TemporaryFolder folder;
    AtomicFile file(folder.path() / "out");
    for (const char* extension : {".obj", ".ply"})
        EXPECT_THROW(write_with_uvs(file, *io::mesh_format(extension), random_polygons(4, 1), PlanarPoints::Zero(3, 2),
                                    {MeshFile{}}),
                     InputError);
}

TEST(MeshWriter, TheExtensionNamesTheFormat)
{
    const TemporaryFolder folder;
    EXPECT_EQ(written_format(folder.path() / "a.obj"), io::mesh_format(".obj"));
    EXPECT_EQ(written_format("A.Ply"), io::mesh_format(".ply"));
    EXPECT_EQ(written_format("/dev/null"), io::mesh_format(".obj"));
    for (const char* other : {"a.off", "a.stl", "a.glb", "a.gltf", "a", ".obj", "a.obj.", "a.obj ", "a.plyx", ""})
        EXPECT_FALSE(written_format(folder.path() / other)) << other;
}

}  // namespace
}  // namespace koebe
