#include "io/gltf_writer.h"

#include "core/counted.h"
#include "core/errors.h"
#include "core/warning.h"
#include "io/glb_editor.h"
#include "io/refusals.h"

#include <algorithm>
#include <cstddef>
#include <iterator>
#include <limits>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace koebe {
namespace {

using io::GlbEditor;
using Json = GlbEditor::Json;

/// Primitives by the places of their mesh and in it.
using GltfPlaces = std::set<std::pair<std::size_t, std::size_t>>;

constexpr const char* transform_name = "KHR_texture_transform";

/// The transform of a texture in a material, or null.
const Json* transform_of(const Json& texture)
{
    const auto extensions = texture.find("extensions");
    if (extensions == texture.end() || !extensions->contains(transform_name)) return nullptr;
    return &(*extensions)[transform_name];
}

/// The set of UVs of a texture in a material, which a transform may replace.
int set_of(const Json& texture)
{
    const int own = texture.value("texCoord", 0);
    const Json* const transform = transform_of(texture);
    return transform == nullptr ? own : transform->value("texCoord", own);
}

/// Visits the textures of a material, in extensions too.
void visit_textures(Json& json, const auto& visit)
{
    for (auto& [name, value] : json.items()) {
        if (!value.is_structured()) continue;
        if (value.is_object() && value.contains("index") && std::string_view(name).ends_with("Texture")) visit(value);
        visit_textures(value, visit);
    }
}

/// The materials of a primitive: its own, and those of its variants.
std::set<std::size_t> materials_of(const Json& primitive)
{
    std::set<std::size_t> materials;
    if (primitive.contains("material")) materials.insert(primitive["material"].get<std::size_t>());
    const Json extensions = primitive.value("extensions", Json::object());
    const Json variants = extensions.value("KHR_materials_variants", Json::object());
    for (const Json& mapping : variants.value("mappings", Json::array()))
        materials.insert(mapping.at("material").get<std::size_t>());
    return materials;
}

/// The material of this number, or null.
Json* material_at(Json& file, std::size_t number)
{
    const auto materials = file.find("materials");
    return materials != file.end() && number < materials->size() ? &(*materials)[number] : nullptr;
}

/// The pointers of all animations (KHR_animation_pointer) in one text.
std::string animated(const Json& file)
{
    std::string pointers;
    for (const Json& animation : file.value("animations", Json::array()))
        for (const Json& channel : animation.value("channels", Json::array())) {
            const Json extensions = channel.value("target", Json::object()).value("extensions", Json::object());
            pointers += extensions.value("KHR_animation_pointer", Json::object()).value("pointer", "") + '\n';
        }
    return pointers;
}

void take_off(Json& texture)
{
    texture["texCoord"] = set_of(texture);
    if (texture["texCoord"] == 0) texture.erase("texCoord");
    texture["extensions"].erase(transform_name);
    if (texture["extensions"].empty()) texture.erase("extensions");
}

/// The set of UVs along which the tangents of a primitive run: that of its material's normal texture (glTF 2.0, section
/// 3.7.2.1).
int tangent_set(Json& file, const Json& primitive)
{
    if (!primitive.contains("material")) return 0;
    const Json* const material = material_at(file, primitive["material"].get<std::size_t>());
    return material != nullptr && material->contains("normalTexture") ? set_of((*material)["normalTexture"]) : 0;
}

/// Takes KHR_texture_transform off the textures that lie in a set of UVs, if only these primitives have the material
/// and nothing moves the transform. Else a texture would show a part of itself on the new UVs.
/// @return warnings about the materials, changed or not: kind replaced_uvs
std::vector<Warning> take_transforms_off(Json& file, const GltfPlaces& primitives, int set)
{
    // Materials of the mapped primitives, and those that others share.
    std::set<std::size_t> own, of_others;
    for (std::size_t m = 0; m < file["meshes"].size(); ++m) {
        const Json of_mesh = file["meshes"][m].value("primitives", Json::array());
        for (std::size_t k = 0; k < of_mesh.size(); ++k)
            for (const std::size_t material : materials_of(of_mesh[k]))
                (primitives.contains({m, k}) ? own : of_others).insert(material);
    }
    // A transform is taken off if no other primitive and no animation needs it.
    const std::string pointers = animated(file);
    std::size_t taken = 0, left = 0;
    for (const std::size_t material : own) {
        const std::string place = "/materials/" + std::to_string(material) + '/';
        const bool is_moved =
            pointers.find(place) != std::string::npos && pointers.find(transform_name) != std::string::npos;
        const bool may_change = !of_others.contains(material) && !is_moved;
        Json* const json = material_at(file, material);
        if (json == nullptr) continue;
        bool found = false;
        visit_textures(*json, [&](Json& texture) {
            if (transform_of(texture) == nullptr || set_of(texture) != set) return;
            found = true;
            if (may_change) take_off(texture);
        });
        if (found) ++(may_change ? taken : left);
    }
    std::vector<Warning> warnings;
    const std::string transforms = std::string(" (") + transform_name + ")";
    if (taken > 0)
        warnings.push_back({WarningKind::replaced_uvs, counted(taken, "material") +
                                                           " had textures moved on the old texture coordinates" +
                                                           transforms + ": this is taken off"});
    if (left > 0)
        warnings.push_back({WarningKind::replaced_uvs,
                            counted(left, "material") + " still move textures on the new texture coordinates" +
                                transforms + ", as other meshes or animations need it: images show in part there"});
    return warnings;
}

constexpr const char* tangents = "TANGENT";

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

/// Writes the UVs of one set into the file.
class UvWriter {
public:
    UvWriter(std::string_view glb, int set) : editor_(glb), set_(set), name_("TEXCOORD_" + std::to_string(set)) {}

    void add_mesh(const GltfMesh& mesh, const std::vector<GltfPoint>& uvs)
    {
        std::map<std::string, VertexSet> sets;  // by the attributes in JSON, and whether tangents go
        std::size_t corner = 0;
        for (const GltfPrimitive& primitive : mesh.primitives) {
            const Json& json = editor_.primitive(mesh.place, primitive.place);
            require_lower_sets(mesh, json["attributes"]);
            const std::string key =
                Json::array({json["attributes"], json.value("targets", Json::array()), loses_tangents(json)}).dump();
            VertexSet& set = sets.try_emplace(key, VertexSet{SharedVertices(primitive.vertex_count), {}}).first->second;
            set.primitives.push_back(&primitive);
            places_.insert({mesh.place, primitive.place});
            std::vector<Index>& indices = set.indices.emplace_back();
            for (const Index vertex : primitive.corner_vertex)
                indices.push_back(set.vertices.with_uv(vertex, uvs[corner++]));
        }
        for (const auto& [key, set] : sets) write_set(mesh.place, set);
    }

    GlbWithUvs finish()
    {
        std::vector<Warning> warnings;
        if (replaced_)
            warnings.push_back({WarningKind::replaced_uvs,
                                "the file's texture coordinates (" + name_ + ") are replaced by the map's"});
        if (without_tangents_ > 0)
            warnings.push_back({WarningKind::not_kept,
                                counted(without_tangents_, "primitive") +
                                    " had tangents of the old texture coordinates: they are left out, and programs "
                                    "compute new ones (MikkTSpace)"});
        std::ranges::move(take_transforms_off(editor_.json(), places_, set_), std::back_inserter(warnings));
        return {editor_.bytes(), std::move(warnings)};
    }

private:
    /// Sets of UVs are numbered without gaps (glTF 2.0, section 3.7.2.1).
    void require_lower_sets(const GltfMesh& mesh, const Json& attributes) const
    {
        for (int lower = 0; lower < set_; ++lower)
            if (const std::string name = "TEXCOORD_" + std::to_string(lower); !attributes.contains(name))
                throw InputError(mesh_name(mesh) + " has no " + name + ", so that it cannot have " + name_);
    }

    bool loses_tangents(const Json& primitive)
    {
        return primitive["attributes"].contains(tangents) && tangent_set(editor_.json(), primitive) == set_;
    }

    /// Replaces the accessors of attributes by those with copies.
    void extend(Json& attributes, const SharedVertices& vertices)
    {
        for (auto& [name, accessor] : attributes.items())
            if (name != name_)
                accessor = editor_.with_copies(accessor.get<int>(), vertices.sources(), vertices.count());
    }

    void write_set(std::size_t mesh, const VertexSet& set)
    {
        Json& first = editor_.primitive(mesh, set.primitives.front()->place);
        Json attributes = first["attributes"], targets = first.value("targets", Json::array());
        const int old = attributes.value(name_, GlbEditor::no_accessor);
        replaced_ |= old != GlbEditor::no_accessor;
        // What the new UVs leave without meaning.
        const bool tangents_go = loses_tangents(first);
        if (tangents_go) without_tangents_ += set.primitives.size();
        if (tangents_go) attributes.erase(tangents);
        for (Json& target : targets) {
            target.erase(name_);  // it moves the old ones
            if (tangents_go) target.erase(tangents);
        }
        // Vertices with several UVs.
        if (!set.vertices.sources().empty()) {
            extend(attributes, set.vertices);
            for (Json& target : targets) extend(target, set.vertices);
        }
        const std::size_t count = set.vertices.count() + set.vertices.sources().size();
        attributes[name_] =
            editor_.add(set.vertices.uv_data(), sizeof(GltfPoint),
                        {{"componentType", TINYGLTF_COMPONENT_TYPE_FLOAT}, {"count", count}, {"type", "VEC2"}}, old);
        for (std::size_t k = 0; k < set.primitives.size(); ++k) {
            const GltfPrimitive& primitive = *set.primitives[k];
            Json& json = editor_.primitive(mesh, primitive.place);
            json["attributes"] = attributes;
            if (json.contains("extensions"))
                json["extensions"].erase("KHR_draco_mesh_compression");  // of the old vertices
            if (!targets.empty()) json["targets"] = targets;
            if (set.indices[k] == primitive.corner_vertex) continue;
            json["indices"] =
                add_indices(editor_, set.indices[k], count, json.value("indices", GlbEditor::no_accessor));
            json.erase("mode");  // triangles
        }
    }

    GlbEditor editor_;
    int set_;
    std::string name_;
    GltfPlaces places_;  // of the primitives with new UVs
    bool replaced_ = false;
    std::size_t without_tangents_ = 0;
};

}  // namespace

std::vector<GltfPoint> gltf_points(const PlanarPoints& uv)
{
    std::vector<GltfPoint> points;
    for (Eigen::Index k = 0; k < uv.rows(); ++k)
        points.push_back({static_cast<float>(uv(k, 0)), static_cast<float>(1.0 - uv(k, 1))});
    return points;
}

GlbWithUvs glb_with_corner_uvs(std::string_view glb, const std::vector<GltfMesh>& meshes,
                               const std::vector<std::vector<GltfPoint>>& uvs, int set)
try {
    UvWriter writer(glb, set);
    for (std::size_t m = 0; m < meshes.size(); ++m) writer.add_mesh(meshes[m], uvs[m]);
    return writer.finish();
} catch (const nlohmann::json::exception& error) {
    throw InputError(std::string("the JSON of the GLB file is damaged: ") + error.what());
}

}  // namespace koebe
