// The formats of mesh files, a row each: whoever reads, writes, lists or names mesh files asks here.
#pragma once

#include "core/api.h"
#include "files/atomic_file.h"
#include "io/file_losses.h"
#include "io/filed_text.h"
#include "io/polygon_mesh.h"

#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace koebe {

/// The functions that write a format. `filed` holds the file that the mesh was read from, if that has the same format;
/// its other contents are kept, and the losses list what is not.
struct MeshWriter {
    using WithUvs = io::FileLosses (*)(AtomicFile& file, const PolygonMesh& mesh, const PlanarPoints& uvs,
                                       const FiledText& filed);
    WithUvs with_uvs;         ///< a point of the unit disk for each vertex
    WithUvs with_corner_uvs;  ///< texture coordinates for each corner
    /// A number for each face, -1 for no patch. @return whether all other contents are kept
    bool (*with_patches)(AtomicFile& file, const PolygonMesh& mesh, const std::vector<Index>& patch,
                         const FiledText& filed);
    bool (*can_keep)(std::string_view bytes);  ///< whether a file of these bytes can be written again
};

/// What parts the faces of a file, beside their vertices.
enum class CutAt { nothing, materials, groups, normals, all };

struct MeshFormat {
    std::string_view extension;  ///< in lower case, with the dot
    PolygonMesh (*read)(std::string_view bytes);
    io::FileLosses (*contents)(std::string_view bytes);  ///< beside vertices and faces
    const MeshWriter* writer = nullptr;                  ///< null: it is only read
    /// (C, 2) u and v of the mesh's corners; empty: the file has none. Null: the format has none.
    /// @param mesh as it was read from these bytes @param set which UVs, where a file can have several
    /// @throws InputError the UVs are damaged, or some faces have none (elements: faces)
    PlanarPoints (*corner_uvs)(std::string_view bytes, const PolygonMesh& mesh, int set) = nullptr;
    /// (C) a number for each corner: two faces lie apart at an edge if their corners there have different numbers.
    /// Null: the format tells no such thing. @throws InputError the file is damaged
    std::vector<Index> (*corner_marks)(std::string_view bytes, CutAt at) = nullptr;
};

namespace io {

/// All formats that are read. The first one is written where a name tells none.
KOEBE_API std::span<const MeshFormat> mesh_formats();

/// The format of an extension with its dot, in any case; null if there is none.
const MeshFormat* mesh_format(std::string_view extension);

/// Whether its name is that of a mesh file.
bool is_mesh_file(const std::filesystem::path& path);

/// How formats are listed in texts: OBJ, .obj, obj.
enum class FormatName { word, extension, bare };

/// The names of the formats that are read, or of those that are also written.
KOEBE_API std::vector<std::string> format_names(FormatName as, bool written = false);

/// "OBJ, OFF or GLB". @param last the word before the last name
std::string listed_formats(FormatName as, bool written = false, const std::string& last = " or ");

}  // namespace io

}  // namespace koebe
