// koebe torus IN OUT, koebe ring IN OUT
#include "cli/commands/corner_command.h"

#include "core/counted.h"
#include "report/tile_json.h"
#include "report/tile_svg.h"
#include "tiles/tile_map.h"

#include <string>

namespace koebe::cli {
namespace {

constexpr const char* picture = "write a picture of the tile and its copies there";

template <auto map>
class TileKind final : public CornerMapKind<map> {
public:
    using CornerMapKind<map>::CornerMapKind;

    std::string draw(const MeshInput&, const TileResult& result) const override { return tile_svg(result); }
    std::string first_words(const TileResult& result) const override
    {
        const bool torus = result.periods.size() > 1;
        std::string words = counted(result.loops.size(), "loop") + ", modulus ";
        if (torus) words += formatted("%.5g", result.modulus.real()) + (result.modulus.imag() < 0.0 ? "" : "+");
        return words + formatted("%.5g", result.modulus.imag()) + "i";
    }
};

}  // namespace

Subcommand add_torus(CLI::App& app)
{
    return add_corner_map<TileKind<torus_map>>(app, {"torus",
                                                     "map a surface with one handle to a flat torus, its holes round",
                                                     "surface of genus 1, with or without holes", picture});
}

Subcommand add_ring(CLI::App& app)
{
    return add_corner_map<TileKind<ring_map>>(app,
                                              {"ring", "map a surface with two loops or more to an unrolled cylinder",
                                               "surface of genus 0 with two loops or more", picture});
}

}  // namespace koebe::cli
