#include "io/mesh_formats.h"

#include "core/errors.h"
#include "core/sort_unique.h"
#include "files/extension.h"
#include "io/format_readers.h"
#include "io/gltf_meshes.h"
#include "io/obj_writer.h"
#include "io/ply_file.h"
#include "io/ply_writer.h"

#include <algorithm>

namespace koebe::io {
namespace {

/// The mesh without the vertices that are in no face.
PolygonMesh with_used_vertices(const PolygonMesh& mesh)
{
    std::vector<Index> used(mesh.corners);
    sort_unique(used);
    PolygonMesh result{mesh.vertices(used, Eigen::all), mesh.corners, mesh.face_begin};
    for (Index& vertex : result.corners)
        vertex = static_cast<Index>(std::ranges::lower_bound(used, vertex) - used.begin());
    return result;
}

PolygonMesh read_only_mesh(std::string_view glb)
{
    const std::vector<GltfMesh> meshes = read_gltf_meshes(glb);
    if (meshes.size() > 1)
        throw InputError("the GLB file has " + std::to_string(meshes.size()) +
                         " meshes: only maps that are written as GLB take several");
    return with_used_vertices(meshes.front().polygons);
}

PlanarPoints uvs_of_only_mesh(std::string_view glb, const PolygonMesh&, int set)
{
    return read_gltf_uvs(glb, set).front();
}

std::vector<Index> marks_of_only_mesh(std::string_view glb, CutAt at) { return read_gltf_marks(glb, at).front(); }

FileLosses glb_contents(std::string_view)
{
    return {.others = {"materials, skins and other contents of the GLB file"}};
}

/// OBJ groups "surface" and "patch_0", "patch_1", …
bool write_obj_patches(AtomicFile& file, const PolygonMesh& mesh, const std::vector<Index>& patch,
                       const FiledText& filed)
{
    std::vector<Index> group(patch);
    for (Index& g : group) ++g;
    std::vector<std::string> names{"surface"};
    for (Index k = 0; !patch.empty() && k <= std::ranges::max(patch); ++k)
        names.push_back("patch_" + std::to_string(k));
    write_obj_with_groups(file, mesh, group, names, filed);
    return true;
}

/// The property `patch`.
bool write_ply_patches(AtomicFile& file, const PolygonMesh& mesh, const std::vector<Index>& patch, const FiledText&)
{
    write_ply_with_patches(file, mesh, patch);
    return false;
}

constexpr MeshWriter obj_writer{write_obj_with_uvs, write_obj_with_corner_uvs, write_obj_patches,
                                [](std::string_view) { return true; }};
/// Triangle strips of PLY have no format here: the mesh has their triangles.
constexpr MeshWriter ply_writer{write_ply_with_uvs, write_ply_with_corner_uvs, write_ply_patches,
                                [](std::string_view bytes) { return !has_ply_strips(bytes); }};

/// OFF and STL are not written: STL has no texture coordinates. Of the readers of STOFF that were tried CGAL 5.5
/// crashes, MeshLab invents coordinates, trimesh drops them and meshio refuses the file. GLB files are edited, not
/// written (glb_editor.h).
constexpr MeshFormat all_formats[] = {
    {".obj", read_obj, obj_contents, &obj_writer, obj_corner_uvs, obj_corner_marks},
    {".off", read_off, off_contents},
    {".ply", read_ply, ply_contents, &ply_writer, ply_corner_uvs},
    {".stl", read_stl, stl_contents},
    {".glb", read_only_mesh, glb_contents, nullptr, uvs_of_only_mesh, marks_of_only_mesh},
};

}  // namespace

std::span<const MeshFormat> mesh_formats() { return all_formats; }

const MeshFormat* mesh_format(std::string_view extension)
{
    const auto found = std::ranges::find(all_formats, lower(std::string(extension)), &MeshFormat::extension);
    return found == std::end(all_formats) ? nullptr : found;
}

bool is_mesh_file(const std::filesystem::path& path) { return mesh_format(path.extension().string()) != nullptr; }

std::vector<std::string> format_names(FormatName as, bool written)
{
    std::vector<std::string> names;
    for (const MeshFormat& format : all_formats) {
        if (written && format.writer == nullptr) continue;
        std::string& name = names.emplace_back(format.extension.substr(as == FormatName::extension ? 0 : 1));
        if (as == FormatName::word)
            for (char& c : name) c = static_cast<char>(c - 'a' + 'A');
    }
    return names;
}

std::string listed_formats(FormatName as, bool written, const std::string& last)
{
    const std::vector<std::string> names = format_names(as, written);
    std::string list = names.front();
    for (std::size_t k = 1; k < names.size(); ++k) list += (k + 1 < names.size() ? ", " : last) + names[k];
    return list;
}

}  // namespace koebe::io
