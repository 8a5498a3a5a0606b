#include "io/format_readers.h"

#include "core/errors.h"
#include "io/off_text.h"
#include "io/text_numbers.h"

#include <CGAL/IO/OFF.h>
#include <CGAL/IO/PLY.h>
#include <CGAL/IO/STL.h>

#include <algorithm>
#include <array>
#include <compare>
#include <cstdint>
#include <cstring>
#include <iterator>
#include <limits>
#include <map>
#include <sstream>
#include <string_view>
#include <utility>
#include <vector>

namespace koebe::io {
namespace {

/// In its order, by which CGAL finds the equal corners of an STL file, -0 is 0 and a NaN is no other number.
struct Point : std::array<double, 3> {
    friend bool operator<(const Point& a, const Point& b)
    {
        return std::lexicographical_compare_three_way(a.begin(), a.end(), b.begin(), b.end(), std::weak_order) < 0;
    }
    friend std::istream& operator>>(std::istream& stream, Point& p) { return stream >> p[0] >> p[1] >> p[2]; }
};

struct Soup {
    std::vector<Point> points;
    std::vector<std::vector<Index>> polygons;
};

constexpr std::size_t most = std::numeric_limits<Index>::max();

[[noreturn]] void too_large() { throw InputError("the mesh is too large for 32-bit indices"); }

PolygonMesh to_mesh(const Soup& soup)
{
    std::size_t corners = 0;
    for (const std::vector<Index>& polygon : soup.polygons) corners += polygon.size();
    if (std::max({soup.points.size(), soup.polygons.size(), corners}) >= most) too_large();
    PolygonMesh mesh;
    mesh.vertices.resize(static_cast<Eigen::Index>(soup.points.size()), 3);
    for (std::size_t v = 0; v < soup.points.size(); ++v)
        std::ranges::copy(soup.points[v], mesh.vertices.row(static_cast<Eigen::Index>(v)).begin());
    mesh.corners.reserve(corners);
    mesh.face_begin.reserve(soup.polygons.size() + 1);
    for (const std::vector<Index>& polygon : soup.polygons) {
        mesh.corners.insert(mesh.corners.end(), polygon.begin(), polygon.end());
        mesh.face_begin.push_back(static_cast<Index>(mesh.corners.size()));
    }
    return mesh;
}

[[noreturn]] void fail(const std::string& element, std::size_t number, const char* complaint)
{
    throw InputError(element + ' ' + std::to_string(number) + ' ' + complaint,
                     element == "vertex" ? ElementKind::vertices : ElementKind::faces, {static_cast<Index>(number)});
}

/// Every vertex and face takes a byte at least. Without this, a header could ask for any amount of memory.
void require_count_fits(std::size_t count, const std::string& element, std::size_t bytes)
{
    if (count > bytes) throw InputError("the header's number of element " + element + " does not fit the file");
}

}  // namespace

// ---------------------------------------------------------------- OBJ

/// Not by CGAL, which makes a stream of each line: that takes a third of the command's whole time. tinyobjloader
/// changes the last digits of numbers, and Assimp keeps 32 bits.
PolygonMesh read_obj(std::string_view bytes)
{
    std::vector<double> coordinates;
    PolygonMesh mesh;
    TextLines lines(bytes);
    while (lines.next_line()) {
        const std::string_view keyword = lines.next_word();
        const std::size_t vertex_count = coordinates.size() / 3;
        if (keyword == "v") {
            for (int axis = 0; axis < 3; ++axis)
                if (!to_number(lines.next_word_of_joined_lines(), coordinates.emplace_back()))
                    fail("vertex", vertex_count, "is not three finite numbers");
        } else if (keyword == "f") {
            for (std::string_view word; !(word = lines.next_word_of_joined_lines()).empty();) {
                Index corner = 0;  // from 1 on; from the last vertex backwards if it is negative
                if (!to_number(word.substr(0, word.find('/')), corner))
                    fail("face", mesh.face_begin.size() - 1, "has a corner that is no integer");
                mesh.corners.push_back(corner > 0 ? corner - 1 : static_cast<Index>(vertex_count) + corner);
            }
            mesh.face_begin.push_back(static_cast<Index>(mesh.corners.size()));
        }
        if (std::max({vertex_count, mesh.face_begin.size(), mesh.corners.size()}) >= most) too_large();
    }
    mesh.vertices =
        Eigen::Map<const Vertices>(coordinates.data(), static_cast<Eigen::Index>(coordinates.size() / 3), 3);
    return mesh;
}

// ---------------------------------------------------------------- OFF

/// The header by CGAL. Not by read_OFF, which makes room for as many corners as a face says, and reads outside its
/// arrays if a colour has two numbers; nor can it say which element is wrong.
PolygonMesh read_off(std::string_view bytes)
{
    require_off_header(bytes);
    std::istringstream file{std::string(bytes)};
    const CGAL::File_scanner_OFF header(file);
    if (file.fail()) throw InputError("the file does not start with OFF and three counts");
    if (file.peek() == '.') throw InputError("the header has no number of edges");  // it was taken from a coordinate
    require_count_fits(header.size_of_vertices(), "vertex", bytes.size());
    require_count_fits(header.size_of_facets(), "face", bytes.size());
    const std::size_t end = file.eof() ? bytes.size() : static_cast<std::size_t>(file.tellg());
    TextLines lines(bytes.substr(end));
    PolygonMesh mesh;
    mesh.vertices.resize(static_cast<Eigen::Index>(header.size_of_vertices()), 3);
    for (std::size_t v = 0; v < header.size_of_vertices(); ++v)
        if (!read_off_vertex(lines, header.is_homogeneous(), mesh.vertices.row(static_cast<Eigen::Index>(v)).data()))
            fail("vertex", v, "is missing or is not three finite numbers");
    for (std::size_t f = 0; f < header.size_of_facets(); ++f) {
        if (!read_off_face(lines, mesh.corners, static_cast<Index>(header.index_offset()), header.size_of_vertices()))
            fail("face", f, "is missing, is cut short or names a vertex that is not there");
        if (mesh.corners.size() >= most) too_large();
        mesh.face_begin.push_back(static_cast<Index>(mesh.corners.size()));
    }
    return mesh;
}

// ---------------------------------------------------------------- PLY

namespace {

using PlyElement = CGAL::IO::internal::PLY_element;

/// A property of the header as CGAL reads it right; empty if there is no way.
///
/// CGAL passes over a property of unknown type, whose values it would take for the next one's, and makes room for a
/// list before it reads it: a length of four bytes could ask for 16 GB. In a text file, where the types say nothing of
/// the bytes, numbers become 64-bit.
std::string ply_property(const std::vector<std::string>& words, bool is_text)
{
    static const std::map<std::string_view, std::string_view> types{
        {"char", "char"},   {"int8", "char"},     {"uchar", "uchar"},   {"uint8", "uchar"},
        {"short", "short"}, {"int16", "short"},   {"ushort", "ushort"}, {"uint16", "ushort"},
        {"int", "int"},     {"int32", "int"},     {"uint", "int"},      {"uint32", "int"},
        {"float", "float"}, {"float32", "float"}, {"double", "double"}, {"float64", "double"}};
    const bool is_list = words.size() == 5 && words[1] == "list";
    if (!is_list && words.size() != 3) return {};
    const auto type = types.find(words[is_list ? 3 : 1]);
    if (type == types.end()) return {};
    std::string item(type->second);
    if (!is_list) return "property " + (is_text ? "double" : item) + ' ' + words[2] + '\n';
    if (is_text) item = item == "float" || item == "double" ? "double" : "int";
    const auto length = types.find(words[2]);
    if (length == types.end()) return {};
    const bool one_byte = length->second.ends_with("char"), two_bytes = length->second.ends_with("short");
    if (!is_text && !one_byte && !two_bytes) return {};
    return std::string("property list ") + (one_byte && !is_text ? "uchar " : "ushort ") + item + ' ' +
           (words[4] == "vertex_index" ? "vertex_indices" : words[4]) + '\n';
}

/// @throws InputError a line that is not one of a PLY header, or that CGAL cannot read
std::string ply_header(std::string_view filed)
{
    std::istringstream lines{std::string(filed)};
    std::string header, format, line;
    bool has_element = false;
    for (int number = 1; std::getline(lines, line); ++number) {
        std::istringstream stream(line);
        std::vector<std::string> words(std::istream_iterator<std::string>(stream), {});
        if (words.empty() || words[0] == "comment" || words[0] == "obj_info") continue;
        std::string known;
        if (words[0] == "property" && has_element) {
            known = ply_property(words, format == "ascii");
        } else if (words[0] == "format" && words.size() == 3 && format.empty()) {
            known = line + '\n';
            format = words[1];
        } else if (words[0] == "element" && words.size() == 3 && !format.empty()) {
            known = line + '\n';
            has_element = true;
        } else if (number == 1 && words[0] == "ply") {
            known = "ply\n";
        }
        if (known.empty()) throw InputError("line " + std::to_string(number) + " of the header is not supported");
        header += known;
    }
    return header + "end_header\n";
}

void require_ply_properties(PlyElement& element, bool is_vertex, bool is_face)
{
    for (const char* axis : {"x", "y", "z"})
        if (is_vertex && !element.has_property<double>(axis))
            throw InputError(std::string("the header gives element vertex no float or double ") + axis);
    if (is_face && !element.has_property<std::vector<std::int32_t>>("vertex_indices"))
        throw InputError("the header gives element face no list of int or uint vertex_indices");
}

}  // namespace

/// Not by read_PLY, which follows a null pointer if x, red or source has another type than it expects; nor can it say
/// which element is wrong.
PolygonMesh read_ply(std::string_view bytes)
{
    if (!bytes.starts_with("ply")) throw InputError("the file does not start with 'ply'");
    const std::size_t size = bytes.size(), end = bytes.find("\nend_header"), data = bytes.find('\n', end + 1);
    if (end == bytes.npos || data == bytes.npos) throw InputError("the header has no 'end_header'");
    std::istringstream file(ply_header(bytes.substr(0, end)) + std::string(bytes.substr(data + 1)));
    CGAL::IO::internal::PLY_reader header(false);
    if (!header.init(file)) throw InputError("the header's format or a count is not one of PLY");
    Soup soup;
    for (std::size_t e = 0; e < header.number_of_elements(); ++e) {
        PlyElement& element = header.element(e);
        const bool is_vertex = element.name() == "vertex", is_face = element.name() == "face";
        require_count_fits(element.number_of_items(), element.name(), size);
        require_ply_properties(element, is_vertex, is_face);
        for (std::size_t i = 0; i < element.number_of_items(); ++i) {
            for (std::size_t p = 0; p < element.number_of_properties(); ++p) element.property(p)->get(file);
            if (file.fail()) fail(element.name(), i, "is missing, is cut short or has a word that is no number");
            if (is_vertex) {
                Point& point = soup.points.emplace_back();
                element.assign(point[0], "x");
                element.assign(point[1], "y");
                element.assign(point[2], "z");
            }
            if (is_face) element.assign(soup.polygons.emplace_back(), "vertex_indices");
        }
    }
    return to_mesh(soup);
}

// ---------------------------------------------------------------- STL

PolygonMesh read_stl(std::string_view bytes)
{
    constexpr std::size_t header_bytes = 84, facet_bytes = 50;  // the header ends with the number of facets
    std::uint32_t count = 0;
    if (bytes.size() >= header_bytes) std::memcpy(&count, bytes.data() + header_bytes - sizeof count, sizeof count);
    const bool has_that_many = bytes.size() >= header_bytes + facet_bytes * count;
    // Binary files, too, may start with "solid": the length is the better witness.
    const bool is_binary = bytes.size() == header_bytes + facet_bytes * count;
    const std::size_t first = std::min(bytes.find_first_not_of(" \t\r\n"), bytes.size());
    const bool is_text = !is_binary && bytes.substr(first).starts_with("solid");
    if (!is_text && !has_that_many)
        throw InputError("neither a text STL, which starts with 'solid', nor a binary one of the length it says");
    std::istringstream file{std::string(bytes)};
    Soup soup;
    // Not read_STL, which tries the one after the other and keeps what the first one left.
    const bool was_read = is_text ? CGAL::IO::internal::parse_ASCII_STL(file, soup.points, soup.polygons)
                                  : CGAL::IO::internal::parse_binary_STL(file, soup.points, soup.polygons);
    if (!was_read) fail("facet", soup.polygons.size(), "is missing or cut short, or endsolid is");
    return to_mesh(soup);
}

}  // namespace koebe::io
