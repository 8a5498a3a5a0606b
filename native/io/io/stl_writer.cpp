#include "io/stl_writer.h"

#include "core/errors.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

namespace koebe {
namespace {

void require_apart(const Vertices& vertices)
{
    std::vector<std::pair<std::array<float, 3>, Index>> places;
    for (Index v = 0; v < static_cast<Index>(vertices.rows()); ++v) {
        std::array<float, 3> place{};  // + 0 makes 0 of -0
        for (int i = 0; i < 3; ++i) place[i] = static_cast<float>(vertices(v, i)) + 0.0F;
        places.emplace_back(place, v);
    }
    std::ranges::sort(places);
    std::vector<Index> met;
    for (std::size_t i = 1; i < places.size(); ++i)
        if (places[i].first == places[i - 1].first) met.push_back(places[i].second);
    std::ranges::sort(met);
    if (!met.empty())
        throw InputError("STL stores 32-bit floats, in which vertices come to lie on others: write OBJ or PLY",
                         ElementKind::vertices, std::move(met));
}

void append(std::string& bytes, std::uint32_t number)
{
    for (int shift = 0; shift < 32; shift += 8) bytes.push_back(static_cast<char>(number >> shift));
}

void append(std::string& bytes, const Eigen::RowVector3d& vector)
{
    for (const double number : vector) append(bytes, std::bit_cast<std::uint32_t>(static_cast<float>(number)));
}

}  // namespace

void write_stl(AtomicFile& file, const Vertices& vertices, const Triangles& triangles)
{
    require_apart(vertices);
    std::string bytes = "Koebe UV";
    bytes.resize(80, ' ');
    append(bytes, static_cast<std::uint32_t>(triangles.rows()));
    const Vertices stored = vertices.cast<float>().cast<double>();
    for (Eigen::Index f = 0; f < triangles.rows(); ++f) {
        const Eigen::RowVector3d a = stored.row(triangles(f, 0)), b = stored.row(triangles(f, 1)),
                                 c = stored.row(triangles(f, 2));
        append(bytes, (b - a).cross(c - a).stableNormalized());
        for (const auto& corner : {a, b, c}) append(bytes, corner);
        bytes.append(2, '\0');
    }
    file.write(bytes);
}

}  // namespace koebe
