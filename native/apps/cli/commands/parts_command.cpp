// koebe parts IN OUT
#include "cli/commands/corner_command.h"

#include "core/counted.h"
#include "parts/parts.h"
#include "report/parts_json.h"
#include "report/parts_svg.h"

namespace koebe::cli {
namespace {

class PartsKind final : public PieceMapKind<parts_of, &PartsResult::parts> {
public:
    using PieceMapKind::PieceMapKind;

    std::string draw(const MeshInput&, const PartsResult& result) const override
    {
        return parts_svg(result.uv, result.part, result.tiles);
    }
    std::string first_words(const PartsResult& result) const override
    {
        return counted(result.parts.size(), "part") + ", cuts " + formatted("%.2f", result.cut_length) +
               " times the root of the area, texel density within a factor " +
               formatted("%.3g", result.density_ratio_5_95);
    }
};

}  // namespace

Subcommand add_parts(CLI::App& app)
{
    return add_corner_map<PartsKind>(app, {"parts", "cut any surface in its UVs into even disks and tubes", "any mesh",
                                           "write a picture of the parts there"});
}

}  // namespace koebe::cli
