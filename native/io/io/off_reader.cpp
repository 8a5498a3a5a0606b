#include "core/errors.h"
#include "files/text_lines.h"
#include "io/format_readers.h"
#include "io/refusals.h"

#include <algorithm>
#include <cctype>
#include <charconv>
#include <cstdint>
#include <string>
#include <vector>

namespace koebe::io {
namespace {

/// The next word outside comments, and the rest of the text; empty at the end.
std::string_view next_word(std::string_view& text)
{
    std::string_view word = take_word(text);
    while (word.starts_with('#')) {
        text = text_between(word.data(), text.data() + text.size());
        text.remove_prefix(std::min(text.find('\n'), text.size()));
        word = take_word(text);
    }
    return word;
}

/// The first word of the next line that has a word; empty at the end.
std::string_view first_word(TextLines& lines)
{
    std::string_view word;
    while (word.empty() && lines.next_line()) word = lines.next_word();
    return word;
}

constexpr const char* no_off_header = "the file does not start with OFF and three counts";

struct OffHeader {
    bool has_textures = false, has_normals = false, is_homogeneous = false;
    std::size_t vertices = 0, faces = 0;
    std::string_view rest;  ///< after the third number
};

/// Takes a prefix off the keyword.
bool take_prefix(std::string_view& keyword, std::string_view prefix)
{
    const bool is_there = keyword.starts_with(prefix);
    if (is_there) keyword.remove_prefix(prefix.size());
    return is_there;
}

/// Takes a number of the header; the rest of the text follows it.
/// @throws InputError it is not an integer, or is more than the file can hold
std::int64_t take_count(std::string_view& text, const std::string& element, std::size_t bytes)
{
    const std::string_view word = next_word(text);
    std::int64_t count = 0;
    const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), count);
    // Vertices and faces take at least a byte. The number of edges is not used.
    const auto most = static_cast<std::int64_t>(std::min(bytes, std::size_t{1} << 28));
    if (error == std::errc::result_out_of_range || count > most || count < -most)
        throw InputError("the header's count of " + element + " elements does not fit the file");
    if (end != word.data() + word.size() && (*end == '-' || *end == '+'))
        throw InputError("the header's count of " + element + " elements is no integer");
    text = text_between(end, text.data() + text.size());
    if (error != std::errc()) throw InputError(no_off_header);
    return count;
}

/// @throws InputError the file is not three-dimensional text, or a count is more than the file can hold
OffHeader off_header(std::string_view bytes)
{
    OffHeader header{.rest = bytes};
    std::string_view keyword = next_word(header.rest), after = header.rest;
    const auto is_in_keyword = [](unsigned char c) { return c < 128 && std::isalnum(c) != 0; };
    if (!std::ranges::all_of(keyword, is_in_keyword)) throw InputError(no_off_header);
    if (next_word(after).starts_with("BINARY") || keyword.ends_with("SKEL") ||
        keyword.find('n') != std::string_view::npos)
        throw InputError("OFF is supported as a text in three dimensions, not binary, SKEL or nOFF");
    header.has_textures = take_prefix(keyword, "ST");
    take_prefix(keyword, "C");  // the line has further numbers as colours
    header.has_normals = take_prefix(keyword, "N");
    header.is_homogeneous = take_prefix(keyword, "4");
    const std::int64_t vertices = take_count(header.rest, "vertex", bytes.size());
    const std::int64_t faces = take_count(header.rest, "face", bytes.size());
    take_count(header.rest, "edge", bytes.size());
    if (keyword != "OFF" || vertices < 0 || faces < 0) throw InputError(no_off_header);
    if (header.rest.starts_with('.')) throw InputError("the header has no number of edges");  // a coordinate
    header.vertices = static_cast<std::size_t>(vertices);
    header.faces = static_cast<std::size_t>(faces);
    return header;
}

/// Reads the next line with content: three coordinates, perhaps a fourth that divides them if they are homogeneous, and
/// perhaps a normal, a colour or texture coordinates.
/// @return false if the line is missing or has other words
bool read_off_vertex(TextLines& lines, bool is_homogeneous, double* point)
{
    std::string_view word = first_word(lines);
    for (int axis = 0; axis < 3; ++axis, word = lines.next_word())
        if (!to_number(word, point[axis])) return false;
    double w = 1.0;
    if (is_homogeneous && (!to_number(word, w) || w == 0.0)) return false;
    for (int axis = 0; axis < 3; ++axis) point[axis] /= w;
    return true;
}

/// Reads the next line with content: the number of corners, the vertices, and perhaps a colour.
/// @return false if the line is missing, is cut short or names a vertex that does not exist
bool read_off_face(TextLines& lines, std::vector<Index>& corners, std::size_t vertex_count)
{
    Index count = 0, vertex = 0;
    if (!to_number(first_word(lines), count)) return false;
    for (Index k = 0; k < count; ++k) {
        if (!to_number(lines.next_word(), vertex) || vertex < 0) return false;
        if (static_cast<std::size_t>(vertex) >= vertex_count) return false;
        corners.push_back(vertex);
    }
    return count >= 0;
}

}  // namespace

/// CGAL's read_OFF is not used: it makes room for as many corners as a face claims, reads outside its arrays if a
/// colour has two numbers, and cannot tell which element is wrong.
PolygonMesh read_off(std::string_view bytes)
{
    const OffHeader header = off_header(bytes);
    TextLines lines(header.rest);
    PolygonMesh mesh;
    mesh.vertices.resize(static_cast<Eigen::Index>(header.vertices), 3);
    for (std::size_t v = 0; v < header.vertices; ++v)
        if (!read_off_vertex(lines, header.is_homogeneous, mesh.vertices.row(static_cast<Eigen::Index>(v)).data()))
            refuse("vertex", v, "is missing or is not three finite numbers");
    for (std::size_t f = 0; f < header.faces; ++f) {
        if (!read_off_face(lines, mesh.corners, header.vertices))
            refuse("face", f, "is missing, is cut short or names a vertex that is not there");
        if (mesh.corners.size() >= most_elements) refuse_size();
        mesh.face_begin.push_back(static_cast<Index>(mesh.corners.size()));
    }
    return mesh;
}

/// Ignores faults, which read_off has reported.
FileLosses off_contents(std::string_view bytes)
{
    const OffHeader header = off_header(bytes);
    FileLosses losses;
    losses.texture_coordinates = header.has_textures;
    if (header.has_normals) losses.others.emplace_back("normals");
    const std::size_t known = 3 + header.is_homogeneous + 3 * header.has_normals + 2 * header.has_textures;
    TextLines lines(header.rest);
    const auto has_more_words = [&](std::size_t than) {
        while (than > 0 && !lines.next_word().empty()) --than;
        return !lines.next_word().empty();
    };
    bool of_vertices = false, of_faces = false;
    for (std::size_t v = 0; v < header.vertices; ++v)
        of_vertices |= !first_word(lines).empty() && has_more_words(known - 1);
    for (std::size_t f = 0; f < header.faces; ++f) {
        Index corners = 0;
        of_faces |= to_number(first_word(lines), corners) && has_more_words(static_cast<std::size_t>(corners));
    }
    if (of_vertices) losses.others.emplace_back("vertex colours");
    if (of_faces) losses.others.emplace_back("face colours");
    return losses;
}

}  // namespace koebe::io
