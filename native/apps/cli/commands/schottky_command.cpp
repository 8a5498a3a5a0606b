// koebe schottky IN OUT
#include "cli/commands/corner_command.h"

#include "core/counted.h"
#include "report/schottky_json.h"
#include "report/schottky_svg.h"
#include "schottky/schottky_map.h"

namespace koebe::cli {
namespace {

class SchottkyKind final : public CornerMapKind<schottky_map> {
public:
    using CornerMapKind::CornerMapKind;

    std::string draw(const MeshInput&, const SchottkyResult& result) const override { return schottky_svg(result); }
    std::string first_words(const SchottkyResult& result) const override
    {
        return counted(result.handles.size(), "handle") + ", " + counted(result.holes.size(), "loop") + ", " +
               counted(static_cast<std::size_t>(result.sweeps), "sweep");
    }
};

}  // namespace

Subcommand add_schottky(CLI::App& app)
{
    return add_corner_map<SchottkyKind>(
        app, {"schottky",
              "cut a surface with handles open and map it into the disk: Moebius maps join the cuts, holes are round",
              "surface with one handle or more", "write a picture there: the faces, and the circles of the copies"});
}

}  // namespace koebe::cli
