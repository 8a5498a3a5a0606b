#include "core/errors.h"
#include "io/format_readers.h"
#include "io/polygon_soup.h"

#include <CGAL/IO/STL.h>

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <sstream>
#include <string>

namespace koebe::io {

namespace {

constexpr std::size_t header_bytes = 84, facet_bytes = 50;  // the header ends with the number of facets

std::size_t facet_count(std::string_view bytes)
{
    std::uint32_t count = 0;
    if (bytes.size() >= header_bytes) std::memcpy(&count, bytes.data() + header_bytes - sizeof count, sizeof count);
    return count;
}

/// Binary files, too, may start with "solid": the length is the better witness.
bool has_length_of_binary(std::string_view bytes)
{
    return bytes.size() == header_bytes + facet_bytes * facet_count(bytes);
}

bool is_text_stl(std::string_view bytes)
{
    const std::size_t first = std::min(bytes.find_first_not_of(" \t\r\n"), bytes.size());
    return !has_length_of_binary(bytes) && bytes.substr(first).starts_with("solid");
}

}  // namespace

PolygonMesh read_stl(std::string_view bytes)
{
    const bool is_text = is_text_stl(bytes);
    if (!is_text && bytes.size() < header_bytes + facet_bytes * facet_count(bytes))
        throw InputError("neither a text STL, which starts with 'solid', nor a binary one of the length it says");
    std::istringstream file{std::string(bytes)};
    Soup soup;
    // Not read_STL, which tries the one after the other and keeps what the first one left.
    const bool was_read = is_text ? CGAL::IO::internal::parse_ASCII_STL(file, soup.points, soup.polygons)
                                  : CGAL::IO::internal::parse_binary_STL(file, soup.points, soup.polygons);
    if (!was_read) refuse("facet", soup.polygons.size(), "is missing or cut short, or endsolid is");
    return to_mesh(soup);
}

/// Normals follow from the corners. The two bytes behind each facet of a binary file are its colour for many programs.
FileLosses stl_contents(std::string_view bytes)
{
    if (is_text_stl(bytes)) return {};
    for (std::size_t facet = 0; facet < facet_count(bytes); ++facet)
        for (const std::size_t k : {1, 2})
            if (bytes[header_bytes + facet_bytes * (facet + 1) - k] != 0) return {false, {"facet colours"}};
    return {};
}

}  // namespace koebe::io
