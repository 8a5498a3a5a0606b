#include "io/gltf_writer.h"

#include "core/errors.h"
#include "io/glb_editor.h"
#include "io/refusals.h"

#include <limits>
#include <map>
#include <optional>
#include <utility>

namespace koebe {
namespace {

using io::GlbEditor;
using Json = GlbEditor::Json;

constexpr const char* uv_name = "TEXCOORD_0";

/// Vertices of primitives that share them, with the UVs that they got so far.
class SharedVertices {
public:
    explicit SharedVertices(Index count) : uvs_(static_cast<std::size_t>(count)) {}

    /// The vertex that stands for another one with these UVs: itself, or a copy.
    Index with_uv(Index vertex, const GltfPoint& uv)
    {
        std::optional<GltfPoint>& own = uvs_[static_cast<std::size_t>(vertex)];
        if (!own) own = uv;
        if (*own == uv) return vertex;
        const auto [found, is_new] =
            copies_.try_emplace({vertex, uv}, static_cast<Index>(uvs_.size() + sources_.size()));
        if (is_new) {
            if (uvs_.size() + sources_.size() + 1 >= io::most_elements) io::refuse_size();
            sources_.push_back(vertex);
            copied_.push_back(uv);
        }
        return found->second;
    }

    std::size_t count() const { return uvs_.size(); }
    /// The vertex of each copy.
    const std::vector<Index>& sources() const { return sources_; }

    std::string uv_data() const
    {
        std::string data;
        const auto put = [&](const GltfPoint& uv) { data.append(reinterpret_cast<const char*>(&uv), sizeof uv); };
        for (const auto& uv : uvs_) put(uv.value_or(GltfPoint{0.0F, 0.0F}));
        for (const GltfPoint& uv : copied_) put(uv);
        return data;
    }

private:
    std::vector<std::optional<GltfPoint>> uvs_;
    std::map<std::pair<Index, GltfPoint>, Index> copies_;
    std::vector<Index> sources_;
    std::vector<GltfPoint> copied_;
};

template <typename Number>
std::string packed_indices(const std::vector<Index>& indices)
{
    std::string data;
    for (const Index index : indices) {
        const Number number = static_cast<Number>(index);
        data.append(reinterpret_cast<const char*>(&number), sizeof number);
    }
    return data;
}

/// Indices of triangles, as short as the vertices allow: the largest number of a type is no vertex.
int add_indices(GlbEditor& editor, const std::vector<Index>& indices, std::size_t vertex_count, int replaced)
{
    const bool narrow = vertex_count <= std::numeric_limits<std::uint16_t>::max();
    return editor.add(
        narrow ? packed_indices<std::uint16_t>(indices) : packed_indices<std::uint32_t>(indices), 0,
        {{"componentType", narrow ? TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT : TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT},
         {"count", indices.size()},
         {"type", "SCALAR"}},
        replaced);
}

/// Primitives with the same vertices: new attributes, and what stands for them.
struct VertexSet {
    SharedVertices vertices;
    std::vector<const GltfPrimitive*> primitives;
    std::vector<std::vector<Index>> indices = {};  ///< of each primitive, after splitting
};

/// Replaces the accessors of attributes by those with copies.
void extend(GlbEditor& editor, Json& attributes, const SharedVertices& vertices)
{
    for (auto& [name, accessor] : attributes.items())
        if (name != uv_name) accessor = editor.with_copies(accessor.get<int>(), vertices.sources(), vertices.count());
}

void write_set(GlbEditor& editor, std::size_t mesh, const VertexSet& set)
{
    Json& first = editor.primitive(mesh, set.primitives.front()->place);
    Json attributes = first["attributes"], targets = first.value("targets", Json::array());
    const bool split = !set.vertices.sources().empty();
    if (split) {
        extend(editor, attributes, set.vertices);
        for (Json& target : targets) extend(editor, target, set.vertices);
    }
    for (Json& target : targets) target.erase(uv_name);  // it moves the old ones
    const std::size_t count = set.vertices.count() + set.vertices.sources().size();
    attributes[uv_name] =
        editor.add(set.vertices.uv_data(), sizeof(GltfPoint),
                   {{"componentType", TINYGLTF_COMPONENT_TYPE_FLOAT}, {"count", count}, {"type", "VEC2"}},
                   attributes.value(uv_name, GlbEditor::no_accessor));
    for (std::size_t k = 0; k < set.primitives.size(); ++k) {
        const GltfPrimitive& primitive = *set.primitives[k];
        Json& json = editor.primitive(mesh, primitive.place);
        json["attributes"] = attributes;
        if (json.contains("extensions")) json["extensions"].erase("KHR_draco_mesh_compression");  // of the old vertices
        if (!targets.empty()) json["targets"] = targets;
        if (set.indices[k] == primitive.corner_vertex) continue;
        json["indices"] = add_indices(editor, set.indices[k], count, json.value("indices", GlbEditor::no_accessor));
        json.erase("mode");  // triangles
    }
}

}  // namespace

std::vector<GltfPoint> gltf_points(const PlanarPoints& uv)
{
    std::vector<GltfPoint> points;
    for (Eigen::Index k = 0; k < uv.rows(); ++k)
        points.push_back({static_cast<float>(uv(k, 0)), static_cast<float>(1.0 - uv(k, 1))});
    return points;
}

std::string glb_with_corner_uvs(std::string_view glb, const std::vector<GltfMesh>& meshes,
                                const std::vector<std::vector<GltfPoint>>& uvs)
try {
    GlbEditor editor(glb);
    for (std::size_t m = 0; m < meshes.size(); ++m) {
        std::map<std::string, VertexSet> sets;  // by the attributes in JSON
        std::size_t corner = 0;
        for (const GltfPrimitive& primitive : meshes[m].primitives) {
            const Json& json = editor.primitive(meshes[m].place, primitive.place);
            const std::string key = Json::array({json["attributes"], json.value("targets", Json::array())}).dump();
            VertexSet& set = sets.try_emplace(key, VertexSet{SharedVertices(primitive.vertex_count), {}}).first->second;
            set.primitives.push_back(&primitive);
            std::vector<Index>& indices = set.indices.emplace_back();
            for (const Index vertex : primitive.corner_vertex)
                indices.push_back(set.vertices.with_uv(vertex, uvs[m][corner++]));
        }
        for (const auto& [key, set] : sets) write_set(editor, meshes[m].place, set);
    }
    return editor.bytes();
} catch (const nlohmann::json::exception& error) {
    throw InputError(std::string("the JSON of the GLB file is damaged: ") + error.what());
}

}  // namespace koebe
