#include "core/errors.h"
#include "io/format_readers.h"
#include "io/little_endian_ply.h"
#include "io/ply_file.h"
#include "io/refusals.h"

#include <algorithm>
#include <optional>
#include <string>
#include <vector>

namespace koebe::io {
namespace {

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
