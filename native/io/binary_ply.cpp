#include "io/binary_ply.h"

#include "core/thread_share.h"
#include "io/polygon_soup.h"

#include <algorithm>
#include <bit>
#include <charconv>
#include <cstdint>
#include <cstring>
#include <sstream>
#include <string>
#include <vector>

namespace koebe::io {
namespace {

constexpr std::size_t items_at_a_time = 32768;  // vertices, or faces, of a thread

struct Property {
    std::string name;
    std::size_t offset = 0;  // from the item's begin, lists before it left out
    std::size_t bytes = 0;   // of a list: of its length
    bool is_list = false;
    bool is_real = false;   // float or double
    bool is_index = false;  // of a list: its items are corners
};

struct Element {
    std::string name;
    std::size_t count = 0;
    std::size_t bytes = 0;  // of an item, the items of lists left out
    std::vector<Property> properties;

    const Property* find(std::string_view wanted) const
    {
        const auto found = std::ranges::find(properties, wanted, &Property::name);
        return found == properties.end() ? nullptr : &*found;
    }
};

std::size_t bytes_of(std::string_view type)
{
    if (type.ends_with("char")) return 1;
    if (type.ends_with("short")) return 2;
    return type == "double" ? 8 : 4;
}

/// The elements of a header; empty unless it is of a little-endian file.
std::vector<Element> header_elements(std::string_view header)
{
    std::vector<Element> elements;
    std::istringstream lines{std::string(header)};
    std::string line, word;
    while (std::getline(lines, line)) {
        std::istringstream words(line);
        words >> word;
        if (word == "format") {
            words >> word;
            if (word != "binary_little_endian") return {};
        } else if (word == "element") {
            Element& element = elements.emplace_back();
            words >> element.name >> word;
            const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), element.count);
            if (error != std::errc() || end != word.data() + word.size()) return {};
        } else if (word == "property") {
            Element& element = elements.back();
            Property& property = element.properties.emplace_back();
            words >> word;
            property.is_list = word == "list";
            if (property.is_list) words >> word;
            property.bytes = bytes_of(word);
            property.is_real = word == "float" || word == "double";
            if (property.is_list) {
                words >> word;
                property.is_index = word == "int";
            }
            words >> property.name;
            property.offset = element.bytes;
            element.bytes += property.bytes;
        }
    }
    return elements;
}

template <class Number>
Number number_at(const char* place)
{
    Number number;
    std::memcpy(&number, place, sizeof number);
    return number;
}

bool is_plain(const Element& vertices)
{
    const auto is_list = [](const Property& p) { return p.is_list; };
    const auto is_axis = [&](const char* axis) {
        const Property* found = vertices.find(axis);
        return found && found->is_real;
    };
    return vertices.name == "vertex" && std::ranges::none_of(vertices.properties, is_list) && is_axis("x") &&
           is_axis("y") && is_axis("z");
}

/// Whether the corners are its one list.
bool is_plain_face(const Element& faces)
{
    const auto lists = std::ranges::count_if(faces.properties, [](const Property& p) { return p.is_list; });
    const Property* corners = faces.find("vertex_indices");
    return faces.name == "face" && lists == 1 && corners && corners->is_list && corners->is_index;
}

void read_vertices(const Element& element, const char* data, Vertices& vertices)
{
    vertices.resize(static_cast<Eigen::Index>(element.count), 3);
    const Property* const axes[]{element.find("x"), element.find("y"), element.find("z")};
    in_pieces(element.count, items_at_a_time, [&](std::size_t begin, std::size_t end) {
        for (std::size_t v = begin; v < end; ++v)
            for (int k = 0; k < 3; ++k) {
                const char* const place = data + v * element.bytes + axes[k]->offset;
                vertices(static_cast<Eigen::Index>(v), k) =
                    axes[k]->bytes == sizeof(double) ? number_at<double>(place) : number_at<float>(place);
            }
    });
}

/// @return false if the data end before the faces
bool read_faces(const Element& element, std::string_view data, PolygonMesh& mesh)
{
    const Property& list = *element.find("vertex_indices");
    const auto length_at = [&](const char* item) -> std::size_t {
        return list.bytes == 1 ? number_at<std::uint8_t>(item + list.offset)
                               : number_at<std::uint16_t>(item + list.offset);
    };
    mesh.face_begin.resize(element.count + 1);
    std::size_t corners = 0;
    for (std::size_t f = 0; f < element.count; ++f) {
        const std::size_t begin = f * element.bytes + sizeof(Index) * corners;
        if (begin + element.bytes > data.size()) return false;
        corners += length_at(data.data() + begin);
        if (corners >= most_elements) return false;
        mesh.face_begin[f + 1] = static_cast<Index>(corners);
    }
    if (element.count * element.bytes + sizeof(Index) * corners > data.size()) return false;
    mesh.corners.resize(corners);
    in_pieces(element.count, items_at_a_time, [&](std::size_t begin, std::size_t end) {
        for (std::size_t f = begin; f < end; ++f) {
            const std::size_t first = static_cast<std::size_t>(mesh.face_begin[f]);
            const std::size_t count = static_cast<std::size_t>(mesh.face_begin[f + 1]) - first;
            if (count > 0)
                std::memcpy(&mesh.corners[first],
                            data.data() + f * element.bytes + sizeof(Index) * first + list.offset + list.bytes,
                            sizeof(Index) * count);
        }
    });
    return true;
}

}  // namespace

std::optional<PolygonMesh> read_binary_ply(std::string_view header, std::string_view data)
{
    if constexpr (std::endian::native != std::endian::little) return {};
    const std::vector<Element> elements = header_elements(header);
    if (elements.size() != 2 || !is_plain(elements[0]) || !is_plain_face(elements[1])) return {};
    const Element &vertices = elements[0], &faces = elements[1];
    const std::size_t most = std::min(most_elements - 1, data.size());
    if (vertices.count > most || faces.count > most || vertices.count * vertices.bytes > data.size()) return {};
    PolygonMesh mesh;
    read_vertices(vertices, data.data(), mesh.vertices);
    data.remove_prefix(vertices.count * vertices.bytes);
    if (!read_faces(faces, data, mesh)) return {};
    return mesh;
}

}  // namespace koebe::io
