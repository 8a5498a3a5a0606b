#include "core/errors.h"
#include "io/format_readers.h"
#include "io/polygon_soup.h"
#include "io/text_numbers.h"

#include <CGAL/IO/OFF.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <charconv>
#include <cstdint>
#include <sstream>
#include <string>
#include <vector>

namespace koebe::io {
namespace {

/// The next word that is no comment, and the rest of the text; empty at its end.
std::string_view next_word(std::string_view& text)
{
    constexpr std::string_view spaces = " \t\r\n\v\f";
    for (;;) {
        text.remove_prefix(std::min(text.find_first_not_of(spaces), text.size()));
        if (!text.starts_with('#')) break;
        text.remove_prefix(std::min(text.find('\n'), text.size()));
    }
    const std::string_view word = text.substr(0, text.find_first_of(spaces));
    text.remove_prefix(word.size());
    return word;
}

/// The first word of the next line that has one; empty at the end.
std::string_view first_word(TextLines& lines)
{
    std::string_view word;
    while (word.empty() && lines.next_line()) word = lines.next_word();
    return word;
}

/// CGAL computes with the counts in 32 bits before anybody can look at them.
/// @throws InputError the file is not a text in three dimensions, or a count is more than the file can hold
void require_off_header(std::string_view bytes)
{
    std::string_view text = bytes;
    const std::string_view keyword = next_word(text);
    // CGAL ends the keyword at the first such character, and takes what follows for the next word.
    const auto in_keyword = [](unsigned char c) { return c < 128 && std::isalnum(c) != 0; };
    if (!std::ranges::all_of(keyword, in_keyword))
        throw InputError("the file does not start with OFF and three counts");
    std::string_view word = next_word(text);
    if (word.starts_with("BINARY") || keyword.ends_with("SKEL") || keyword.find('n') != std::string_view::npos)
        throw InputError("OFF is supported as a text in three dimensions, not binary, SKEL or nOFF");
    for (const char* element : {"vertex", "face", "edge"}) {
        std::int64_t count = 0;
        const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), count);
        // Vertices and faces take a byte at least. How many edges there are is for nobody's use.
        const auto most = static_cast<std::int64_t>(std::min(bytes.size(), std::size_t{1} << 28));
        if (error == std::errc::result_out_of_range || count > most || count < -most)
            throw InputError(std::string("the header's number of element ") + element + " does not fit the file");
        // CGAL takes what comes behind a number, without a space, for the next one.
        if (end != word.data() + word.size() && (*end == '-' || *end == '+'))
            throw InputError(std::string("the header's number of element ") + element + " is no integer");
        word = next_word(text);
    }
}

/// The next line that says something: three coordinates, which a fourth number divides if they are homogeneous, and
/// perhaps a normal, a colour or texture coordinates.
/// @return false: the line is missing, or is not these numbers
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

/// The next line that says something: a number of corners, as many vertices from `first` on, and perhaps a colour.
/// @return false: the line is missing, is cut short or names a vertex that is not there
bool read_off_face(TextLines& lines, std::vector<Index>& corners, Index first, std::size_t vertex_count)
{
    Index count = 0, vertex = 0;
    if (!to_number(first_word(lines), count)) return false;
    for (Index k = 0; k < count; ++k) {
        if (!to_number(lines.next_word(), vertex) || vertex < first) return false;
        if (static_cast<std::size_t>(vertex - first) >= vertex_count) return false;
        corners.push_back(vertex - first);
    }
    return count >= 0;
}

}  // namespace

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
            refuse("vertex", v, "is missing or is not three finite numbers");
    for (std::size_t f = 0; f < header.size_of_facets(); ++f) {
        if (!read_off_face(lines, mesh.corners, static_cast<Index>(header.index_offset()), header.size_of_vertices()))
            refuse("face", f, "is missing, is cut short or names a vertex that is not there");
        if (mesh.corners.size() >= most_elements) refuse_size();
        mesh.face_begin.push_back(static_cast<Index>(mesh.corners.size()));
    }
    return mesh;
}

/// A fault is no matter here, as read_off has told it.
FileLosses off_contents(std::string_view bytes)
{
    std::string_view text = bytes;
    const std::string_view keyword = next_word(text);
    std::array<std::size_t, 2> counts{};
    for (std::size_t& count : counts) {
        const std::string_view word = next_word(text);
        std::from_chars(word.data(), word.data() + word.size(), count);
    }
    next_word(text);
    FileLosses losses;
    losses.texture_coordinates = keyword.starts_with("ST");
    const bool has_normals = keyword.find('N') != keyword.npos, is_homogeneous = keyword.find('4') != keyword.npos;
    if (has_normals) losses.others.emplace_back("normals");
    const std::size_t known = 3 + is_homogeneous + 3 * has_normals + 2 * losses.texture_coordinates;
    TextLines lines(text);
    const auto has_more_words = [&](std::size_t than) {
        while (than > 0 && !lines.next_word().empty()) --than;
        return !lines.next_word().empty();
    };
    bool of_vertices = false, of_faces = false;
    for (std::size_t v = 0; v < counts[0]; ++v) of_vertices |= !first_word(lines).empty() && has_more_words(known - 1);
    for (std::size_t f = 0; f < counts[1]; ++f) {
        Index corners = 0;
        of_faces |= to_number(first_word(lines), corners) && has_more_words(static_cast<std::size_t>(corners));
    }
    if (of_vertices) losses.others.emplace_back("vertex colours");
    if (of_faces) losses.others.emplace_back("face colours");
    return losses;
}

}  // namespace koebe::io
