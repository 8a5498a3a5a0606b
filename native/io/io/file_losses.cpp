#include "io/file_losses.h"

#include "io/mesh_formats.h"

#include <utility>

namespace koebe::io {
namespace {

std::string listed(const std::vector<std::string>& words)
{
    std::string list;
    for (std::size_t i = 0; i < words.size(); ++i)
        list += (i == 0 ? "" : i + 1 < words.size() ? ", " : " and ") + words[i];
    return list;
}

}  // namespace

FileLosses losses_of_all(const MeshFile& filed, bool with_uvs)
{
    const MeshFormat* const format = mesh_format(filed.extension);
    FileLosses losses = format != nullptr ? format->contents(filed.bytes) : FileLosses{};
    if (!with_uvs && std::exchange(losses.texture_coordinates, false))
        losses.others.insert(losses.others.begin(), "texture coordinates");
    return losses;
}

std::vector<Warning> loss_warnings(const FileLosses& losses)
{
    std::vector<Warning> warnings;
    if (losses.texture_coordinates)
        warnings.push_back({WarningKind::replaced_uvs, "the file's texture coordinates are replaced by the map's"});
    if (!losses.others.empty())
        warnings.push_back({WarningKind::not_kept, "the written file does not have: " + listed(losses.others)});
    return warnings;
}

}  // namespace koebe::io
