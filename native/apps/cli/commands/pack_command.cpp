// koebe pack IN OUT
#include "cli/commands/corner_command.h"

#include "core/counted.h"
#include "packing/packed_layer.h"
#include "report/packed_json.h"
#include "report/parts_svg.h"

#include <string>
#include <vector>

namespace koebe::cli {
namespace {

class PackKind final : public PieceMapKind<pack_layer, &PackedLayer::islands> {
public:
    using PieceMapKind::PieceMapKind;

    bool takes_uvs() const override { return true; }
    std::vector<Warning> write_mesh(AtomicFile& file, const MeshInput& input, const PackedLayer& result) const override
    {
        std::vector<Warning> warnings = PieceMapKind::write_mesh(file, input, result);
        std::erase_if(warnings, [](const Warning& one) { return one.kind == WarningKind::replaced_uvs; });  // as asked
        return warnings;
    }
    std::string draw(const MeshInput&, const PackedLayer& result) const override
    {
        return parts_svg(result.uv, result.part, result.tiles);
    }
    std::string first_words(const PackedLayer& result) const override
    {
        return counted(result.islands.size(), "island") + ", coverage " + formatted("%.1f", 100.0 * result.coverage) +
               " %";
    }
};

}  // namespace

Subcommand add_pack(CLI::App& app)
{
    return add_corner_map<PackKind>(app, {"pack", "pack the islands of a file's texture coordinates, as they are",
                                          "mesh with texture coordinates", "write a picture of the islands there"});
}

}  // namespace koebe::cli
