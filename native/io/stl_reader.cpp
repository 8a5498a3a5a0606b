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
    if (!was_read) refuse("facet", soup.polygons.size(), "is missing or cut short, or endsolid is");
    return to_mesh(soup);
}

}  // namespace koebe::io
