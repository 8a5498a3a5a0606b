// Stereolithography files, text and binary: facets with positions, from which shared vertices are made.
#include "io/format_readers.h"

#include "core/errors.h"
#include "io/byte_cursor.h"
#include "io/text_scanner.h"

#include <boost/functional/hash.hpp>

#include <algorithm>
#include <bit>
#include <cstdint>
#include <initializer_list>
#include <unordered_map>

namespace koebe::io {
namespace {

constexpr std::size_t header_bytes = 84;  // 80 of text, 4 of count
constexpr std::size_t facet_bytes = 50;   // normal, three positions, attribute

/// One vertex for each position. A NaN equals nothing and stays alone.
class VertexMerger {
public:
    explicit VertexMerger(MeshBuilder& mesh) : mesh_(mesh) {}
    void add_corner(std::array<double, 3> position)
    {
        for (double& x : position) x += 0.0;  // -0 to 0
        const auto [entry, added] = number_.try_emplace(position, static_cast<Index>(mesh_.vertex_count()));
        if (added) mesh_.add_vertex(position);
        mesh_.add_corner(entry->second);
    }

private:
    MeshBuilder& mesh_;
    std::unordered_map<std::array<double, 3>, Index, boost::hash<std::array<double, 3>>> number_;
};

bool is_one_of(std::string_view word, std::initializer_list<std::string_view> words)
{
    return std::find(words.begin(), words.end(), word) != words.end();
}

std::size_t filed_facet_count(std::string_view bytes)
{
    return ByteCursor(bytes, header_bytes - 4, std::endian::little).read<std::uint32_t>();
}

PolygonMesh read_binary(std::string_view bytes)
{
    const std::size_t count = filed_facet_count(bytes);
    ByteCursor cursor(bytes, header_bytes, std::endian::little);
    if (count > cursor.bytes_left() / facet_bytes)
        throw InputError("the header's number of facets does not fit the file");
    MeshBuilder mesh(count / 2, count);
    VertexMerger corners(mesh);
    for (std::size_t f = 0; f < count; ++f) {
        cursor.skip(12);  // normal
        for (int corner = 0; corner < 3; ++corner) {
            const double x = cursor.read<float>(), y = cursor.read<float>(), z = cursor.read<float>();
            corners.add_corner({x, y, z});
        }
        cursor.skip(2);  // attribute
        mesh.end_face();
    }
    return mesh.finish();
}

/// Keywords in lower or upper case; words, not lines, have a meaning. There may be many solids.
PolygonMesh read_text(std::string_view bytes)
{
    TextScanner text(bytes);
    MeshBuilder mesh;
    VertexMerger corners(mesh);
    bool in_solid = false;
    int facet_corners = 0;
    while (text.seek_word()) {
        const TextScanner before = text;
        const std::string_view keyword = text.word();
        if (is_one_of(keyword, {"vertex", "VERTEX"})) {
            const double x = text.number(), y = text.number(), z = text.number();
            corners.add_corner({x, y, z});
            ++facet_corners;
        } else if (is_one_of(keyword, {"endfacet", "ENDFACET"})) {
            if (facet_corners != 3) {
                text = before;
                text.fail("three vertices in each facet");
            }
            mesh.end_face();
            facet_corners = 0;
        } else if (is_one_of(keyword, {"solid", "SOLID", "endsolid", "ENDSOLID"})) {
            in_solid = keyword.size() == 5;
            text.skip_line();  // its name may hold keywords
        }
    }
    if (in_solid) text.fail("endsolid");
    return mesh.finish();
}

}  // namespace

PolygonMesh read_stl(std::string_view bytes)
{
    // Binary files, too, may start with "solid": the length is the better witness.
    const bool long_enough = bytes.size() >= header_bytes;
    if (long_enough && bytes.size() == header_bytes + facet_bytes * filed_facet_count(bytes)) return read_binary(bytes);
    TextScanner text(bytes);
    if (text.seek_word()) {
        if (is_one_of(text.word(), {"solid", "SOLID"})) return read_text(bytes);
    }
    if (!long_enough) throw InputError("neither a text STL, which starts with 'solid', nor long enough for a binary one");
    return read_binary(bytes);
}

}  // namespace koebe::io
