#include "core/errors.h"
#include "io/binary_ply.h"
#include "io/format_readers.h"
#include "io/polygon_soup.h"

#include <CGAL/IO/PLY.h>

#include <cstdint>
#include <iterator>
#include <map>
#include <optional>
#include <sstream>
#include <string>
#include <vector>

namespace koebe::io {
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
    const std::string known = ply_header(bytes.substr(0, end));
    if (std::optional<PolygonMesh> mesh = read_binary_ply(known, bytes.substr(data + 1))) return *std::move(mesh);
    std::istringstream file(known + std::string(bytes.substr(data + 1)));
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
            if (file.fail()) refuse(element.name(), i, "is missing, is cut short or has a word that is no number");
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

}  // namespace koebe::io
