// What the readers of all formats share: points and polygons as CGAL's scanners give them, limits, complaints.
#pragma once

#include "io/polygon_mesh.h"

#include <algorithm>
#include <array>
#include <compare>
#include <istream>
#include <limits>
#include <string>
#include <vector>

namespace koebe::io {

/// In its order, by which CGAL finds the equal corners of an STL file, -0 is 0 and a NaN is no other number.
struct Point : std::array<double, 3> {
    friend bool operator<(const Point& a, const Point& b)
    {
        return std::is_lt(
            std::lexicographical_compare_three_way(a.begin(), a.end(), b.begin(), b.end(), std::weak_order));
    }
    friend std::istream& operator>>(std::istream& stream, Point& p) { return stream >> p[0] >> p[1] >> p[2]; }
};

struct Soup {
    std::vector<Point> points;
    std::vector<std::vector<Index>> polygons;
};

PolygonMesh to_mesh(const Soup& soup);

/// More vertices, faces or corners than this have no 32-bit index.
inline constexpr std::size_t most_elements = std::numeric_limits<Index>::max();

/// @throws InputError always
[[noreturn]] void refuse_size();

/// @param element "vertex", "face" ... @throws InputError always
[[noreturn]] void refuse(const std::string& element, std::size_t number, const char* complaint);

/// Every vertex and face takes a byte at least. Without this, a header could ask for any amount of memory.
/// @throws InputError
void require_count_fits(std::size_t count, const std::string& element, std::size_t bytes);

}  // namespace koebe::io
