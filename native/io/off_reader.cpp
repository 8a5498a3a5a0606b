// Object File Format, text and binary [Geomview manual, section 4.2.5].
#include "io/format_readers.h"

#include "core/errors.h"
#include "io/byte_cursor.h"
#include "io/text_scanner.h"

#include <bit>
#include <cstdint>
#include <string>

namespace koebe::io {
namespace {

/// What the header's first word, [ST][C][N][4][n]OFF, says of each vertex beyond its position.
struct Header {
    bool texture = false, color = false, normal = false, binary = false;
};

/// Reads the optional first word. A file may start with its counts.
Header read_header(TextScanner& text)
{
    Header header;
    if (!text.seek_word()) text.fail("a header with OFF");
    const TextScanner before = text;
    std::string_view word = text.word();
    const auto take = [&word](std::string_view prefix) {
        const bool found = word.starts_with(prefix);
        if (found) word.remove_prefix(prefix.size());
        return found;
    };
    if (word.find_first_not_of("0123456789") == std::string_view::npos) {
        text = before;
        return header;
    }
    header.texture = take("ST");
    header.color = take("C");
    header.normal = take("N");
    if (word != "OFF") {
        text = before;
        text.fail("a header with OFF (4OFF and nOFF are not supported)");
    }
    const TextScanner after = text;
    header.binary = text.word() == "BINARY";
    if (!header.binary) text = after;
    return header;
}

/// No count can be larger than what the bytes that follow could hold.
std::size_t read_count(TextScanner& text, const char* what)
{
    const long long count = text.seek_word() ? text.integer() : -1;
    if (count < 0 || static_cast<std::size_t>(count) > text.bytes_left())
        throw InputError("the header's number of " + std::string(what) + " does not fit the file");
    return static_cast<std::size_t>(count);
}

PolygonMesh read_text(TextScanner text)
{
    const std::size_t vertex_count = read_count(text, "vertices");
    const std::size_t face_count = read_count(text, "faces");
    text.skip_line();  // the number of edges, which no one keeps right
    MeshBuilder mesh(vertex_count, face_count);
    for (std::size_t v = 0; v < vertex_count; ++v, text.skip_line()) {
        if (!text.seek_word()) text.fail("vertex " + std::to_string(v));
        const double x = text.number(), y = text.number(), z = text.number();
        mesh.add_vertex({x, y, z});
    }
    for (std::size_t f = 0; f < face_count; ++f, text.skip_line()) {
        if (!text.seek_word()) text.fail("face " + std::to_string(f));
        for (long long left = text.integer(); left > 0; --left) mesh.add_corner(to_index(text.integer()));
        mesh.end_face();
    }
    return mesh.finish();
}

/// @param face_colors as Geomview writes: each face followed by the number of its colour's components and these
PolygonMesh read_binary(ByteCursor bytes, const Header& header, bool face_colors)
{
    const auto vertex_count = bytes.read<std::uint32_t>();
    const auto face_count = bytes.read<std::uint32_t>();
    bytes.read<std::uint32_t>();  // edges
    if (vertex_count > bytes.bytes_left() / 12 || face_count > bytes.bytes_left() / 4)
        throw InputError("the header's numbers of vertices and faces do not fit the file");
    const std::size_t extra = 4 * (3 * header.normal + 4 * header.color + 2 * header.texture);
    MeshBuilder mesh(vertex_count, face_count);
    for (std::uint32_t v = 0; v < vertex_count; ++v) {
        const double x = bytes.read<float>(), y = bytes.read<float>(), z = bytes.read<float>();
        mesh.add_vertex({x, y, z});
        bytes.skip(extra);
    }
    for (std::uint32_t f = 0; f < face_count; ++f) {
        for (auto left = bytes.read<std::uint32_t>(); left > 0; --left)
            mesh.add_corner(to_index(bytes.read<std::int32_t>()));
        mesh.end_face();
        if (face_colors) bytes.skip(std::size_t{4} * bytes.read<std::uint32_t>());
    }
    if (bytes.bytes_left() > 0) throw InputError("the file goes on after its last face");
    return mesh.finish();
}

/// Geomview's layout first, then the one of OpenMesh and pmp-library; the file's length decides.
PolygonMesh read_binary(std::string_view bytes, std::size_t position, const Header& header)
{
    try {
        return read_binary(ByteCursor(bytes, position, std::endian::big), header, true);
    } catch (const InputError&) {
        return read_binary(ByteCursor(bytes, position, std::endian::little), header, false);
    }
}

}  // namespace

PolygonMesh read_off(std::string_view bytes)
{
    TextScanner text(bytes);
    const Header header = read_header(text);
    if (!header.binary) return read_text(text);
    text.skip_line();
    return read_binary(bytes, text.position(), header);
}

}  // namespace koebe::io
