#include "io/mesh_writer.h"

#include "io/extension.h"
#include "io/file_identity.h"
#include "io/obj_writer.h"
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

void write_with_uvs(AtomicFile& file, WrittenFormat format, const PolygonMesh& mesh, const PlanarPoints& disk_points)
{
    const auto write = format == WrittenFormat::ply ? write_ply_with_uvs : write_obj_with_uvs;
    write(file, mesh, disk_points);
}

void write_with_corner_uvs(AtomicFile& file, WrittenFormat format, const PolygonMesh& mesh,
                           const PlanarPoints& corner_uvs)
{
    const auto write = format == WrittenFormat::ply ? write_ply_with_corner_uvs : write_obj_with_corner_uvs;
    write(file, mesh, corner_uvs);
}

void write_with_patches(AtomicFile& file, WrittenFormat format, const PolygonMesh& mesh,
                        const std::vector<Index>& patch)
{
    if (format == WrittenFormat::ply) return write_ply_with_patches(file, mesh, patch);
    std::vector<Index> group(patch);
    for (Index& g : group) ++g;
    std::vector<std::string> names{"surface"};
    for (Index k = 0; !patch.empty() && k <= std::ranges::max(patch); ++k)
        names.push_back("patch_" + std::to_string(k));
    write_obj_with_groups(file, mesh, group, names);
}

}  // namespace koebe
