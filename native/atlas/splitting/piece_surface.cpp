#include "splitting/piece_surface.h"

#include "splitting/closed_surface.h"

#include <optional>
#include <utility>

namespace koebe {
namespace {

/// @param whole the piece, without what is known of its elements
CutSurface with_elements(CutSurface whole, const PieceInput& input)
{
    whole.face = input.face;
    whole.slit = input.slit;
    whole.seam = input.seam;
    whole.shown = input.shown;
    return whole;
}

}  // namespace

CutSurface opened_surface(const PieceInput& input)
{
    return with_elements(cut_surface(input.piece.vertices, input.piece.triangles, input.polygon), input);
}

CutSurface whole_of(const PieceInput& input)
{
    std::optional<CutSurface> closed = closed_surface(input.piece, input.piece.vertices, input.polygon);
    return closed ? with_elements(std::move(*closed), input) : opened_surface(input);
}

PieceSurface surface_of(const PieceInput& input)
{
    PieceSurface surface{whole_of(input)};
    if (surface.whole.surface.loops.empty()) {
        surface.first = halves(surface.whole);
        if (!surface.first.empty()) return surface;
        surface.whole = opened_surface(input);
    }
    if (is_between_cuts(surface.whole) && is_nearly_closed(surface.whole)) surface.first = halves(surface.whole);
    return surface;
}

}  // namespace koebe
