#include "io/mesh_writer.h"

#include "files/extension.h"
#include "files/file_identity.h"

namespace koebe {

const MeshFormat* written_format(const std::filesystem::path& target)
{
    const std::string extension = io::lower_extension(target);
    if (extension.empty() && io::is_pipe_or_device(target)) return &io::mesh_formats().front();
    const MeshFormat* const format = io::mesh_format(extension);
    return format != nullptr && format->writer != nullptr ? format : nullptr;
}

namespace {

bool has_format(const FiledMesh& filed, const MeshFormat& format)
{
    return filed.file.extension == format.extension && format.writer->can_keep(filed.file.bytes);
}

/// Empty if the file has another format.
FiledText text_of(const FiledMesh& filed, const MeshFormat& format)
{
    return has_format(filed, format) ? FiledText{filed.file.bytes, filed.moved} : FiledText{};
}

/// @param losses if the format is kept
std::vector<Warning> warnings_after(const FiledMesh& filed, const MeshFormat& format, const io::FileLosses& losses)
{
    return loss_warnings(has_format(filed, format) ? losses : io::losses_of_all(filed.file, true));
}

}  // namespace

std::vector<Warning> write_with_uvs(AtomicFile& file, const MeshFormat& format, const PolygonMesh& mesh,
                                    const PlanarPoints& disk_points, const FiledMesh& filed)
{
    return warnings_after(filed, format, format.writer->with_uvs(file, mesh, disk_points, text_of(filed, format)));
}

std::vector<Warning> write_with_corner_uvs(AtomicFile& file, const MeshFormat& format, const PolygonMesh& mesh,
                                           const PlanarPoints& corner_uvs, const FiledMesh& filed)
{
    return warnings_after(filed, format,
                          format.writer->with_corner_uvs(file, mesh, corner_uvs, text_of(filed, format)));
}

std::vector<Warning> write_with_patches(AtomicFile& file, const MeshFormat& format, const PolygonMesh& mesh,
                                        const std::vector<Index>& patch, const FiledMesh& filed)
{
    const bool keeps = format.writer->with_patches(file, mesh, patch, text_of(filed, format));
    return keeps && has_format(filed, format) ? std::vector<Warning>{}
                                              : loss_warnings(io::losses_of_all(filed.file, false));
}

}  // namespace koebe
