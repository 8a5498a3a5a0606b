// Laws of the writer: what is written reads back to the last bit, and a file is whole or absent.
#include "io/obj_writer.h"

#include "core/errors.h"
#include "execution/thread_share.h"
#include "files/text_writer.h"
#include "io/mesh_reader.h"
#include "io/mesh_writer.h"
#include "random_polygons.h"
#include "temporary_folder.h"

#include <gtest/gtest.h>

#include <charconv>
#include <cmath>
#include <random>
#include <sstream>
#include <string_view>
#include <vector>

namespace koebe {
namespace {

using test::bytes_of;
using test::points_of_the_disk;
using test::random_polygons;
using test::TemporaryFolder;

std::string written_with_uvs(const TemporaryFolder& folder, const PolygonMesh& mesh, const PlanarPoints& points)
{
    AtomicFile file(folder.path() / "out.obj");
    write_obj_with_uvs(file, mesh, points);
    file.commit();
    return bytes_of(folder.path() / "out.obj");
}

/// All numbers of few decimals are written on a way of their own.
TEST(ObjWriter, NumbersAreTheShortestThatReadBack)
{
    std::mt19937_64 random(5);
    std::vector<double> numbers{0.0, -0.0, 0.1, 1.0, 0.5, 100000.0, 1e6, 1e9, 999999999.999999, 0.3, 0.1 + 0.2, 1e-6};
    for (int i = 0; i < 200000; ++i) {
        const double scale = std::pow(10.0, static_cast<double>(random() % 16) - 4.0);
        const double any = scale * (static_cast<double>(random() % 2000001) / 1e6 - 1.0);
        for (const double steps : {1.0, 1e1, 1e3, 1e5, 1e6, 1e7, 1e8})
            numbers.push_back(std::round(any * steps) / steps);
        numbers.insert(numbers.end(), {any, std::nextafter(any, 1e300), std::nextafter(numbers.back(), -1e300)});
    }
    char own[24], expected[24];
    for (const double number : numbers) {
        const std::string_view word(own, static_cast<std::size_t>(io::write_number(own, number) - own));
        const auto end = std::to_chars(expected, expected + sizeof expected, number).ptr;
        ASSERT_EQ(word, std::string_view(expected, static_cast<std::size_t>(end - expected)));
    }
}

TEST(ObjWriter, TextureCoordinatesAreTheDiskMovedIntoTheUnitSquare)
{
    const TemporaryFolder folder;
    const PlanarPoints points = points_of_the_disk();
    std::istringstream lines(written_with_uvs(folder, random_polygons(400, 2), points));
    Index v = 0;
    for (std::string line; std::getline(lines, line);) {
        if (!line.starts_with("vt ")) continue;
        const std::size_t space = line.find(' ', 3);
        const double u = std::strtod(line.c_str() + 3, nullptr), w = std::strtod(line.c_str() + space, nullptr);
        EXPECT_EQ(u, std::min(1.0, (1.0 + points(v, 0)) / 2.0));
        EXPECT_EQ(w, std::max(0.0, (1.0 + points(v, 1)) / 2.0));
        ++v;
    }
    EXPECT_EQ(v, 400);
}

TEST(ObjWriter, FacesNameTheTextureCoordinateOfTheirVertex)
{
    const TemporaryFolder folder;
    PolygonMesh mesh = random_polygons(4, 0);
    mesh.corners = {3, 0, 1, 0, 1, 2, 3};
    mesh.face_begin = {0, 3, 7};
    const std::string text = written_with_uvs(folder, mesh, PlanarPoints::Zero(4, 2));
    EXPECT_NE(text.find("\nf 4/4 1/1 2/2\nf 1/1 2/2 3/3 4/4\n"), std::string::npos) << text;
}

/// A mesh that was read from a text, written with one place for each vertex.
std::string rewritten(const std::string& text, bool moved = false)
{
    const TemporaryFolder folder;
    PolygonMesh mesh = parse_mesh(text, ".obj");
    if (moved) mesh.vertices.array() += 1.0;
    AtomicFile file(folder.path() / "out.obj");
    write_obj_with_uvs(file, mesh, PlanarPoints::Zero(mesh.vertices.rows(), 2), {text, moved});
    file.commit();
    const std::string out = bytes_of(folder.path() / "out.obj");
    EXPECT_TRUE(out.starts_with("# Koebe UV "));
    return out.substr(out.find('\n') + 1);
}

TEST(ObjWriter, KeepsTheFilesTextButForTextureCoordinates)
{
    const std::string text =
        "# Koebe UV 0.0.1\n# made \\\nmtllib a.mtl\no one\nv 0.50 0 0 1 0 0 # red\nvt 1 \\\n 1\nv 1 0 0\n v 0 1e0 0\n"
        "vn 0 0 1\nusemtl skin\n\ns 1\nf 1/1/1 2/1/-1 \\\n 3/1/1 # first\nvt 0 0\nv 1 1 0\nvn 0 1 0\no two\nf -1/1 2 "
        "3\n"
        "f 4//2 -2//-1 2//2\nf 1//1x 2//1 3//1\nl 1/1 2/1/1 \\\n 3\nwhatever 1/2/3\nf 1 2 4";
    EXPECT_EQ(rewritten(text), "# made \\\nmtllib a.mtl\no one\nv 0.50 0 0 1 0 0 # red\nv 1 0 0\n v 0 1e0 0\n"
                               "vn 0 0 1\nusemtl skin\n\ns 1\nvt 0.5 0.5\nvt 0.5 0.5\nvt 0.5 0.5\nvt 0.5 0.5\n"
                               "f 1/1/1 2/2/1 3/3/1 # first\nv 1 1 0\nvn 0 1 0\no two\nf 4/4 2/2 3/3\n"
                               "f 4/4/2 3/3/2 2/2/2\nf 1/1 2/2 3/3\nl 1 2//1 3\nwhatever 1/2/3\nf 1/1 2/2 4/4\n");
    EXPECT_EQ(
        rewritten("v 0 0 0 1 0 0\r\nv 1 0 0\r\nv 0 1 \\\r\n 0 0 0 1\r\nvn 0 0 1\r\nf 1//1 2//1 3//1\r\n", true),
        "v 1 1 1 1 0 0\r\nv 2 1 1\r\nv 1 2 1 0 0 1\r\nvt 0.5 0.5\r\nvt 0.5 0.5\r\nvt 0.5 0.5\r\nf 1/1 2/2 3/3\r\n");
}

/// Long texts are written in pieces on several threads: each must begin at a statement, and know what stands before it.
TEST(ObjWriter, TextsOfManyPiecesKeepTheirStatements)
{
    constexpr Index count = 60000;
    std::string text, expected;
    for (Index i = 1; i <= count; ++i) {
        text += "v " + std::to_string(i) + " \\\n0 0\nvn 0 0 1\nvt 0 0 \\\n0\n";
        expected += "v " + std::to_string(i) + " \\\n0 0\nvn 0 0 1\n";
    }
    for (Index i = 0; i < count; ++i) expected += "vt 0.5 0.5\n";
    for (Index i = 3; i <= count; ++i) {
        const std::string a = std::to_string(i), c = std::to_string(i - 2);
        text += "f " + a + "/1/-1 -2/1/" + a + " \\\n" + c + "//" + c + "\nusemtl " + a + "\nvn 1 0 0\n";
        expected += "f " + a + '/' + a + '/' + std::to_string(count + i - 3) + ' ';
        expected += std::to_string(count - 1) + '/' + std::to_string(count - 1) + '/' + a + ' ';
        expected += c + '/' + c + '/' + c + "\nusemtl " + a + "\nvn 1 0 0\n";
    }
    for (const int threads : {1, 3}) {
        const ThreadShare share(threads);
        EXPECT_TRUE(rewritten(text) == expected) << threads;
    }
}

TEST(ObjWriter, GroupsAreNamedWhereTheyChange)
{
    const TemporaryFolder folder;
    PolygonMesh mesh = random_polygons(3, 0);
    mesh.corners = {0, 1, 2, 1, 2, 0, 2, 0, 1};
    mesh.face_begin = {0, 3, 6, 9};
    AtomicFile named(folder.path() / "named.obj"), numbered(folder.path() / "numbered.obj");
    write_obj_with_groups(named, mesh, {0, 0, 2}, {"surface", "patch_0", "patch_1"});
    named.commit();
    const std::string text = bytes_of(folder.path() / "named.obj");
    EXPECT_TRUE(text.ends_with("\ng surface\nf 1 2 3\nf 2 3 1\ng patch_1\nf 3 1 2\n")) << text;
    EXPECT_EQ(text.find("patch_0"), std::string::npos);
    write_with_patches(numbered, *io::mesh_format(".obj"), mesh, {-1, 1, 1}, {MeshFile{}});
    numbered.commit();
    const std::string by_number = bytes_of(folder.path() / "numbered.obj");
    EXPECT_TRUE(by_number.ends_with("\ng surface\nf 1 2 3\ng patch_1\nf 2 3 1\nf 3 1 2\n")) << by_number;
}

}  // namespace
}  // namespace koebe
