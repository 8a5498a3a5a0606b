#include "io/mesh_writer.h"

#include "io/extension.h"
#include "io/file_identity.h"
#include "io/obj_writer.h"
#include "io/ply_file.h"
#include "io/ply_writer.h"

#include <algorithm>
#include <string>

namespace koebe {

std::optional<WrittenFormat> written_format(const std::filesystem::path& target)
{
    const std::string extension = io::lower_extension(target);
    if (extension == ".obj") return WrittenFormat::obj;
    if (extension == ".ply") return WrittenFormat::ply;
    if (extension.empty() && io::is_pipe_or_device(target)) return WrittenFormat::obj;
    return {};
}

namespace {

/// Triangle strips of PLY have no format here: the mesh has their triangles.
bool has_format(const FiledMesh& filed, WrittenFormat format)
{
    if (format == WrittenFormat::ply && filed.file.extension == ".ply" && io::has_ply_strips(filed.file.bytes))
        return false;
    return filed.file.extension == (format == WrittenFormat::ply ? ".ply" : ".obj");
}

/// Empty if the file has another format.
FiledText text_of(const FiledMesh& filed, WrittenFormat format)
{
    return has_format(filed, format) ? FiledText{filed.file.bytes, filed.moved} : FiledText{};
}

/// @param losses if the format is kept
std::vector<Warning> warnings_after(const FiledMesh& filed, WrittenFormat format, const io::FileLosses& losses)
{
    return loss_warnings(has_format(filed, format) ? losses : io::losses_of_all(filed.file, true));
}

}  // namespace

std::vector<Warning> write_with_uvs(AtomicFile& file, WrittenFormat format, const PolygonMesh& mesh,
                                    const PlanarPoints& disk_points, const FiledMesh& filed)
{
    const auto write = format == WrittenFormat::ply ? write_ply_with_uvs : write_obj_with_uvs;
    return warnings_after(filed, format, write(file, mesh, disk_points, text_of(filed, format)));
}

std::vector<Warning> write_with_corner_uvs(AtomicFile& file, WrittenFormat format, const PolygonMesh& mesh,
                                           const PlanarPoints& corner_uvs, const FiledMesh& filed)
{
    const auto write = format == WrittenFormat::ply ? write_ply_with_corner_uvs : write_obj_with_corner_uvs;
    return warnings_after(filed, format, write(file, mesh, corner_uvs, text_of(filed, format)));
}

std::vector<Warning> write_with_patches(AtomicFile& file, WrittenFormat format, const PolygonMesh& mesh,
                                        const std::vector<Index>& patch, const FiledMesh& filed)
{
    const bool kept = format == WrittenFormat::obj && has_format(filed, format);
    if (format == WrittenFormat::ply) {
        write_ply_with_patches(file, mesh, patch);
    } else {
        std::vector<Index> group(patch);
        for (Index& g : group) ++g;
        std::vector<std::string> names{"surface"};
        for (Index k = 0; !patch.empty() && k <= std::ranges::max(patch); ++k)
            names.push_back("patch_" + std::to_string(k));
        write_obj_with_groups(file, mesh, group, names, text_of(filed, format));
    }
    return kept ? std::vector<Warning>{} : loss_warnings(io::losses_of_all(filed.file, false));
}

}  // namespace koebe
