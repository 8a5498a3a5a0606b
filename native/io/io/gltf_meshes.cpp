#include "io/gltf_meshes.h"

#include "core/errors.h"
#include "io/gltf_model.h"
#include "io/refusals.h"
#include "io/welding.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <map>
#include <utility>

namespace koebe {
namespace {

template <typename Number>
double component_at(const char* bytes)
{
    Number number;
    std::memcpy(&number, bytes, sizeof number);
    return static_cast<double>(number);
}

/// A component as a number. Normalized integers are parts of their largest value (glTF 2.0, section 3.6.2.2).
double component(const char* bytes, int type, bool normalized)
{
    const auto scaled = [&](double number, double largest) {
        return normalized ? std::max(number / largest, -1.0) : number;
    };
    switch (type) {
    case TINYGLTF_COMPONENT_TYPE_FLOAT: return component_at<float>(bytes);
    case TINYGLTF_COMPONENT_TYPE_BYTE: return scaled(component_at<std::int8_t>(bytes), 127.0);
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE: return scaled(component_at<std::uint8_t>(bytes), 255.0);
    case TINYGLTF_COMPONENT_TYPE_SHORT: return scaled(component_at<std::int16_t>(bytes), 32767.0);
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT: return scaled(component_at<std::uint16_t>(bytes), 65535.0);
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT: return component_at<std::uint32_t>(bytes);
    default: throw InputError("the GLB file has positions or indices of a type that glTF does not allow");
    }
}

/// Positions (V, 3), or UVs (V, 2).
template <class Points>
Points points_of(const tinygltf::Model& model, int number)
{
    constexpr int axes = Points::ColsAtCompileTime;
    const std::string bytes = io::accessor_elements(model, number);
    const tinygltf::Accessor& accessor = model.accessors[static_cast<std::size_t>(number)];
    if (accessor.type != axes)  // TINYGLTF_TYPE_VEC3 is 3
        throw InputError(axes == 3 ? "the GLB file has positions without three coordinates"
                                   : "the GLB file has UVs without two coordinates");
    if (accessor.count >= io::most_elements) io::refuse_size();
    const std::size_t size = io::accessor_element_bytes(accessor), width = size / axes;
    Points points(static_cast<Eigen::Index>(accessor.count), axes);
    for (std::size_t k = 0; k < axes * accessor.count; ++k)
        points.data()[k] =
            component(bytes.data() + k / axes * size + k % axes * width, accessor.componentType, accessor.normalized);
    return points;
}

/// The vertices of corners or strips, one after the other.
std::vector<Index> indices_of(const tinygltf::Model& model, int number, std::size_t vertex_count)
{
    std::vector<Index> indices;
    if (number < 0) {
        for (std::size_t v = 0; v < vertex_count; ++v) indices.push_back(static_cast<Index>(v));
        return indices;
    }
    const std::string bytes = io::accessor_elements(model, number);
    const tinygltf::Accessor& accessor = model.accessors[static_cast<std::size_t>(number)];
    const std::size_t size = io::accessor_element_bytes(accessor);
    if (accessor.type != TINYGLTF_TYPE_SCALAR || accessor.componentType == TINYGLTF_COMPONENT_TYPE_FLOAT)
        throw InputError("the GLB file has indices that are no whole numbers");
    if (accessor.count >= io::most_elements) io::refuse_size();
    for (std::size_t i = 0; i < accessor.count; ++i) {
        const double index = component(bytes.data() + i * size, accessor.componentType, false);
        indices.push_back(index < io::most_elements ? static_cast<Index>(index) : -1);
    }
    return indices;
}

/// The corners of triangles from a list, a strip or a fan (glTF 2.0, section 3.7.2.1).
std::vector<Index> triangle_corners(const std::vector<Index>& indices, int mode)
{
    const std::size_t n = indices.size();
    if (mode == TINYGLTF_MODE_TRIANGLES) return {indices.begin(), indices.end() - static_cast<std::ptrdiff_t>(n % 3)};
    std::vector<Index> corners;
    for (std::size_t i = 0; i + 2 < n; ++i) {
        const bool strip = mode == TINYGLTF_MODE_TRIANGLE_STRIP;
        const std::size_t a = strip ? i : i + 1, b = strip ? i + 1 + i % 2 : i + 2, c = strip ? i + 2 - i % 2 : 0;
        corners.insert(corners.end(), {indices[a], indices[b], indices[c]});
    }
    return corners;
}

bool has_triangles(const tinygltf::Primitive& primitive)
{
    return primitive.mode >= TINYGLTF_MODE_TRIANGLES && primitive.mode <= TINYGLTF_MODE_TRIANGLE_FAN &&
           primitive.attributes.contains("POSITION");
}

/// Joins the primitives of a mesh at identical positions.
class MeshBuilder {
public:
    void add(const Vertices& points, const std::vector<Index>& corners)
    {
        const Index first = static_cast<Index>(coordinates_.size() / 3);
        if (coordinates_.size() / 3 + static_cast<std::size_t>(points.rows()) >= io::most_elements ||
            mesh_.corners.size() + corners.size() >= io::most_elements)
            io::refuse_size();
        coordinates_.insert(coordinates_.end(), points.data(), points.data() + points.size());
        for (const Index corner : corners) {
            const bool exists = corner >= 0 && corner < points.rows();
            const Index face = static_cast<Index>(mesh_.corners.size() / 3);
            if (!exists && (out_of_range_.empty() || out_of_range_.back() != face)) out_of_range_.push_back(face);
            mesh_.corners.push_back(exists ? first + corner : 0);
            if (mesh_.corners.size() % 3 == 0) mesh_.face_begin.push_back(static_cast<Index>(mesh_.corners.size()));
        }
    }

    PolygonMesh take_mesh(const std::string& name)
    {
        if (!out_of_range_.empty())
            throw InputError(name + ": faces name a vertex that does not exist (faces listed)", ElementKind::faces,
                             out_of_range_);
        mesh_.vertices =
            Eigen::Map<const Vertices>(coordinates_.data(), static_cast<Eigen::Index>(coordinates_.size() / 3), 3);
        std::vector<Index> not_finite;
        for (Index v = 0; v < static_cast<Index>(mesh_.vertices.rows()); ++v)
            if (!mesh_.vertices.row(v).allFinite()) not_finite.push_back(v);
        if (!not_finite.empty())
            throw InputError(name + ": vertices have a coordinate that is NaN or infinite (vertices listed)",
                             ElementKind::vertices, not_finite);
        const std::vector<Index> first = weld(mesh_.vertices, 0.0);
        for (Index& corner : mesh_.corners) corner = first[static_cast<std::size_t>(corner)];
        return std::move(mesh_);
    }

private:
    std::vector<double> coordinates_;
    std::vector<Index> out_of_range_;
    PolygonMesh mesh_;
};

/// Whether a face has three different vertices.
bool has_a_triangle(const PolygonMesh& mesh)
{
    for (std::size_t k = 0; k + 2 < mesh.corners.size(); k += 3) {
        const Index *corner = &mesh.corners[k], a = corner[0], b = corner[1], c = corner[2];
        if (a != b && b != c && c != a) return true;
    }
    return false;
}

GltfMesh mesh_of(const tinygltf::Model& model, std::size_t place)
{
    GltfMesh mesh{.place = place, .name = model.meshes[place].name};
    MeshBuilder builder;
    const auto& primitives = model.meshes[place].primitives;
    for (std::size_t k = 0; k < primitives.size(); ++k) {
        if (!has_triangles(primitives[k])) continue;
        const auto points = points_of<Vertices>(model, primitives[k].attributes.at("POSITION"));
        GltfPrimitive primitive{k, static_cast<Index>(points.rows()), {}};
        primitive.corner_vertex = triangle_corners(
            indices_of(model, primitives[k].indices, static_cast<std::size_t>(points.rows())), primitives[k].mode);
        if (primitive.corner_vertex.empty()) continue;
        builder.add(points, primitive.corner_vertex);
        mesh.primitives.push_back(std::move(primitive));
    }
    mesh.polygons = builder.take_mesh(mesh_name(mesh));
    return mesh;
}

}  // namespace

std::string mesh_name(const GltfMesh& mesh)
{
    return "mesh " + std::to_string(mesh.place) + (mesh.name.empty() ? "" : " (" + mesh.name + ")");
}

std::vector<PlanarPoints> read_gltf_uvs(std::string_view glb, int set)
{
    const tinygltf::Model model = io::read_gltf_model(glb);
    const std::string name = "TEXCOORD_" + std::to_string(set);
    std::vector<PlanarPoints> all;
    for (const GltfMesh& mesh : read_gltf_meshes(glb)) {
        PlanarPoints& uvs = all.emplace_back(static_cast<Eigen::Index>(mesh.polygons.corners.size()), 2);
        Eigen::Index corner = 0;
        for (const GltfPrimitive& primitive : mesh.primitives) {
            const auto& attributes = model.meshes[mesh.place].primitives[primitive.place].attributes;
            const auto found = attributes.find(name);
            if (found == attributes.end()) throw InputError(mesh_name(mesh) + " has no " + name);
            const auto points = points_of<PlanarPoints>(model, found->second);
            if (points.rows() != primitive.vertex_count)
                throw InputError(mesh_name(mesh) + " has another number of UVs than of vertices");
            for (const Index v : primitive.corner_vertex) uvs.row(corner++) << points(v, 0), 1.0 - points(v, 1);
        }
    }
    return all;
}

std::vector<std::vector<Index>> read_gltf_marks(std::string_view glb, CutAt at)
{
    const auto wanted = [at](CutAt kind) { return at == kind || at == CutAt::all; };
    const tinygltf::Model model = io::read_gltf_model(glb);
    std::vector<std::vector<Index>> all;
    // A mark is a normal, a material and a primitive, of which the kind asks for some. Corners with equal marks get one
    // number.
    for (const GltfMesh& mesh : read_gltf_meshes(glb)) {
        std::map<std::array<double, 5>, Index> numbers;
        std::vector<Index>& marks = all.emplace_back();
        for (const GltfPrimitive& primitive : mesh.primitives) {
            const tinygltf::Primitive& own = model.meshes[mesh.place].primitives[primitive.place];
            std::array<double, 5> mark{};
            if (wanted(CutAt::materials)) mark[3] = own.material;
            if (wanted(CutAt::groups)) mark[4] = static_cast<double>(primitive.place);
            Vertices normals(0, 3);
            if (const auto found = own.attributes.find("NORMAL");
                found != own.attributes.end() && wanted(CutAt::normals)) {
                normals = points_of<Vertices>(model, found->second);
                if (normals.rows() != primitive.vertex_count)
                    throw InputError(mesh_name(mesh) + " has another number of normals than of vertices");
            }
            for (const Index v : primitive.corner_vertex) {
                for (int k = 0; k < 3 && normals.rows() > 0; ++k)
                    mark[static_cast<std::size_t>(k)] = std::isfinite(normals(v, k)) ? normals(v, k) : 0.0;
                marks.push_back(numbers.emplace(mark, static_cast<Index>(numbers.size())).first->second);
            }
        }
    }
    return all;
}

std::vector<GltfMesh> read_gltf_meshes(std::string_view glb)
{
    const tinygltf::Model model = io::read_gltf_model(glb);
    std::vector<GltfMesh> meshes;
    for (std::size_t m = 0; m < model.meshes.size(); ++m)
        if (GltfMesh mesh = mesh_of(model, m); has_a_triangle(mesh.polygons)) meshes.push_back(std::move(mesh));
    if (meshes.empty()) throw InputError("the GLB file has no triangles with three different vertices");
    return meshes;
}

}  // namespace koebe
