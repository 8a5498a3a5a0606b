#include "parts/hard_surface.h"

#include "core/numbering.h"
#include "cost/costs.h"
#include "execution/profile.h"
#include "hard/hard_room.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <optional>
#include <utility>

namespace koebe {

bool may_unfold(const PartsOptions& options)
{
    return options.even != 0.0 && options.darts > 0.0 && !options.round_cuts && options.loops != LoopForm::round &&
           options.slits.empty() && !options.no_hard;
}

UnfoldOptions unfolding_of(const PartsOptions& options)
{
    return {options.hard_angle, options.cut_hard, options.roomy};
}

HardSurfaces opened_without_hard_parts(const Vertices& vertices, const DividedFaces& faces, const Vertices& scaled,
                                       OpenedSurface connected, const PartsOptions& options, ExecutionContext& context)
{
    const ProfiledStage profiled("flat regions");
    HardSurfaces found;
    auto& [parts, opened, noise] = found;
    std::vector<Index> rest;
    std::vector<FlatPart> roomier;
    int handles = 0;
    for (const SurfacePiece& piece : connected.pieces) {
        Surface surface = analyze_surface(piece.triangles, static_cast<Index>(piece.source_vertex.size()));
        handles += surface.genus;
        CutSurface whole = cut_surface(scaled(piece.source_vertex, Eigen::all), std::move(surface),
                                       values_at(options.polygon, piece.source_face));
        whole.face = values_at(faces.face, piece.source_face);
        whole.shown = cut_prices(options.show, piece.source_vertex);
        // Its flat and rolled regions are parts, with cuts for room and without; the rest is opened below.
        if (std::optional<UnfoldedParts> hard = hard_parts(whole, context, unfolding_of(options))) {
            noise = std::max(noise, hard->noise);
            for (const Index f : hard->rest) rest.push_back(piece.source_face[f]);
            if (hard->roomier.empty()) hard->roomier = hard->parts;
            for (const auto& [own, all] : {std::pair(&hard->parts, &parts), std::pair(&hard->roomier, &roomier)}) {
                note_shown(whole.shown, *own);
                name_by_source(piece, *own);
                std::ranges::move(*own, std::back_inserter(*all));
            }
        } else {
            rest.insert(rest.end(), piece.source_face.begin(), piece.source_face.end());
        }
    }
    if (are_worth_their_number(roomier, parts)) parts = std::move(roomier);
    // All other faces, opened as if they were the input.
    if (!rest.empty()) {
        std::ranges::sort(rest);
        opened = open_surface(
            vertices, faces.triangles(rest, Eigen::all),
            {.polygon = values_at(options.polygon, rest), .seams = options.cuts, .slit_beside_handles = false},
            context);
        for (SurfacePiece& piece : opened.pieces) piece.source_face = values_at(rest, piece.source_face);
    }
    opened.left_out = std::move(connected.left_out);
    opened.handles = handles;
    return found;
}

void name_by_source(const SurfacePiece& piece, std::vector<FlatPart>& parts)
{
    rename_elements(
        parts, [&](Index v) { return piece.source_vertex[v]; }, [&](Index f) { return piece.source_face[f]; });
}

}  // namespace koebe
