#include "io/mesh_reader.h"

#include "core/errors.h"
#include "execution/thread_share.h"
#include "files/extension.h"
#include "files/file_bytes.h"
#include "io/mesh_formats.h"

#include <algorithm>
#include <string>
#include <vector>

namespace koebe {
namespace {

constexpr std::string_view byte_order_mark = "\xEF\xBB\xBF";

/// @throws InputError the format is unknown
const MeshFormat& known_format(const std::string& extension)
{
    if (const MeshFormat* const format = io::mesh_format(extension)) return *format;
    throw InputError("format not supported: '" + io::lower(extension) + "'; supported are " +
                     io::listed_formats(io::FormatName::word, false, ", "));
}

std::vector<Index> not_finite(const Vertices& vertices)
{
    return found_in_pieces(static_cast<Index>(vertices.rows()), [&](Index v) { return !vertices.row(v).allFinite(); });
}

std::vector<Index> faces_out_of_range(const PolygonMesh& mesh)
{
    const auto is_bad = [&](Index v) { return v < 0 || v >= mesh.vertices.rows(); };
    return found_in_pieces(mesh.face_count(), [&](Index f) { return std::ranges::any_of(mesh.face(f), is_bad); });
}

void require_a_mesh(const PolygonMesh& mesh)
{
    if (mesh.vertices.rows() == 0) throw InputError("the file holds no vertex");
    if (mesh.face_count() == 0) throw InputError("the file holds no face");
    if (const std::vector<Index> bad = faces_out_of_range(mesh); !bad.empty())
        throw InputError(std::to_string(bad.size()) + " faces name a vertex that is not among the file's " +
                             std::to_string(mesh.vertices.rows()) + " (faces listed)",
                         ElementKind::faces, bad);
    if (const std::vector<Index> bad = not_finite(mesh.vertices); !bad.empty())
        throw InputError(std::to_string(bad.size()) +
                             " vertices have a coordinate that is NaN or infinite (vertices listed)",
                         ElementKind::vertices, bad);
}

}  // namespace

PolygonMesh parse_mesh(std::string_view bytes, const std::string& extension)
{
    if (bytes.starts_with(byte_order_mark)) bytes.remove_prefix(byte_order_mark.size());
    PolygonMesh mesh = known_format(extension).read(bytes);
    require_a_mesh(mesh);
    return mesh;
}

MeshFile read_mesh_file(const std::filesystem::path& path)
{
    MeshFile file{{}, io::lower_extension(path)};
    known_format(file.extension);  // throws for unknown formats, before reading
    file.bytes = io::read_bytes(path);
    if (file.bytes.starts_with(byte_order_mark)) file.bytes.erase(0, byte_order_mark.size());
    return file;
}

PolygonMesh read_mesh(const std::filesystem::path& path)
{
    const MeshFile file = read_mesh_file(path);
    return parse_mesh(file.bytes, file.extension);
}

}  // namespace koebe
