#include "io/gltf_writer.h"

#include "core/errors.h"
#include "io/glb_container.h"
#include "io/gltf_model.h"
#include "io/refusals.h"

#include <cstring>
#include <limits>
#include <map>
#include <optional>
#include <utility>

namespace koebe {
namespace {

using Json = nlohmann::ordered_json;

constexpr const char* uv_name = "TEXCOORD_0";
constexpr std::size_t alignment = 4;

Json& member(Json& object, const char* name, Json fallback)
{
    if (!object.contains(name)) object[name] = std::move(fallback);
    return object[name];
}

/// The file's JSON, and data that are added behind its binary data.
class GlbEditor {
public:
    explicit GlbEditor(std::string_view glb) : file_(io::read_glb(glb)), model_(io::read_gltf_model(glb)) {}

    Json& primitive(std::size_t mesh, std::size_t place) { return file_.json["meshes"][mesh]["primitives"][place]; }

    /// An accessor of new data. @param stride of vertex attributes; 0: indices
    int add(const std::string& data, std::size_t stride, Json accessor)
    {
        Json view{{"buffer", buffer()}, {"byteOffset", begin_ + data_.size()}, {"byteLength", data.size()}};
        if (stride > 0) view["byteStride"] = stride;
        view["target"] = stride > 0 ? TINYGLTF_TARGET_ARRAY_BUFFER : TINYGLTF_TARGET_ELEMENT_ARRAY_BUFFER;
        data_.append(data).append((alignment - data.size() % alignment) % alignment, '\0');
        Json& views = member(file_.json, "bufferViews", Json::array());
        views.push_back(std::move(view));
        accessor["bufferView"] = views.size() - 1;
        file_.json["accessors"].push_back(std::move(accessor));
        return static_cast<int>(file_.json["accessors"].size()) - 1;
    }

    /// An accessor's elements, and copies of some behind them: a new accessor, otherwise as it was.
    int with_copies(int number, const std::vector<Index>& sources, std::size_t count)
    {
        const std::string elements = io::accessor_elements(model_, number, static_cast<std::ptrdiff_t>(count));
        const std::size_t size = io::accessor_element_bytes(model_.accessors[static_cast<std::size_t>(number)]);
        const std::size_t stride = (size + alignment - 1) / alignment * alignment;
        std::string data((count + sources.size()) * stride, '\0');
        const auto copy = [&](std::size_t from, std::size_t to) {
            std::memcpy(data.data() + to * stride, elements.data() + from * size, size);
        };
        for (std::size_t v = 0; v < count; ++v) copy(v, v);
        for (std::size_t k = 0; k < sources.size(); ++k) copy(static_cast<std::size_t>(sources[k]), count + k);
        Json accessor = file_.json["accessors"][static_cast<std::size_t>(number)];
        for (const char* old : {"byteOffset", "sparse"}) accessor.erase(old);
        accessor["count"] = count + sources.size();
        return add(data, stride, std::move(accessor));
    }

    std::string bytes()
    {
        if (!data_.empty())
            file_.json["buffers"][static_cast<std::size_t>(buffer())]["byteLength"] = begin_ + data_.size();
        return io::glb_bytes(file_, data_);
    }

private:
    /// The buffer of the binary chunk, which must be the first one and have no other place.
    int buffer()
    {
        Json& buffers = member(file_.json, "buffers", Json::array());
        if (buffers.empty()) buffers.push_back({{"byteLength", 0}});
        if (buffers[0].contains("uri"))
            throw InputError("the first buffer of the GLB file is text: save the file with binary data");
        if (!begun_) {
            // Padding of the chunk is no part of the buffer: new data begin behind it.
            begin_ = file_.binary.size();
            begun_ = true;
        }
        return 0;
    }

    io::GlbContainer file_;
    tinygltf::Model model_;
    std::string data_;
    std::size_t begin_ = 0;
    bool begun_ = false;
};

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
int add_indices(GlbEditor& editor, const std::vector<Index>& indices, std::size_t vertex_count)
{
    const bool narrow = vertex_count <= std::numeric_limits<std::uint16_t>::max();
    return editor.add(
        narrow ? packed_indices<std::uint16_t>(indices) : packed_indices<std::uint32_t>(indices), 0,
        {{"componentType", narrow ? TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT : TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT},
         {"count", indices.size()},
         {"type", "SCALAR"}});
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
                   {{"componentType", TINYGLTF_COMPONENT_TYPE_FLOAT}, {"count", count}, {"type", "VEC2"}});
    for (std::size_t k = 0; k < set.primitives.size(); ++k) {
        const GltfPrimitive& primitive = *set.primitives[k];
        const int indices = set.indices[k] == primitive.corner_vertex ? -1 : add_indices(editor, set.indices[k], count);
        Json& json = editor.primitive(mesh, primitive.place);
        json["attributes"] = attributes;
        if (json.contains("extensions")) json["extensions"].erase("KHR_draco_mesh_compression");  // of the old vertices
        if (!targets.empty()) json["targets"] = targets;
        if (indices < 0) continue;
        json["indices"] = indices;
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
