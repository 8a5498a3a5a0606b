#include "io/gltf_materials.h"

#include "core/counted.h"

#include <algorithm>
#include <string>
#include <string_view>

namespace koebe::io {
namespace {

using Json = nlohmann::ordered_json;

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

}  // namespace

int tangent_set(Json& file, const Json& primitive)
{
    if (!primitive.contains("material")) return 0;
    const Json* const material = material_at(file, primitive["material"].get<std::size_t>());
    return material != nullptr && material->contains("normalTexture") ? set_of((*material)["normalTexture"]) : 0;
}

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

}  // namespace koebe::io
