#include <fstream>  // which tinygltf forgets

#define TINYGLTF_IMPLEMENTATION
#include "io/gltf_model.h"

#include "core/errors.h"
#include "io/glb_container.h"
#include "io/refusals.h"

#include <algorithm>
#include <cstring>
#include <limits>
#include <stdexcept>
#include <tuple>
#include <vector>

namespace koebe::io {
namespace {

constexpr const char* compressions[] = {"KHR_draco_mesh_compression", "EXT_meshopt_compression"};
/// How the names of extensions begin that leave the shape of a mesh as it is, or that are read.
constexpr const char* harmless[] = {
    "KHR_materials_", "KHR_texture_",          "EXT_texture_", "MSFT_texture_",     "KHR_lights_",
    "EXT_lights_",    "KHR_animation",         "KHR_xmp",      "KHR_node_",         "EXT_mesh_gpu_",
    "KHR_audio",      "KHR_mesh_quantization", "MSFT_lod",     "EXT_mesh_features", "EXT_structural_metadata"};

template <typename Item>
const Item& item_at(const std::vector<Item>& items, std::ptrdiff_t place, const char* name)
{
    if (place < 0 || place >= static_cast<std::ptrdiff_t>(items.size()))
        throw InputError("the GLB file names " + std::string(name) + ' ' + std::to_string(place) + ", and has " +
                         std::to_string(items.size()));
    return items[static_cast<std::size_t>(place)];
}

/// `count` pieces of `size` bytes, each `stride` after the last, from `offset` on in a buffer view.
struct Pieces {
    std::size_t offset, size, stride, count;
};

/// The bytes of a buffer view from an offset on, at least as many as the pieces take.
const unsigned char* checked_bytes(const tinygltf::Model& model, std::ptrdiff_t view_number, const Pieces& pieces)
{
    const auto& view = item_at(model.bufferViews, view_number, "buffer view");
    const auto& data = item_at(model.buffers, view.buffer, "buffer").data;
    const auto fits = [](std::size_t offset, std::size_t length, std::size_t whole) {
        return offset <= whole && length <= whole - offset;
    };
    const bool none = pieces.count == 0;
    const bool finite = none || (pieces.count - 1) <= (std::numeric_limits<std::size_t>::max() / 2) / pieces.stride;
    const std::size_t length = none ? 0 : finite ? pieces.stride * (pieces.count - 1) + pieces.size : 0;
    if (!finite || !fits(view.byteOffset, view.byteLength, data.size()) ||
        !fits(pieces.offset, length, view.byteLength))
        throw InputError("buffer view " + std::to_string(view_number) + " of the GLB file is too short");
    return data.data() + view.byteOffset + pieces.offset;
}

void copy_pieces(const unsigned char* from, const Pieces& pieces, char* to)
{
    for (std::size_t i = 0; i < pieces.count; ++i)
        std::memcpy(to + i * pieces.size, from + i * pieces.stride, pieces.size);
}

std::size_t component_bytes(int type)
{
    const int bytes = tinygltf::GetComponentSizeInBytes(static_cast<std::uint32_t>(type));
    if (bytes <= 0) throw InputError("the GLB file has components of an unknown type");
    return static_cast<std::size_t>(bytes);
}

void put_sparse(const tinygltf::Model& model, const tinygltf::Accessor& accessor, std::string& elements)
{
    const std::size_t size = accessor_element_bytes(accessor),
                      count = static_cast<std::size_t>(std::max(accessor.sparse.count, 0));
    const auto& [indices, values] = std::tie(accessor.sparse.indices, accessor.sparse.values);
    const std::size_t width = component_bytes(indices.componentType);
    const unsigned char* index =
        checked_bytes(model, indices.bufferView, {static_cast<std::size_t>(indices.byteOffset), width, width, count});
    const unsigned char* value =
        checked_bytes(model, values.bufferView, {static_cast<std::size_t>(values.byteOffset), size, size, count});
    for (std::size_t i = 0; i < count; ++i) {
        std::uint32_t place = 0;
        std::memcpy(&place, index + i * width, std::min(width, sizeof place));
        if (place >= accessor.count)
            throw InputError("a sparse accessor of the GLB file names an element that it lacks");
        std::memcpy(elements.data() + place * size, value + i * size, size);
    }
}

void refuse_other_files(const nlohmann::ordered_json& json)
{
    const auto buffers = json.find("buffers");
    if (buffers == json.end() || !buffers->is_array()) return;
    for (const auto& buffer : *buffers) {
        const auto uri = buffer.is_object() ? buffer.find("uri") : buffer.end();
        if (uri != buffer.end() && !(uri->is_string() && uri->get_ref<const std::string&>().starts_with("data:")))
            throw InputError("the GLB file has its data in another file: save it with all data inside");
    }
}

/// A reader has to refuse a file that requires what it does not know (glTF 2.0, 3.12).
void refuse_unknown_extensions(const tinygltf::Model& model)
{
    for (const std::string& extension : model.extensionsRequired) {
        if (std::ranges::find(compressions, extension) != std::end(compressions))
            throw InputError("the GLB file is compressed (" + extension + "): save it without compression");
        if (std::ranges::none_of(harmless, [&](const char* start) { return extension.starts_with(start); }))
            throw InputError("the GLB file requires the extension " + extension + ", which may change its shapes");
    }
}

}  // namespace

tinygltf::Model read_gltf_model(std::string_view glb)
{
    const GlbContainer container = read_glb(glb);  // whose lengths tinygltf does not check
    refuse_other_files(container.json);
    tinygltf::TinyGLTF reader;
    reader.SetImageLoader([](auto...) { return true; }, nullptr);
    tinygltf::Model model;
    std::string error, warning;
    bool read = false;
    try {
        read = reader.LoadBinaryFromMemory(&model, &error, &warning, reinterpret_cast<const unsigned char*>(glb.data()),
                                           static_cast<unsigned>(std::min<std::size_t>(glb.size(), 0xFFFFFFFF)));
    } catch (const nlohmann::json::exception& thrown) {
        error = thrown.what();
    } catch (const std::logic_error&) {  // it looks for the first byte of empty data
        error = "empty data";
    }
    if (!read) throw InputError("the GLB file is damaged: " + error.substr(0, error.find('\n')));
    refuse_unknown_extensions(model);
    return model;
}

std::size_t accessor_element_bytes(const tinygltf::Accessor& accessor)
{
    const int components = tinygltf::GetNumComponentsInType(static_cast<std::uint32_t>(accessor.type));
    if (components <= 0) throw InputError("the GLB file has an accessor of an unknown type");
    return static_cast<std::size_t>(components) * component_bytes(accessor.componentType);
}

std::string accessor_elements(const tinygltf::Model& model, int number, std::ptrdiff_t count)
{
    const tinygltf::Accessor& accessor = item_at(model.accessors, number, "accessor");
    const std::size_t size = accessor_element_bytes(accessor);
    if (count >= 0 && accessor.count != static_cast<std::size_t>(count))
        throw InputError("accessor " + std::to_string(number) + " of the GLB file has " +
                         std::to_string(accessor.count) + " elements instead of " + std::to_string(count));
    if (count < 0 && accessor.bufferView < 0) {
        // Zeros, of which the sparse elements are others. A header could ask for any amount of memory.
        if (!accessor.sparse.isSparse)
            throw InputError("accessor " + std::to_string(number) + " of the GLB file has no data");
        std::size_t bytes = 0;
        for (const tinygltf::Buffer& buffer : model.buffers) bytes += buffer.data.size();
        require_count_fits(accessor.count, "accessor", bytes);
    }
    std::string elements;
    if (accessor.bufferView >= 0) {
        const std::size_t stride = item_at(model.bufferViews, accessor.bufferView, "buffer view").byteStride;
        if (stride != 0 && stride < size)
            throw InputError("the elements of accessor " + std::to_string(number) +
                             " of the GLB file overlap: its byte stride is too small");
        const Pieces pieces{accessor.byteOffset, size, stride == 0 ? size : stride, accessor.count};
        const unsigned char* bytes = checked_bytes(model, accessor.bufferView, pieces);
        elements.resize(accessor.count * size);
        copy_pieces(bytes, pieces, elements.data());
    } else {
        elements.resize(accessor.count * size);
    }
    if (accessor.sparse.isSparse) put_sparse(model, accessor, elements);
    return elements;
}

}  // namespace koebe::io
