// Laws of the readers: every format says the same, to the last bit; a file is read whole or refused.
#include "files/file_error.h"
#include "io/mesh_reader.h"
#include "temporary_folder.h"

#include <OpenMesh/Core/IO/MeshIO.hh>
#include <OpenMesh/Core/Mesh/PolyMesh_ArrayKernelT.hh>

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <random>

namespace koebe {
namespace {

using test::bytes_of;
using test::TemporaryFolder;

std::vector<Index> corners_of(const PolygonMesh& mesh, Index f)
{
    const auto face = mesh.face(f);
    return {face.begin(), face.end()};
}

void expect_same_faces(const PolygonMesh& a, const PolygonMesh& b)
{
    EXPECT_EQ(a.face_begin, b.face_begin);
    EXPECT_EQ(a.corners, b.corners);
}

PolygonMesh parse(const std::string& name, std::string_view text)
{
    return parse_mesh(text, std::filesystem::path(name).extension().string());
}

/// A wavy square of triangles and one quadrilateral with a hole in it, and positions that 32 bits hold.
PolygonMesh sample_mesh()
{
    constexpr Index n = 7;
    PolygonMesh mesh;
    mesh.vertices.resize(n * n, 3);
    for (Index i = 0; i < n * n; ++i) {
        const Index row = i / n;
        mesh.vertices.row(i) << static_cast<float>(0.1 * (i % n)), static_cast<float>(0.1 * row),
            static_cast<float>(std::sin(0.7f * i));
    }
    for (Index y = 0; y + 1 < n; ++y)
        for (Index x = 0; x + 1 < n; ++x) {
            const Index a = y * n + x, b = a + 1, c = a + n + 1, d = a + n;
            if (x == 3 && y == 3) continue;
            std::vector<Index> corners{a, b, c, a, c, d};
            if (x == 1 && y == 1) corners = {a, b, c, d};
            for (std::size_t i = 0; i < corners.size(); ++i) {
                mesh.corners.push_back(corners[i]);
                if (i + 1 == corners.size() || (corners.size() == 6 && i == 2))
                    mesh.face_begin.push_back(static_cast<Index>(mesh.corners.size()));
            }
        }
    return mesh;
}

using OpenMeshMesh = OpenMesh::PolyMesh_ArrayKernelT<>;

OpenMeshMesh to_openmesh(const PolygonMesh& mesh)
{
    omlog().disable();
    OpenMeshMesh result;
    for (Eigen::Index v = 0; v < mesh.vertices.rows(); ++v)
        result.add_vertex(OpenMesh::Vec3f(mesh.vertices(v, 0), mesh.vertices(v, 1), mesh.vertices(v, 2)));
    for (Index f = 0; f < mesh.face_count(); ++f) {
        std::vector<OpenMesh::VertexHandle> corners;
        for (const Index v : mesh.face(f)) corners.emplace_back(v);
        result.add_face(corners);
    }
    return result;
}

struct Format {
    const char* name;
    const char* file;
    OpenMesh::IO::Options options;
};

/// Every form that is read of every format but STL, as OpenMesh writes it.
std::vector<Format> formats()
{
    using OpenMesh::IO::Options;
    return {{"OBJ", "mesh.obj", Options::Default},
            {"OFF text", "mesh.off", Options::Default},
            {"PLY text", "mesh.ply", Options::Default},
            {"PLY binary, little-endian", "mesh.ply", Options::Binary},
            {"PLY binary, big-endian", "mesh.ply", Options(Options::Binary) += Options::MSB}};
}

std::string openmesh_bytes(const TemporaryFolder& folder, const PolygonMesh& mesh, const Format& format)
{
    const std::string path = (folder.path() / format.file).string();
    EXPECT_TRUE(OpenMesh::IO::write_mesh(to_openmesh(mesh), path, format.options, 9)) << format.name;
    return bytes_of(path);
}

TEST(MeshReader, ReadsWhatOpenMeshWritesInEveryFormat)
{
    const TemporaryFolder folder;
    const PolygonMesh expected = sample_mesh();
    for (const Format& format : formats()) {
        SCOPED_TRACE(format.name);
        openmesh_bytes(folder, expected, format);
        const PolygonMesh mesh = read_mesh(folder.path() / format.file);
        EXPECT_TRUE(mesh.vertices.cast<float>() == expected.vertices.cast<float>());  // texts of 9 digits
        expect_same_faces(mesh, expected);
    }
}

TEST(MeshReader, StlFacetsShareVerticesNumberedByFirstAppearance)
{
    const TemporaryFolder folder;
    PolygonMesh triangles;
    const PolygonMesh sample = sample_mesh();
    triangles.vertices = sample.vertices;
    for (Index f = 0; f < sample.face_count(); ++f) {
        if (sample.face(f).size() != 3) continue;
        triangles.corners.insert(triangles.corners.end(), sample.face(f).begin(), sample.face(f).end());
        triangles.face_begin.push_back(static_cast<Index>(triangles.corners.size()));
    }
    for (const bool binary : {false, true}) {
        SCOPED_TRACE(binary);
        const std::string path = (folder.path() / "mesh.STL").string();
        OpenMesh::IO::Options options = binary ? OpenMesh::IO::Options::Binary : OpenMesh::IO::Options::Default;
        options += OpenMesh::IO::Options::FaceNormal;
        OpenMeshMesh written = to_openmesh(triangles);
        written.request_face_normals();
        written.update_face_normals();
        ASSERT_TRUE(OpenMesh::IO::write_mesh(written, path, options, 9));
        const PolygonMesh mesh = read_mesh(path);
        EXPECT_EQ(mesh.vertices.rows(), triangles.vertices.rows());
        ASSERT_EQ(mesh.face_begin, triangles.face_begin);
        Index seen = 0;
        for (std::size_t c = 0; c < mesh.corners.size(); ++c) {
            EXPECT_TRUE(mesh.vertices.row(mesh.corners[c]).cast<float>() ==
                        triangles.vertices.row(triangles.corners[c]).cast<float>());
            EXPECT_LE(mesh.corners[c], seen);
            seen = std::max(seen, mesh.corners[c] + 1);
        }
    }
}

TEST(MeshReader, TextNumbersAreReadToTheLastBit)
{
    std::mt19937_64 random(1);
    std::vector<std::string> words{"0",     "-0.0", "1e-310", "4.9e-324", "1.7976931348623157e308",
                                   "+2.5",  ".5",   "5.",     "1E3",      "0.1000000000000000055511151231257827",
                                   "1e-400"};
    for (int i = 0; i < 3000; ++i) {
        char word[64];
        const double mantissa = std::uniform_real_distribution<double>(-10.0, 10.0)(random);
        std::snprintf(word, sizeof word, "%.*ge%d", static_cast<int>(random() % 20) + 1, mantissa,
                      static_cast<int>(random() % 600) - 300);
        // "1.5e+00e7" is no number: keep those printed without an exponent
        if (std::string(word).find('e') == std::string(word).rfind('e')) words.emplace_back(word);
    }
    while (words.size() % 3 != 0) words.emplace_back("1");
    std::string lines;
    for (std::size_t i = 0; i < words.size(); i += 3)
        lines += words[i] + ' ' + words[i + 1] + ' ' + words[i + 2] + '\n';
    const std::string count = std::to_string(words.size() / 3);
    std::string obj;
    for (std::size_t begin = 0, end; begin < lines.size(); begin = end + 1) {
        end = lines.find('\n', begin);
        obj += "v " + lines.substr(begin, end + 1 - begin);
    }
    const std::vector<PolygonMesh> meshes{
        parse("a.obj", obj + "f 1 2 3\n"), parse("a.off", "OFF\n" + count + " 1 0\n" + lines + "3 0 1 2\n"),
        parse("a.ply", "ply\nformat ascii 1.0\nelement vertex " + count +
                           "\nproperty double x\nproperty double y\nproperty double z\nelement face 1\n"
                           "property list uchar int vertex_indices\nend_header\n" +
                           lines + "3 0 1 2\n")};
    for (const PolygonMesh& mesh : meshes) {
        ASSERT_EQ(mesh.vertices.size(), static_cast<Eigen::Index>(words.size()));
        for (std::size_t i = 0; i < words.size(); ++i) {
            const double expected = std::strtod(words[i].c_str(), nullptr);
            ASSERT_EQ(mesh.vertices.data()[i], expected) << words[i];
            ASSERT_EQ(std::signbit(mesh.vertices.data()[i]), std::signbit(expected)) << words[i];
        }
    }
}

TEST(MeshReader, LineEndsBlanksAndCommentsChangeNothing)
{
    const std::string obj = "# a comment\nv 0 0 0\nv 1 0 0\nv 0 1 0\nv 1 1 0\nf 1 2 3\nf 2 4 3\n";
    const std::string off = "OFF\n4 2 5\n0 0 0\n1 0 0\n0 1 0\n1 1 0\n3 0 1 2\n3 1 3 2\n";
    const auto replaced = [](const std::string& text, const std::string& line_end) {
        std::string result;
        for (const char c : text) result += c == '\n' ? line_end : std::string(1, c);
        return result;
    };
    const PolygonMesh expected = parse("a.obj", obj);
    ASSERT_EQ(corners_of(expected, 1), (std::vector<Index>{1, 3, 2}));
    for (const char* line_end : {"\n", "\r\n", " \t\r\n", " # note\n", "\n\n"})
        for (const char* name : {"b.obj", "b.off"}) {
            SCOPED_TRACE(std::string(name) + " with " + line_end);
            const PolygonMesh mesh = parse(name, replaced(name == std::string("b.obj") ? obj : off, line_end));
            EXPECT_TRUE(mesh.vertices == expected.vertices);
            expect_same_faces(mesh, expected);
        }
    expect_same_faces(parse("bom.obj", "\xEF\xBB\xBF" + obj.substr(12)), expected);
    expect_same_faces(parse("no_final_newline.obj", obj.substr(0, obj.size() - 1)), expected);
    expect_same_faces(parse("one_line.off", "OFF " + off.substr(4)), expected);
    expect_same_faces(parse("notes.off", "# a note\nOFF # one\n4 # more\n#\n2 5# last\n" + off.substr(10)), expected);
}

TEST(MeshReader, ObjFacesInAllTheirForms)
{
    const PolygonMesh mesh =
        parse("forms.obj", "mtllib C:\\missing\\\n# C:\\none\\\n"
                           "v 0 0 0 1.0\nv 1 0 0 0.5 nan -inf\nvt 0 0\nvn 0 0 1\n"
                           "v 0 1 0\ng a b\nusemtl\ns off\n"
                           "f 1/1 2/1 3/1\nf 1//1 2//1 3//1\nf 1/1/1 2/1/1 3/1/1\n"
                           "f -3 -2 -1\nv 5 5 5\nf -4/-1/-1 -3/-1/-1 \\\n -2/-1/-1\nl 1 2\np 1\nf 5 4 3\n"
                           "f\t1/1\t2/1\t3/1\nf  1 2  3 # 4\n  f 1 2 \\\r\n3\n"
                           "\tv\t6 6 6 # used above, unused vertex below\nv 7 7 7\n");
    ASSERT_EQ(mesh.vertices.rows(), 6);
    ASSERT_EQ(mesh.face_count(), 9);
    for (Index f : {0, 1, 2, 3, 4, 6, 7, 8}) EXPECT_EQ(corners_of(mesh, f), (std::vector<Index>{0, 1, 2})) << f;
    EXPECT_EQ(corners_of(mesh, 5), (std::vector<Index>{4, 3, 2}));
    EXPECT_EQ(mesh.vertices(5, 0), 7.0);
}

TEST(MeshReader, ObjWordsThatAreNoPlainNumbersMeanTheSame)
{
    const PolygonMesh plain = parse("plain.obj", "v 1 2.5 -3\nv 4 5 6\nv 7 8 90\nf 1 2 3\nf 3 2 1\n");
    const PolygonMesh same = parse("same.obj", "v +1 2.5\\\n -3#\nv 4\\\n5 \\\n 6\nv 7\t8 9E+1#9\r\n"
                                               "f 1/7 2/7/\\\n 3//5#\nf +3 -2\\\n\\\n -3/\\\n\n");
    expect_same_faces(same, plain);
    EXPECT_TRUE(same.vertices == plain.vertices);
    for (const char* bad : {"v 1 2 3x\n", "v 1 2 inf\n", "v 1 2 1e999\n", "v 1 2\n", "f 1 2 3.5\n", "f 1 2 3\\4\n"})
        EXPECT_THROW(parse("bad.obj", "v 0 0 0\n" + std::string(bad)), InputError) << bad;
}

TEST(MeshReader, OffPassesOverColorsNormalsAndTexturesHoweverManyNumbersTheyHave)
{
    for (const char* keyword : {"OFF", "COFF", "NOFF", "STOFF", "STCNOFF"})
        for (const char* extra : {"", " 0 0 1", " 0 0 1 9 9 9 1", " 255 128"}) {
            SCOPED_TRACE(std::string(keyword) + extra);
            std::string text = std::string(keyword) + " # all\n3 1 0\n";
            for (const char* line : {"0 0 0", "1 0 0", "0 1 0.5", "3 2 1 0"})
                text.append(line).append(extra).append("\n");
            const PolygonMesh mesh = parse("a.off", text);
            EXPECT_TRUE(mesh.vertices.row(2) == Eigen::RowVector3d(0.0, 1.0, 0.5));
            EXPECT_EQ(corners_of(mesh, 0), (std::vector<Index>{2, 1, 0}));
        }
    const PolygonMesh homogeneous = parse("a.off", "4OFF\n3 1 0\n0 0 0 1\n1 0 0 1\n1 2 3 4\n3 0 1 2\n");
    EXPECT_TRUE(homogeneous.vertices.row(2) == Eigen::RowVector3d(0.25, 0.5, 0.75));
}

TEST(MeshReader, PlyElementsAndPropertiesInAnyOrderAndType)
{
    const PolygonMesh mesh =
        parse("a.ply", "ply\r\nformat ascii 1.0\r\ncomment # and more\r\nobj_info none\r\n"
                       "element material 1\r\nproperty list uchar float shades\r\n"
                       "element face 2\r\nproperty uchar red\r\nproperty list int16 uint vertex_index\r\n"
                       "element vertex 4\r\nproperty float64 z\r\nproperty int x\r\nproperty uchar y\r\n"
                       "property list uchar int weights\r\nend_header\r\n"
                       "2 0.5 0.5\r\n255 3 0 1 2\r\n0 4 0 2 1\r\n3\r\n"
                       "0.5 -1 2 0\r\n0 1 2 1 7\r\n0 1 1 2 7 7\r\n9 9 9 0\r\n");
    ASSERT_EQ(mesh.vertices.rows(), 4);
    EXPECT_TRUE(mesh.vertices.row(0) == Eigen::RowVector3d(-1.0, 2.0, 0.5));
    EXPECT_TRUE(mesh.vertices.row(3) == Eigen::RowVector3d(9.0, 9.0, 9.0));
    EXPECT_EQ(corners_of(mesh, 1), (std::vector<Index>{0, 2, 1, 3}));
}

TEST(MeshReader, PlyTextsHave64BitsWhateverTheirTypesSay)
{
    std::string corners;
    for (int i = 0; i < 300; ++i) corners += ' ' + std::to_string(i % 3);
    const std::string text =
        "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty int z\n"
        "element face 2\nproperty list int ushort vertex_indices\nproperty list uchar float texcoord\nend_header\n"
        "0.1 0.123456789012345 2\n1 0 0.25\n0 1 0\n3 0 1 2 1 0.5\n300" +
        corners + " 0\n";
    const PolygonMesh mesh = parse("a.ply", text);
    EXPECT_TRUE(mesh.vertices.row(0) == Eigen::RowVector3d(0.1, 0.123456789012345, 2.0));
    EXPECT_EQ(mesh.vertices(1, 2), 0.25);
    EXPECT_EQ(corners_of(mesh, 0), (std::vector<Index>{0, 1, 2}));
    EXPECT_EQ(mesh.face(1).size(), 300u);
}

/// A value's bytes, the lowest first.
template <typename T>
std::string raw(T value)
{
    return {reinterpret_cast<const char*>(&value), sizeof value};
}

std::string binary_ply(const std::string& vertex_properties, const std::string& face_properties)
{
    return "ply\nformat binary_little_endian 1.0\ncomment made by hand\nelement vertex 3\n" + vertex_properties +
           "element face 1\n" + face_properties + "end_header\n";
}

const std::string float_xyz = "property float32 x\nproperty float y\nproperty float z\n";

TEST(MeshReader, PlyBinariesOfAllIntegerTypes)
{
    const std::string bytes =
        binary_ply("property double z\nproperty float32 y\nproperty uint8 red\nproperty float green\n"
                   "property float x\n",
                   "property int16 other\nproperty list ushort uint32 vertex_index\n") +
        raw(0.1) + raw(2.0f) + raw<char>(7) + raw(7.0f) + raw(1.0f) +  //
        raw(0.2) + raw(3.0f) + raw<char>(7) + raw(7.0f) + raw(1.0f) +  //
        raw(0.3) + raw(4.0f) + raw<char>(7) + raw(7.0f) + raw(5.0f) +  //
        raw<std::int16_t>(-1) + raw<std::uint16_t>(3) + raw<std::uint32_t>(2) + raw<std::uint32_t>(0) +
        raw<std::uint32_t>(1);
    const PolygonMesh mesh = parse("a.ply", bytes);
    EXPECT_TRUE(mesh.vertices.row(0) == Eigen::RowVector3d(1.0, 2.0, 0.1));
    EXPECT_TRUE(mesh.vertices.row(2) == Eigen::RowVector3d(5.0, 4.0, 0.3));
    EXPECT_EQ(corners_of(mesh, 0), (std::vector<Index>{2, 0, 1}));
}

TEST(MeshReader, StlTextOfSeveralSolidsWithNegativeZeros)
{
    const PolygonMesh mesh = parse("a.stl", "solid first\nfacet normal 0 0 1\nouter loop\n"
                                            "vertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\nendloop\nendfacet\nendsolid\n"
                                            "solid second\nfacet normal 0 0 1 outer loop vertex -0.0 0 -0 vertex 0 1 0 "
                                            "vertex -1 0 0.1 endloop endfacet\nendsolid second\n");
    EXPECT_EQ(mesh.corners, (std::vector<Index>{0, 1, 2, 0, 2, 3}));
    ASSERT_EQ(mesh.vertices.rows(), 4);
    EXPECT_EQ(mesh.vertices(3, 2), 0.1);
}

/// One facet for each three points.
std::string binary_stl(std::string header, const std::vector<std::array<float, 3>>& points)
{
    header.resize(80, ' ');
    std::string bytes = header + raw(static_cast<std::uint32_t>(points.size() / 3));
    for (std::size_t p = 0; p < points.size(); ++p) {
        if (p % 3 == 0) bytes += raw(std::array<float, 3>{0, 0, 1});
        bytes += raw(points[p]);
        if (p % 3 == 2) bytes += raw<std::uint16_t>(0);
    }
    return bytes;
}

TEST(MeshReader, BinaryStlMayStartWithSolidAndGoOnAfterItsFacets)
{
    const std::string bytes = binary_stl("solid made by a program that says so", {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}});
    EXPECT_EQ(parse("b.stl", bytes).corners, (std::vector<Index>{0, 1, 2}));
    const std::string longer = binary_stl("made by another", {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}) + "more";
    EXPECT_EQ(parse("b.stl", longer).corners, (std::vector<Index>{0, 1, 2}));
}

struct Refused {
    const char* file;
    std::string text;
    const char* message;  // part of it
    std::vector<Index> elements;
};

TEST(MeshReader, RefusesWhatIsNoMeshAndSaysWhere)
{
    const std::string ply = "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\n";
    const std::string list = "element face 1\nproperty list uchar int vertex_indices\nend_header\n";
    const std::string huge = "ply\nformat binary_little_endian 1.0\nelement vertex 1000000000000\n";
    const float nan = std::nanf("");
    const std::vector<Refused> cases{
        {"a.obj", "", "no vertex", {}},
        {"a.obj", "v 0 0 0\n", "no face", {}},
        {"a.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\nf 1 2 4\nf 1 2 0\nf 1 2 -4\n", "name a vertex", {1, 2, 3}},
        {"a.obj", "v 0 0 0\nv 1 0 0\nvn 0 0 1\nv 0 nan 0\nv 0 0 0\nf 1 2 3\n", "vertex 2 is not three finite", {2}},
        {"a.obj", "v 0 0 0\nv 0 1 -inf\nf 1 1 1\n", "vertex 1 is not three finite", {1}},
        {"a.obj", "v 0 0 0\nv 1e999 0 0\nf 1 1 1\n", "vertex 1 is not three finite", {1}},
        {"a.obj", "v 0 0 0\nv 1 0\nf 1 2 2\n", "vertex 1 is not three finite", {1}},
        {"a.obj", "v 0 0 0\r\n\r\nv 1 0 zero\r\n", "vertex 1 is not three finite", {1}},
        {"a.obj", "v 1,5 0 0\n", "vertex 0 is not three finite", {0}},
        {"a.obj", "v\n", "vertex 0 is not three finite", {0}},
        {"a.obj", "v 0 0 0\nv 1 0 0 v 1 1 0\nf 1 2 2\n", "vertex 1 has words after its numbers", {1}},
        {"a.obj", "v 0 0 0 red\nf 1 1 1\n", "vertex 0 has words after its numbers", {0}},
        {"a.obj", "v 0 0 0\nf 1 1 1\nf 1 x 1\n", "face 1 has a corner that is no integer", {1}},
        {"a.obj", "v 0 0 0\nf 1 1 1 99999999999\n", "face 0 has a corner that is no integer", {0}},
        {"a.off", "", "does not start with OFF", {}},
        {"a.off", "3 1 0\n", "does not start with OFF", {}},
        {"a.off", "OFF\n4000000000 4000000000 0\n0 0 0\n", "count of vertex elements does not fit the file", {}},
        {"a.off", "OFF\n3 1 -2147483648\n0 0 0\n", "count of edge elements does not fit the file", {}},
        {"a.off", "OFF\n2000000000 1 0\n0 0 0\n", "count of vertex elements does not fit the file", {}},
        {"a.off", "OFF\n1 2000000000 0\n0 0 0\n", "count of face elements does not fit the file", {}},
        {"a.off", "OFF\n-1 1 0\n", "does not start with OFF and three counts", {}},
        {"a.off", "OFF\n3 1\n-1.5 0 0\n1 0 0\n0 1 0\n3 0 1 2\n", "no number of edges", {}},
        {"a.off", "OFF BINARY\n\x01\x02", "not binary", {}},
        {"a.off", "nOFF\n3\n3 1 0\n", "not binary, SKEL or nOFF", {}},
        {"a.off", "OFF\n3 1 0\n0 0 0\n1 0 0\n", "vertex 2 is missing", {2}},
        {"a.off", "OFF\n3 1 0\n0 0 0\n1 inf 0\n0 1 0\n3 0 1 2\n", "vertex 1 is missing or is not three finite", {1}},
        {"a.off", "COFF\n3 1 0\nx\n", "vertex 0 is missing or is not three finite", {0}},
        {"a.off", "OFF\n3 2 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n", "face 1 is missing", {1}},
        {"a.off", "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n4000000000 0 1 2\n", "face 0 is missing, is cut short", {0}},
        {"a.off", "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 3\n", "names a vertex that is not there", {0}},
        {"a.off", "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n-1 0 1 2\n", "face 0 is missing, is cut short", {0}},
        {"a.off", "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 -1 2\n", "names a vertex that is not there", {0}},
        {"a.off", "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1.5 2\n", "face 0 is missing, is cut short", {0}},
        {"a.ply", "", "does not start with 'ply'", {}},
        {"a.ply", "ply\nformat ascii 1.0\n", "no 'end_header'", {}},
        {"a.ply", "ply\nformat utf8 1.0\nend_header\n", "format or a count is not one of PLY", {}},
        {"a.ply",
         "ply\nformat ascii 1.0\nelement vertex 1\nproperty real x\r\nend_header\n",
         "line 4 of the header is not supported",
         {}},
        {"a.ply", "ply\nformat ascii 1.0\nproperty float x\nend_header\n", "line 3 of the header", {}},
        {"a.ply", "ply\nelement ascii 1.0\nproperty float x\nend_header\n", "line 2 of the header", {}},
        {"a.ply", "plywood\nformat ascii 1.0\nend_header\n", "line 1 of the header", {}},
        {"a.ply", ply + "end_header\n0 0\n0 0\n0 0\n", "no float or double z", {}},
        {"a.ply",
         ply + "property float z\nelement face 1\nproperty int vertex_indices\nend_header\n0 0 0 0 0 0 0 0 0 0",
         "no list of int or uint vertex_indices",
         {}},
        {"a.ply", binary_ply("property int x\nproperty float y\nproperty float z\n", ""), "no float or double x", {}},
        {"a.ply",
         binary_ply(float_xyz, "property list int int vertex_indices\n") + raw(std::array<float, 9>{}) +
             raw<std::int32_t>(0x7fffffff),
         "face 0 is missing",
         {0}},
        {"a.ply", huge + float_xyz + list, "count of vertex elements does not fit", {}},
        {"a.ply",
         "ply\nformat ascii 1.0\nelement nothing 1000000000000\nend_header\n",
         "nothing elements does not fit",
         {}},
        {"a.ply", "ply\nformat ascii 1.0\nelement vertex -1\nend_header\n", "vertex elements does not fit", {}},
        {"a.ply", ply + "property float z\n" + list + "0 0 0\n1 0 0\n", "vertex 2 is missing", {2}},
        {"a.ply", ply + "property float z\n" + list + "0 0 0\n1 nan 0\n0 1 0\n3 0 1 2\n", "vertex 1 is missing", {1}},
        {"a.ply", ply + "property float z\n" + list + "0 0 0\n1 0 0\n0 1 0\n", "face 0 is missing", {0}},
        {"a.ply", ply + "property float z\n" + list + "0 0 0\n1 0 0\n0 1 0\n-3 0 1 2\n", "face 0 is missing", {0}},
        {"a.ply", ply + "property float z\n" + list + "0 0 0\n1 0 0\n0 1 0\n3 0 1 -1\n", "name a vertex", {0}},
        {"a.ply",
         ply + "property float z\nelement face 1\nproperty list int float vertex_indices\nend_header\n"
               "0 0 0\n1 0 0\n0 1 0\n3 0 1 1.5\n",
         "no list of int or uint",
         {}},
        {"a.ply",
         binary_ply(float_xyz, "property list uchar int vertex_indices\n") +
             raw(std::array<float, 9>{0, 0, 0, 1, nan, 0, 0, 1, 0}) + '\3' + raw(std::array<int, 3>{0, 1, 2}),
         "NaN or infinite",
         {1}},
        {"a.stl", "", "the file is no STL", {}},
        {"a.stl", "SOLID a\n", "or endsolid is", {0}},
        {"a.stl", "solid empty\nendsolid empty\n", "no vertex", {}},
        {"a.stl", "solid a\nfacet normal 0 0 1\nvertex 0 0\nendfacet\n", "facet 0 is missing or cut short", {0}},
        {"a.stl", "solid a\nfacet\nvertex 0 0 0\nvertex 1 0 0\nendfacet\nendsolid\n", "facet 0 is missing", {0}},
        {"a.stl", "solid a\nfacet\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\nendfacet\n", "or endsolid is", {1}},
        {"a.stl", "solid_a\nfacet\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\nendfacet\n", "or endsolid is", {1}},
        {"a.stl", "solid a\nsolid b\nendsolid\n", "or endsolid is", {0}},
        {"a.stl", "solid a\nfacet\nvertex 0 0 x\nendfacet\nendsolid\n", "facet 0 is missing", {0}},
        {"a.stl", std::string(80, ' ') + "\xff\xff\xff\x7f" + std::string(50, '\0'), "as its header says", {}},
        {"a.stl", binary_stl("", {{0, 0, 0}, {0, nan, 0}, {0, 1, 0}}), "NaN or infinite", {1}},
        {"a.gltf", "{}", "format not supported: '.gltf'; supported are OBJ, OFF, PLY, STL, GLB", {}},
        {"a.glb", "glTF", "this is no GLB file", {}},
        {"mesh", "v 0 0 0\n", "format not supported: ''", {}},
    };
    for (const Refused& refused : cases) {
        SCOPED_TRACE(refused.text.substr(0, 60));
        try {
            parse(refused.file, refused.text);
            ADD_FAILURE() << "was read";
        } catch (const InputError& error) {
            EXPECT_NE(std::string(error.what()).find(refused.message), std::string::npos) << error.what();
            EXPECT_EQ(std::string(error.what()).find('\n'), std::string::npos) << error.what();
            EXPECT_EQ(error.elements(), refused.elements);
        }
    }
}

TEST(MeshReader, FilesThatCannotBeReadAreFileErrors)
{
    const TemporaryFolder folder;
    EXPECT_THROW(read_mesh(folder.path() / "missing.obj"), FileError);
    std::filesystem::create_directory(folder.path() / "folder.obj");
    EXPECT_THROW(read_mesh(folder.path() / "folder.obj"), FileError);
}

/// Bytes of the sample in every format, STL among them.
std::vector<std::pair<std::string, std::string>> sample_files(const TemporaryFolder& folder)
{
    std::vector<std::pair<std::string, std::string>> files;
    for (const Format& format : formats())
        files.emplace_back(format.file, openmesh_bytes(folder, sample_mesh(), format));
    std::vector<std::array<float, 3>> points;
    for (float t = 0; t < 4; ++t) points.insert(points.end(), {{t, 0, 0}, {t + 1, 0, 0}, {t, 1, 0}});
    files.emplace_back("mesh.stl", binary_stl("", points));
    files.emplace_back("mesh.stl", "solid a\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\n"
                                   "endloop\nendfacet\nendsolid a\n");
    return files;
}

bool is_read(const std::string& name, std::string_view bytes)
{
    try {
        const PolygonMesh mesh = parse(name, bytes);
        for (const Index v : mesh.corners) EXPECT_TRUE(v >= 0 && v < mesh.vertices.rows());
        EXPECT_TRUE(mesh.vertices.allFinite());
        return true;
    } catch (const InputError&) {
        return false;
    }
}

TEST(MeshReader, NoProperBeginningOfACountedFileIsTakenForTheWhole)
{
    const TemporaryFolder folder;
    for (const auto& [name, bytes] : sample_files(folder)) {
        ASSERT_TRUE(is_read(name, bytes));
        // The last number of a text may lose digits unseen, and so may the blanks after it.
        const bool is_text = bytes.find('\0') == std::string::npos;
        const std::size_t last = is_text ? bytes.find_last_of(" \n", bytes.size() - 3) : bytes.size();
        for (std::size_t length = 0; length < last; length += 1 + length / 50) {
            const bool read = is_read(name, std::string_view(bytes).substr(0, length));
            EXPECT_FALSE(read && name != "mesh.obj") << name << ' ' << length << " of " << bytes.size();
        }
    }
}

TEST(MeshReader, DamagedFilesAreReadOrRefused)
{
    const TemporaryFolder folder;
    std::mt19937 random(7);
    for (const auto& [name, bytes] : sample_files(folder))
        for (int round = 0; round < 300; ++round) {
            std::string damaged = bytes;
            for (int hit = 0; hit < 1 + round % 4; ++hit) {
                // Half of the hits in the first hundred bytes, where headers are.
                const std::size_t at =
                    random() % (random() % 2 ? damaged.size() : std::min<std::size_t>(damaged.size(), 100));
                damaged[at] = static_cast<char>(random());
            }
            is_read(name, damaged);
        }
}

}  // namespace
}  // namespace koebe
