#include "core/errors.h"
#include "execution/thread_share.h"
#include "io/format_readers.h"
#include "io/ply_file.h"
#include "io/polygon_mesh.h"
#include "io/refusals.h"

#include <algorithm>
#include <bit>
#include <cstdint>
#include <cstring>
#include <optional>
#include <string>
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

/// @return false if the data end before the faces, or behind them
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
    const std::size_t all = element.count * layout.bytes + sizeof(Index) * corners;
    if (all > data.size() || data.size() - all > most_line_end) return false;
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

/// Reads a little-endian file that has vertices first and then faces. The list of corners must be the only list of a
/// face. Uses the calling thread's share of threads.
/// @return nothing for another kind of file, or with a fault: the file is then read value by value, which reports it
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

/// In text, coordinates of every type are read with 64 bits.
void require_ply_properties(const PlyElement& element, bool is_text)
{
    for (const char* axis : {"x", "y", "z"})
        if (const PlyProperty* found = element.find(axis);
            element.is_vertex() && !(found && (is_text ? !found->is_list() : found->is_real())))
            throw InputError(std::string("the header gives element vertex no float or double ") + axis);
    const PlyProperty* corners = element.find("vertex_indices");
    if (element.has_corners() && !(corners && corners->is_list() && corners->type < PlyType::float32))
        throw InputError("the header gives element " + element.name + " no list of int or uint vertex_indices");
}

constexpr Index strip_end = -1;

class PlyReader {
public:
    explicit PlyReader(const PlyFile& file) : values_(file)
    {
        for (const PlyElement& element : file.elements) {
            require_ply_properties(element, file.encoding == PlyEncoding::text);
            std::vector<PlyRole> roles;
            for (const PlyProperty& property : element.properties) roles.push_back(element.role(property));
            for (std::size_t i = 0; i < element.count; ++i)
                if (!read_item(element, roles))
                    refuse(element.name, i, "is missing, is cut short or has a word that is no number");
        }
        if (!values_.is_at_end()) throw InputError("the header of the PLY file counts fewer elements than follow");
    }

    PolygonMesh take()
    {
        mesh_.vertices =
            Eigen::Map<const Vertices>(coordinates_.data(), static_cast<Eigen::Index>(coordinates_.size() / 3), 3);
        return std::move(mesh_);
    }

private:
    bool read_item(const PlyElement& element, const std::vector<PlyRole>& roles)
    {
        if (element.is_vertex()) coordinates_.resize(coordinates_.size() + 3);
        for (std::size_t p = 0; p < roles.size(); ++p)
            if (!read_value(element.properties[p], roles[p])) return false;
        if (element.is_face()) mesh_.face_begin.push_back(static_cast<Index>(mesh_.corners.size()));
        if (element.is_strips()) add_triangles();
        if (std::max({coordinates_.size() / 3, mesh_.face_begin.size(), mesh_.corners.size()}) >= most_elements)
            refuse_size();
        return true;
    }

    /// Makes triangles of the strips whose vertices were read, every second one turned round.
    void add_triangles()
    {
        std::vector<Index>& corners = mesh_.corners;
        const auto begin = corners.begin() + mesh_.face_begin.back();
        const std::vector<Index> strips(begin, corners.end());
        corners.erase(begin, corners.end());
        std::size_t place = 0;  // in its strip
        for (std::size_t k = 0; k < strips.size(); ++k, ++place) {
            if (strips[k] == strip_end) place = static_cast<std::size_t>(-1);
            if (strips[k] == strip_end || place < 2) continue;
            const std::size_t turned = place % 2;
            corners.insert(corners.end(), {strips[k - 2 + turned], strips[k - 1 - turned], strips[k]});
            mesh_.face_begin.push_back(static_cast<Index>(corners.size()));
            if (corners.size() >= most_elements) refuse_size();
        }
    }

    bool read_value(const PlyProperty& property, PlyRole role)
    {
        if (role == PlyRole::other) return values_.skip(property);
        if (role != PlyRole::corners)
            return values_.read(property.type, coordinates_.end()[static_cast<int>(role) - 3]);
        Index count = 0, corner = 0;
        if (!values_.read(*property.length, count) || count < 0) return false;
        for (Index k = 0; k < count; ++k) {
            if (!values_.read(property.type, corner)) return false;
            mesh_.corners.push_back(corner);
        }
        return true;
    }

    PlyValues values_;
    std::vector<double> coordinates_;
    PolygonMesh mesh_;
};

bool is_among(const std::string& name, std::initializer_list<const char*> names)
{
    return std::ranges::find(names, name) != names.end();
}

}  // namespace

/// CGAL's read_PLY is not used: it follows a null pointer if x, red or source has an unexpected type, makes room for a
/// list before it reads it, and cannot tell which element is wrong.
PolygonMesh read_ply(std::string_view bytes)
{
    const PlyFile file = parse_ply(bytes);
    if (std::optional<PolygonMesh> mesh = read_little_endian_ply(file)) return *std::move(mesh);
    return PlyReader(file).take();
}

PlanarPoints ply_corner_uvs(std::string_view bytes, const PolygonMesh& mesh, int)
{
    const PlyFile file = parse_ply(bytes);
    PlyValues values(file);
    PlanarPoints of_vertices(mesh.vertices.rows(), 2), of_corners(static_cast<Eigen::Index>(mesh.corners.size()), 2);
    Eigen::Index corner = 0;
    bool has_vertices = false, has_corners = false;
    for (const PlyElement& element : file.elements)
        for (std::size_t i = 0; i < element.count; ++i) {
            Eigen::Index axis = 0;  // u comes before v under all names
            for (const PlyProperty& property : element.properties) {
                bool read = true;
                if (!is_ply_uv(element, property) ||
                    (element.is_vertex() ? property.is_list() || axis > 1 : !property.is_list())) {
                    read = values.skip(property);
                } else if (element.is_vertex()) {
                    has_vertices = axis == 1;
                    read = values.read(property.type, of_vertices(static_cast<Eigen::Index>(i), axis++));
                } else {
                    Index count = 0;
                    const auto face = mesh.face(static_cast<Index>(i));
                    read = values.read(*property.length, count) && count == 2 * static_cast<Index>(face.size());
                    for (Index k = 0; read && k < count; ++k, has_corners = true)
                        read = values.read(property.type, of_corners(corner + k / 2, k % 2));
                    corner += count / 2;
                }
                if (!read) refuse(element.name, i, "has no texture coordinates for each corner");
            }
        }
    if (has_corners && corner != of_corners.rows())
        throw InputError("faces without texture coordinates beside faces with them");
    if (has_corners) return of_corners;
    return has_vertices ? PlanarPoints(of_vertices(mesh.corners, Eigen::all)) : PlanarPoints();
}

FileLosses ply_contents(std::string_view bytes)
{
    FileLosses losses;
    const auto add = [&](const std::string& word) {
        if (std::ranges::find(losses.others, word) == losses.others.end()) losses.others.push_back(word);
    };
    // Elements other than vertices and faces, and their properties that are not read.
    for (const PlyElement& element : parse_ply(bytes).elements) {
        if (!element.is_vertex() && !element.has_corners()) {
            if (element.count > 0) add("element " + element.name);
            continue;
        }
        for (const PlyProperty& property : element.properties) {
            const std::string& name = property.name;
            if (element.role(property) != PlyRole::other) continue;
            if (is_ply_uv(element, property))
                losses.texture_coordinates = true;
            else if (is_ply_normal(property))
                add("normals");
            else if (is_among(name, {"red", "green", "blue", "alpha", "diffuse_red", "diffuse_green", "diffuse_blue"}))
                add(element.name + " colours");
            else
                add(element.name + " property " + name);
        }
    }
    return losses;
}

}  // namespace koebe::io
