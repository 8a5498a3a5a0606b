#include "io/glb_container.h"

#include "core/errors.h"

#include <cstdint>
#include <cstring>
#include <limits>

namespace koebe::io {
namespace {

constexpr std::uint32_t glb_magic = 0x46546C67, json_chunk = 0x4E4F534A, binary_chunk = 0x004E4942;  // glTF, JSON, BIN
constexpr std::size_t header_bytes = 12, chunk_header_bytes = 8;
constexpr int deepest = 256;  // writing JSON takes stack by its depth

std::uint32_t glb_number(std::string_view bytes, std::size_t place)
{
    if (place + 4 > bytes.size()) throw InputError("the GLB file ends early");
    std::uint32_t number = 0;
    for (int k = 3; k >= 0; --k) number = number << 8 | static_cast<unsigned char>(bytes[place + k]);
    return number;
}

void append_number(std::string& bytes, std::size_t number)
{
    for (int k = 0; k < 4; ++k) bytes += static_cast<char>(number >> 8 * k & 0xFF);
}

void append_chunk(std::string& bytes, std::uint32_t type, std::string_view first, std::string_view second, char padding)
{
    const std::size_t length = first.size() + second.size(), padded = (length + 3) / 4 * 4;
    append_number(bytes, padded);
    append_number(bytes, type);
    bytes.append(first).append(second).append(padded - length, padding);
}

/// Takes the first chunk if it has this type.
std::string_view take_chunk(std::string_view& chunks, std::uint32_t type)
{
    if (chunks.empty() || glb_number(chunks, 4) != type) return {};
    const std::size_t length = glb_number(chunks, 0);
    if (length % 4 != 0) throw InputError("a chunk of the GLB file has a length that is no multiple of 4");
    if (length > chunks.size() - chunk_header_bytes) throw InputError("the GLB file ends early");
    const std::string_view chunk = chunks.substr(chunk_header_bytes, length);
    chunks.remove_prefix(chunk_header_bytes + length);
    return chunk;
}

nlohmann::ordered_json parsed_json(std::string_view text)
{
    try {
        return nlohmann::ordered_json::parse(text, [](int depth, auto, const auto&) {
            if (depth > deepest) throw InputError("the JSON of the GLB file is nested too deeply");
            return true;
        });
    } catch (const nlohmann::json::exception& error) {
        throw InputError(std::string("the JSON of the GLB file is damaged: ") + error.what());
    }
}

}  // namespace

GlbContainer read_glb(std::string_view bytes)
{
    if (bytes.size() < header_bytes || glb_number(bytes, 0) != glb_magic) throw InputError("this is no GLB file");
    if (const std::uint32_t version = glb_number(bytes, 4); version != 2)
        throw InputError("version " + std::to_string(version) + " of GLB cannot be read, only version 2");
    const std::size_t length = glb_number(bytes, 8);
    if (length < header_bytes || length > bytes.size()) throw InputError("the GLB file ends early");
    std::string_view chunks = bytes.substr(header_bytes, length - header_bytes);
    const std::string_view text = take_chunk(chunks, json_chunk);
    if (text.empty()) throw InputError("the GLB file does not begin with JSON");
    const std::string_view binary = take_chunk(chunks, binary_chunk);
    GlbContainer container{parsed_json(text), binary, chunks};
    if (!container.json.is_object()) throw InputError("the JSON of the GLB file is no object");
    return container;
}

std::string glb_bytes(const GlbContainer& container, std::string_view more)
{
    const std::string text = container.json.dump();
    std::string chunks;
    append_chunk(chunks, json_chunk, text, {}, ' ');
    if (container.binary.size() + more.size() > 0) append_chunk(chunks, binary_chunk, container.binary, more, '\0');
    chunks += container.rest;
    if (chunks.size() + header_bytes > std::numeric_limits<std::uint32_t>::max())
        throw InputError("the GLB file would have more than 4 GiB");
    std::string bytes;
    append_number(bytes, glb_magic);
    append_number(bytes, 2);
    append_number(bytes, chunks.size() + header_bytes);
    return bytes += chunks;
}

}  // namespace koebe::io
