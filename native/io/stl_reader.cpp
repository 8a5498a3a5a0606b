#include "core/errors.h"
#include "io/format_readers.h"
#include "io/refusals.h"
#include "io/text_lines.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <map>
#include <utility>
#include <vector>

namespace koebe::io {
namespace {

constexpr std::size_t header_bytes = 84, facet_bytes = 50;  // the header ends with the number of facets
constexpr std::size_t normal_bytes = 12;

/// A point in an order where -0 is 0 and a NaN equals no number.
struct Point : std::array<double, 3> {
    static std::pair<int, double> rank(double number)
    {
        if (!std::isnan(number)) return {0, number};
        return {std::signbit(number) ? -1 : 1, 0.0};
    }
    friend bool operator<(const Point& a, const Point& b)
    {
        return std::lexicographical_compare(a.begin(), a.end(), b.begin(), b.end(),
                                            [](double x, double y) { return rank(x) < rank(y); });
    }
};

/// Triangles whose equal corners are one vertex, numbered as they first appear.
class Facets {
public:
    void add(const std::array<Point, 3>& corners)
    {
        for (const Point& corner : corners) {
            const auto [found, is_new] = vertices_.try_emplace(corner, static_cast<Index>(vertices_.size()));
            if (is_new) coordinates_.insert(coordinates_.end(), corner.begin(), corner.end());
            mesh_.corners.push_back(found->second);
        }
        if (mesh_.corners.size() >= most_elements) refuse_size();
        mesh_.face_begin.push_back(static_cast<Index>(mesh_.corners.size()));
    }

    PolygonMesh take()
    {
        mesh_.vertices =
            Eigen::Map<const Vertices>(coordinates_.data(), static_cast<Eigen::Index>(coordinates_.size() / 3), 3);
        return std::move(mesh_);
    }

    [[noreturn]] void refuse_next() const
    {
        refuse("facet", static_cast<std::size_t>(mesh_.face_count()), "is missing or cut short, or endsolid is");
    }

private:
    std::map<Point, Index> vertices_;
    std::vector<double> coordinates_;
    PolygonMesh mesh_;
};

std::size_t facet_count(std::string_view bytes)
{
    std::uint32_t count = 0;
    if (bytes.size() >= header_bytes) std::memcpy(&count, bytes.data() + header_bytes - sizeof count, sizeof count);
    return count;
}

/// Whether the length is that of a binary file. Binary files may start with "solid", too, so the length decides.
bool has_length_of_binary(std::string_view bytes)
{
    return bytes.size() == header_bytes + facet_bytes * facet_count(bytes);
}

bool is_text_stl(std::string_view bytes)
{
    const std::size_t first = std::min(bytes.find_first_not_of(" \t\r\n"), bytes.size());
    return !has_length_of_binary(bytes) && bytes.substr(first).starts_with("solid");
}

/// Takes the words between "facet" and "endfacet": three times "vertex" and its coordinates, and other words.
/// @return false if they are different
bool take_facet(std::string_view& text, std::array<Point, 3>& corners)
{
    std::size_t count = 0;
    for (std::string_view word = take_word(text); word != "endfacet"; word = take_word(text)) {
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
    for (std::string_view word = take_word(text); !word.empty(); word = take_word(text)) {
        if (word == "solid" && std::exchange(in_solid, true)) facets.refuse_next();
        if (word == "endsolid") in_solid = false, has_end = true;
        std::array<Point, 3> corners;
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
        std::array<Point, 3> corners;
        for (std::size_t k = 0; k < numbers.size(); ++k) corners[k / 3][k % 3] = numbers[k];
        facets.add(corners);
    }
    return facets.take();
}

}  // namespace

PolygonMesh read_stl(std::string_view bytes)
{
    if (is_text_stl(bytes)) return read_text_stl(bytes);
    if (bytes.size() < header_bytes + facet_bytes * facet_count(bytes))
        throw InputError("the file is no STL: a text starts with 'solid', a binary file is as long as its header says");
    return read_binary_stl(bytes);
}

/// Normals follow from the corners. Many programs store a colour in the two bytes after each facet of a binary file.
FileLosses stl_contents(std::string_view bytes)
{
    if (is_text_stl(bytes)) return {};
    for (std::size_t facet = 0; facet < facet_count(bytes); ++facet)
        for (const std::size_t k : {1, 2})
            if (bytes[header_bytes + facet_bytes * (facet + 1) - k] != 0) return {false, {"facet colours"}};
    return {};
}

}  // namespace koebe::io
