// Laws of the readers: every format says the same, to the last bit; a file is read whole or refused.
#include "io/file_error.h"
#include "io/mesh_reader.h"
#include "temporary_folder.h"

#include <OpenMesh/Core/IO/MeshIO.hh>
#include <OpenMesh/Core/Mesh/PolyMesh_ArrayKernelT.hh>

#include <gtest/gtest.h>

#include <cmath>
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
    for (Index i = 0; i < n * n; ++i)
        mesh.vertices.row(i) << static_cast<float>(0.1 * (i % n)), static_cast<float>(0.1 * (i / n)),
            static_cast<float>(std::sin(0.7f * i));
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

/// Every form of every format but STL, as OpenMesh writes it.
std::vector<Format> formats()
{
    using OpenMesh::IO::Options;
    return {{"OBJ", "mesh.obj", Options::Default},
            {"OFF text", "mesh.off", Options::Default},
            {"OFF binary", "mesh.off", Options::Binary},
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
    std::vector<std::string> words{"0",     "-0.0",   "1e-310", "4.9e-324", "1.7976931348623157e308",
                                   "+2.5",  ".5",     "5.",     "1E3",      "0.1000000000000000055511151231257827",
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
    for (std::size_t i = 0; i < words.size(); i += 3) lines += words[i] + ' ' + words[i + 1] + ' ' + words[i + 2] + '\n';
    const std::string count = std::to_string(words.size() / 3);
    std::string obj;
    for (std::size_t begin = 0, end; begin < lines.size(); begin = end + 1) {
        end = lines.find('\n', begin);
        obj += "v " + lines.substr(begin, end + 1 - begin);
    }
    const std::vector<PolygonMesh> meshes{
        parse("a.obj", obj + "f 1 2 3\n"),
        parse("a.off", "OFF\n" + count + " 1 0\n" + lines + "3 0 1 2\n"),
        parse("a.ply",
                  "ply\nformat ascii 1.0\nelement vertex " + count +
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
    for (const char* line_end : {"\n", "\r\n", "\r", " \t\n", "# note\n", "\n\n"})
        for (const char* name : {"b.obj", "b.off"}) {
            SCOPED_TRACE(std::string(name) + " with " + line_end);
            const PolygonMesh mesh = parse(name, replaced(name == std::string("b.obj") ? obj : off, line_end));
            EXPECT_TRUE(mesh.vertices == expected.vertices);
            expect_same_faces(mesh, expected);
        }
    expect_same_faces(parse("bom.obj", "\xEF\xBB\xBF" + obj), expected);
    expect_same_faces(parse("no_final_newline.obj", obj.substr(0, obj.size() - 1)), expected);
    expect_same_faces(parse("no_keyword.off", off.substr(4)), expected);
    expect_same_faces(parse("one_line.off", "OFF " + off.substr(4)), expected);
}

TEST(MeshReader, ObjFacesInAllTheirForms)
{
    const PolygonMesh mesh = parse("forms.obj",
                                       "mtllib missing.mtl\no thing\nv 0 0 0 1.0\nv 1 0 0 0.5 0.5 0.5\nvt 0 0\nvn 0 0 1\n"
                                       "v 0 1 0\ng a b\nusemtl\ns off\n"
                                       "f 1/1 2/1 3/1\nf 1//1 2//1 3//1\nf 1/1/1 2/1/1 3/1/1\n"
                                       "f -3 -2 -1\nv 5 5 5\nf -4/-1/-1 -3/-1/-1 \\\n -2/-1/-1\nl 1 2\np 1\nf 5 4 3\n"
                                       "v 6 6 6 # used above, unused vertex below\nv 7 7 7\n");
    ASSERT_EQ(mesh.vertices.rows(), 6);
    ASSERT_EQ(mesh.face_count(), 6);
    for (Index f = 0; f < 5; ++f) EXPECT_EQ(corners_of(mesh, f), (std::vector<Index>{0, 1, 2})) << f;
    EXPECT_EQ(corners_of(mesh, 5), (std::vector<Index>{4, 3, 2}));
    EXPECT_EQ(mesh.vertices(5, 0), 7.0);
}

TEST(MeshReader, OffWithColorsAndNormalsInTextAndInGeomviewsBinary)
{
    const PolygonMesh text =
        parse("a.off", "CNOFF # colours, normals\n3 1 0\n0 0 0 0 0 1 9 9 9 1\n1 0 0 0 0 1 9 9 9 1\n"
                                   "0 1 0.5 0 0 1 9 9 9 1\n3 0 1 2 0.5 0.5 0.5\n");
    std::string bytes = "CNOFF BINARY\n";
    const auto add_int = [&bytes](std::uint32_t value) {
        for (int shift = 24; shift >= 0; shift -= 8) bytes += static_cast<char>(value >> shift);
    };
    const auto add_float = [&](float value) { add_int(std::bit_cast<std::uint32_t>(value)); };
    for (const std::uint32_t count : {3u, 1u, 0u}) add_int(count);
    for (Eigen::Index v = 0; v < 3; ++v) {
        for (int axis = 0; axis < 3; ++axis) add_float(static_cast<float>(text.vertices(v, axis)));
        for (int extra = 0; extra < 3 + 4; ++extra) add_float(0.25f);
    }
    for (const std::uint32_t value : {3u, 0u, 1u, 2u, 3u}) add_int(value);  // corners, then three colour components
    for (int i = 0; i < 3; ++i) add_float(0.5f);
    const PolygonMesh binary = parse("b.off", bytes);
    EXPECT_TRUE(binary.vertices == text.vertices);
    expect_same_faces(binary, text);
    EXPECT_EQ(corners_of(text, 0), (std::vector<Index>{0, 1, 2}));
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

TEST(MeshReader, StlOfNegativeZerosAndABinaryOneThatStartsWithSolid)
{
    const PolygonMesh text = parse("a.stl", "solid facet vertex\nfacet normal 0 0 1\nouter loop\n"
                                                        "vertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\nendloop\nendfacet\n"
                                                        "facet normal 0 0 1 outer loop vertex -0.0 0 -0 vertex 0 1 0 "
                                                        "vertex -1 0 0 endloop endfacet\nendsolid vertex\n");
    EXPECT_EQ(text.vertices.rows(), 4);
    EXPECT_EQ(text.corners, (std::vector<Index>{0, 1, 2, 0, 2, 3}));

    std::string bytes = "solid made by a program that says so";
    bytes.resize(80, ' ');
    bytes.append("\x01\0\0\0", 4);
    const float numbers[12] = {0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 0};
    bytes.append(reinterpret_cast<const char*>(numbers), sizeof numbers);
    bytes.append("\0\0", 2);
    EXPECT_EQ(parse("b.stl", bytes).corners, (std::vector<Index>{0, 1, 2}));
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
    const std::vector<Refused> cases{
        {"a.obj", "", "no vertex", {}},
        {"a.obj", "v 0 0 0\n", "no face", {}},
        {"a.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\nf 1 2 4\nf 1 2 0\nf 1 2 -4\n", "name a vertex", {1, 2, 3}},
        {"a.obj", "v 0 0 0\nv 1 nan 0\nv 0 1 -inf\nv 1e999 0 0\nf 1 2 3\n", "NaN or infinite", {1, 2, 3}},
        {"a.obj", "v 0 0 0\nv 1 0\nf 1 2 2\n", "line 2: expected a number", {}},
        {"a.obj", "v 0 0 0\r\n\r\nv 1 0 zero\r\n", "line 3: expected a number, found 'zero'", {}},
        {"a.obj", "v 0 0 0\rv 1,5 0 0\r", "line 2: expected a number, found '1,5 0 0'", {}},
        {"a.obj", "v 0 0 1.2.3\n", "line 1: expected a number, found '1.2.3'", {}},
        {"a.obj", "v 0 0 0\nf 1 x 1\n", "line 2: expected an integer", {}},
        {"a.obj", "v 0 0 0\nf 1 1.5 1\n", "line 2: expected an integer", {}},
        {"a.obj", "v 0 0 0\nf 99999999999 1 1\n", "name a vertex", {0}},
        {"a.obj", "v 0 0 0\nf 99999999999999999999 1 1\n", "expected an integer", {}},
        {"a.off", "", "expected a header with OFF", {}},
        {"a.off", "4OFF\n", "line 1: expected a header with OFF", {}},
        {"a.off", "OFF\n4000000000 4000000000 0\n0 0 0\n", "does not fit the file", {}},
        {"a.off", "OFF\n-1 1 0\n", "does not fit the file", {}},
        {"a.off", "OFF\n3 1 0\n0 0 0\n1 0 0\n", "expected vertex 2", {}},
        {"a.off", "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n4000000000 0 1 2\n", "line 6: expected an integer", {}},
        {"a.off", "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 3\n", "name a vertex", {0}},
        {"a.off", "OFF BINARY\n\x01\x02", "ends in the middle", {}},
        {"a.ply", "", "does not start with 'ply'", {}},
        {"a.ply", "ply\nformat ascii 1.0\n", "no 'end_header'", {}},
        {"a.ply", "ply\nformat utf8 1.0\n", "line 2: expected ascii", {}},
        {"a.ply", "ply\nformat ascii 1.0\nelement vertex 1\nproperty real x\n", "line 4: expected a PLY type", {}},
        {"a.ply", ply + "end_header\n0 0\n0 0\n0 0\n", "no number z", {}},
        {"a.ply", ply + "property float z\nelement face 1\nproperty int vertex_indices\nend_header\n0 0 0 0 0 0 0 0 0 0",
         "no list vertex_indices", {}},
        {"a.ply", "ply\nformat ascii 1.0\nelement vertex 99999999999\nproperty float x\nend_header\n1\n",
         "does not fit the file", {}},
        {"a.ply", "ply\nformat ascii 1.0\nelement nothing 9999999999999999\nend_header\n", "no vertex", {}},
        {"a.ply", ply + "property float z\nelement face 1\nproperty list int float vertex_indices\nend_header\n"
                        "0 0 0\n1 0 0\n0 1 0\n3 0 1 1.5\n",
         "name a vertex", {0}},
        {"a.ply", ply + "property float z\nelement face 1\nproperty list int int vertex_indices\nend_header\n"
                        "0 0 0\n1 0 0\n0 1 0\n-3 0 1 2\n",
         "a list's length", {}},
        {"a.stl", "", "neither a text STL", {}},
        {"a.stl", "solid empty\nendsolid empty\n", "no vertex", {}},
        {"a.stl", "solid a\nfacet normal 0 0 1\nvertex 0 0\nendfacet\n", "line 3: expected a number", {}},
        {"a.stl", "solid a\nfacet\nvertex 0 0 0\nvertex 1 0 0\nendfacet\nendsolid\n", "line 5: expected three vertices", {}},
        {"a.stl", std::string(80, ' ') + "\xff\xff\xff\x7f" + std::string(50, '\0'), "does not fit the file", {}},
        {"a.glb", "glTF", "format not supported: '.glb'; supported are OBJ, OFF, PLY, STL", {}},
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
    for (const Format& format : formats()) files.emplace_back(format.file, openmesh_bytes(folder, sample_mesh(), format));
    std::string stl(80, ' ');
    stl.append("\x04\0\0\0", 4);
    for (int facet = 0; facet < 4; ++facet) {
        const auto t = static_cast<float>(facet);
        const float numbers[12] = {0, 0, 1, t, 0, 0, t + 1, 0, 0, t, 1, 0};
        stl.append(reinterpret_cast<const char*>(numbers), sizeof numbers).append("\0\0", 2);
    }
    files.emplace_back("mesh.stl", stl);
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
                const std::size_t at = random() % (random() % 2 ? damaged.size() : std::min<std::size_t>(damaged.size(), 100));
                damaged[at] = static_cast<char>(random());
            }
            is_read(name, damaged);
        }
}

}  // namespace
}  // namespace koebe
