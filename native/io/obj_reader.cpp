// Wavefront OBJ: v and f, all else is passed over.
#include "io/format_readers.h"
#include "io/text_scanner.h"

#include "core/errors.h"

namespace koebe::io {
namespace {

/// v, v/vt, v//vn or v/vt/vn; counted from 1, or from the last vertex so far if negative.
Index read_corner(TextScanner& text, std::size_t vertices_so_far)
{
    const long long filed = text.integer();
    text.skip_word();
    return to_index(filed < 0 ? static_cast<long long>(vertices_so_far) + filed : filed - 1);
}

}  // namespace

PolygonMesh read_obj(std::string_view bytes)
{
    TextScanner text(bytes);
    MeshBuilder mesh;
    for (; text.seek_word(); text.skip_line()) {
        const std::string_view keyword = text.word();
        if (keyword == "v") {
            const double x = text.number(), y = text.number(), z = text.number();
            mesh.add_vertex({x, y, z});
        } else if (keyword == "f") {
            while (!text.at_line_end()) mesh.add_corner(read_corner(text, mesh.vertex_count()));
            mesh.end_face();
        }
    }
    return mesh.finish();
}

}  // namespace koebe::io
