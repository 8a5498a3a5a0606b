#include "core/counted.h"
#include "core/errors.h"
#include "files/extension.h"
#include "files/text_lines.h"
#include "io/format_readers.h"
#include "io/refusals.h"
#include "io/welding.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstring>
#include <string>
#include <utility>
#include <vector>

namespace koebe::io {
namespace {

constexpr std::size_t header_bytes = 84, facet_bytes = 50;  // the header ends with the number of facets
constexpr std::size_t normal_bytes = 12;

using Facet = std::array<std::array<double, 3>, 3>;

/// Triangles whose equal corners are one vertex, numbered as they first appear.
class Facets {
public:
    void add(const Facet& corners)
    {
        for (const auto& corner : corners) coordinates_.insert(coordinates_.end(), corner.begin(), corner.end());
        if (coordinates_.size() / 3 >= most_elements) refuse_size();
    }

    PolygonMesh take() const
    {
        const auto count = static_cast<Eigen::Index>(coordinates_.size() / 3);
        const Vertices corners = Eigen::Map<const Vertices>(coordinates_.data(), count, 3);
        PolygonMesh mesh;
        std::vector<Index> number, kept;
        for (const Index first : weld(corners, 0.0)) {
            const bool is_new = first == static_cast<Index>(number.size());
            number.push_back(is_new ? static_cast<Index>(kept.size()) : number[static_cast<std::size_t>(first)]);
            if (is_new) kept.push_back(first);
            if (number.size() % 3 == 0) mesh.face_begin.push_back(static_cast<Index>(number.size()));
        }
        mesh.vertices = corners(kept, Eigen::all);
        mesh.corners = std::move(number);
        return mesh;
    }

    [[noreturn]] void refuse_next() const
    {
        refuse("facet", coordinates_.size() / 9, "is missing or cut short, or endsolid is");
    }

private:
    std::vector<double> coordinates_;
};

std::size_t facet_count(std::string_view bytes)
{
    std::uint32_t count = 0;
    if (bytes.size() >= header_bytes) std::memcpy(&count, bytes.data() + header_bytes - sizeof count, sizeof count);
    return count;
}

/// Whether the bytes have room for the facets that a binary header counts. Binary files may start with "solid", too,
/// and go on behind their facets. A text has no bytes below 9: it would have to be longer than 7 GB.
bool is_binary_stl(std::string_view bytes)
{
    return bytes.size() >= header_bytes && (bytes.size() - header_bytes) / facet_bytes >= facet_count(bytes);
}

bool is_text_stl(std::string_view bytes)
{
    const std::size_t first = std::min(bytes.find_first_not_of(" \t\r\n"), bytes.size());
    return !is_binary_stl(bytes) && lower(std::string(bytes.substr(first, 5))) == "solid";
}

/// The next word in lower case, as some programs write words in capitals.
std::string next_keyword(std::string_view& text) { return lower(std::string(take_word(text))); }

/// Skips the rest of the line, which has a name of any words, unless the first facet stands there.
void skip_name(std::string_view& text)
{
    const std::size_t end = std::min(text.find('\n'), text.size());
    if (lower(std::string(text.substr(0, end))).find("facet normal") == std::string::npos) text.remove_prefix(end);
}

/// Takes the words between "facet" and "endfacet": three times "vertex" and its coordinates, and other words.
/// @return false if they are different
bool take_facet(std::string_view& text, Facet& corners)
{
    std::size_t count = 0;
    for (std::string word = next_keyword(text); word != "endfacet"; word = next_keyword(text)) {
        if (word.empty()) return false;
        if (word != "vertex") continue;
        if (count == corners.size()) return false;
        for (double& coordinate : corners[count])
            if (!to_number(take_word(text), coordinate)) return false;
        ++count;
    }
    return count == corners.size();
}

PolygonMesh read_text_stl(std::string_view text)
{
    Facets facets;
    bool in_solid = false, has_end = false;
    for (std::string word = next_keyword(text); !word.empty(); word = next_keyword(text)) {
        if (word == "solid" && std::exchange(in_solid, true)) facets.refuse_next();
        if (word == "endsolid") in_solid = false, has_end = true;
        if (word.ends_with("solid")) skip_name(text);
        Facet corners;
        if (word == "facet") {
            if (!take_facet(text, corners)) facets.refuse_next();
            facets.add(corners);
        }
    }
    if (in_solid || !has_end) facets.refuse_next();
    return facets.take();
}

PolygonMesh read_binary_stl(std::string_view bytes)
{
    Facets facets;
    for (std::size_t facet = 0; facet < facet_count(bytes); ++facet) {
        std::array<float, 9> numbers;
        std::memcpy(numbers.data(), bytes.data() + header_bytes + facet_bytes * facet + normal_bytes, sizeof numbers);
        Facet corners;
        for (std::size_t k = 0; k < numbers.size(); ++k) corners[k / 3][k % 3] = numbers[k];
        facets.add(corners);
    }
    return facets.take();
}

}  // namespace

PolygonMesh read_stl(std::string_view bytes)
{
    if (is_text_stl(bytes)) return read_text_stl(bytes);
    if (!is_binary_stl(bytes))
        throw InputError("the file is no STL: a text starts with 'solid', a binary file is as long as its header says");
    if (facet_count(bytes) == 0 && bytes.size() >= header_bytes + facet_bytes)
        throw InputError("the header of the STL file counts no facet, though more bytes follow");
    return read_binary_stl(bytes);
}

/// Normals follow from the corners. Many programs store a colour in the two bytes after each facet of a binary file,
/// and some write more bytes behind the facets than a line's end.
FileLosses stl_contents(std::string_view bytes)
{
    if (is_text_stl(bytes)) return {};
    FileLosses losses;
    const std::size_t count = facet_count(bytes), rest = bytes.size() - header_bytes - facet_bytes * count;
    if (rest > 2) losses.others.push_back(std::to_string(rest) + " bytes behind the file's " + counted(count, "facet"));
    bool coloured = false;
    for (std::size_t facet = 0, end = header_bytes + facet_bytes; facet < count; ++facet, end += facet_bytes)
        coloured |= bytes[end - 1] != 0 || bytes[end - 2] != 0;
    if (coloured) losses.others.emplace_back("facet colours");
    return losses;
}

}  // namespace koebe::io
