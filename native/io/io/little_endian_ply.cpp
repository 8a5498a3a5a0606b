#include "io/little_endian_ply.h"

#include "execution/thread_share.h"
#include "io/refusals.h"

#include <algorithm>
#include <bit>
#include <cstdint>
#include <cstring>
#include <vector>

namespace koebe::io {
namespace {

constexpr std::size_t items_at_a_time = 32768;  // vertices, or faces, per thread

/// The places of an element's items in the bytes.
struct Layout {
    explicit Layout(const PlyElement& element)
    {
        for (const PlyProperty& property : element.properties) {
            offsets.push_back(bytes);
            bytes += bytes_of(property.length.value_or(property.type));
        }
    }
    std::vector<std::size_t> offsets;  // of the properties, without the items of lists
    std::size_t bytes = 0;             // of an item of the element, without the items of lists
};

template <class Number>
Number number_at(const char* place)
{
    Number number;
    std::memcpy(&number, place, sizeof number);
    return number;
}

bool is_plain(const PlyElement& vertices)
{
    const auto is_axis = [&](const char* axis) {
        const PlyProperty* found = vertices.find(axis);
        return found && found->is_real();
    };
    return vertices.is_vertex() && std::ranges::none_of(vertices.properties, &PlyProperty::is_list) && is_axis("x") &&
           is_axis("y") && is_axis("z");
}

/// Whether the corners are the only list.
bool is_plain_face(const PlyElement& faces)
{
    const PlyProperty* corners = faces.find("vertex_indices");
    return faces.is_face() && std::ranges::count_if(faces.properties, &PlyProperty::is_list) == 1 && corners &&
           corners->is_list() && (corners->type == PlyType::int32 || corners->type == PlyType::uint32);
}

std::size_t place_of(const PlyElement& element, const char* name)
{
    return static_cast<std::size_t>(element.find(name) - element.properties.data());
}

void read_vertices(const PlyElement& element, const char* data, Vertices& vertices)
{
    vertices.resize(static_cast<Eigen::Index>(element.count), 3);
    const Layout layout(element);
    const std::size_t axes[]{place_of(element, "x"), place_of(element, "y"), place_of(element, "z")};
    in_pieces(element.count, items_at_a_time, [&](std::size_t begin, std::size_t end) {
        for (std::size_t v = begin; v < end; ++v)
            for (int k = 0; k < 3; ++k) {
                const char* const place = data + v * layout.bytes + layout.offsets[axes[k]];
                vertices(static_cast<Eigen::Index>(v), k) = element.properties[axes[k]].type == PlyType::float64
                                                                ? number_at<double>(place)
                                                                : number_at<float>(place);
            }
    });
}

/// @return false if the data end before the faces
bool read_faces(const PlyElement& element, std::string_view data, PolygonMesh& mesh)
{
    const Layout layout(element);
    const std::size_t list = place_of(element, "vertex_indices"), offset = layout.offsets[list];
    const std::size_t length_bytes = bytes_of(*element.properties[list].length);
    const auto length_at = [&](const char* item) -> std::size_t {
        if (length_bytes == 4) return number_at<std::uint32_t>(item + offset);
        return length_bytes == 1 ? number_at<std::uint8_t>(item + offset) : number_at<std::uint16_t>(item + offset);
    };
    // A face's place depends on all lengths before it: first the lengths, one after another, then the corners.
    mesh.face_begin.resize(element.count + 1);
    std::size_t corners = 0;
    for (std::size_t f = 0; f < element.count; ++f) {
        const std::size_t begin = f * layout.bytes + sizeof(Index) * corners;
        if (begin + layout.bytes > data.size()) return false;
        corners += length_at(data.data() + begin);
        if (corners >= most_elements) return false;
        mesh.face_begin[f + 1] = static_cast<Index>(corners);
    }
    if (element.count * layout.bytes + sizeof(Index) * corners > data.size()) return false;
    mesh.corners.resize(corners);
    in_pieces(element.count, items_at_a_time, [&](std::size_t begin, std::size_t end) {
        for (std::size_t f = begin; f < end; ++f) {
            const std::size_t first = static_cast<std::size_t>(mesh.face_begin[f]);
            const std::size_t count = static_cast<std::size_t>(mesh.face_begin[f + 1]) - first;
            if (count > 0)
                std::memcpy(&mesh.corners[first],
                            data.data() + f * layout.bytes + sizeof(Index) * first + offset + length_bytes,
                            sizeof(Index) * count);
        }
    });
    return true;
}

}  // namespace

std::optional<PolygonMesh> read_little_endian_ply(const PlyFile& file)
{
    const std::vector<PlyElement>& elements = file.elements;
    if (std::endian::native != std::endian::little || file.encoding != PlyEncoding::little_endian) return {};
    if (elements.size() != 2 || !is_plain(elements[0]) || !is_plain_face(elements[1])) return {};
    const PlyElement &vertices = elements[0], &faces = elements[1];
    const std::size_t most = std::min(most_elements - 1, file.data.size());
    const std::size_t bytes = Layout(vertices).bytes * vertices.count;
    if (vertices.count > most || faces.count > most || bytes > file.data.size()) return {};
    PolygonMesh mesh;
    read_vertices(vertices, file.data.data(), mesh.vertices);
    if (!read_faces(faces, file.data.substr(bytes), mesh)) return {};
    return mesh;
}

}  // namespace koebe::io
