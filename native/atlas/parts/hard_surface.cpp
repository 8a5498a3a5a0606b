#include "parts/hard_surface.h"

#include "parts/unfolding.h"

#include <algorithm>
#include <iterator>
#include <optional>
#include <utility>

namespace koebe {
namespace {

template <typename Value>
std::vector<Value> values_at(const std::vector<Value>& values, const std::vector<Index>& places)
{
    std::vector<Value> found;
    if (!values.empty())
        for (const Index i : places) found.push_back(values[i]);
    return found;
}

}  // namespace

OpenedSurface opened_without_hard_parts(const Vertices& vertices, const Triangles& triangles, const Vertices& scaled,
                                        OpenedSurface connected, const PartsOptions& options,
                                        std::vector<FlatPart>& parts, ExecutionContext& context)
{
    OpenedSurface opened;
    std::vector<Index> rest;
    int handles = 0;
    for (const SurfacePiece& piece : connected.pieces) {
        Surface surface = analyze_surface(piece.triangles, static_cast<Index>(piece.source_vertex.size()));
        handles += surface.genus;
        CutSurface whole = cut_surface(scaled(piece.source_vertex, Eigen::all), std::move(surface),
                                       values_at(options.polygon, piece.source_face));
        whole.shown = values_at(options.show, piece.source_vertex);
        std::optional<UnfoldedParts> hard;
        if (!options.no_hard) hard = hard_parts(whole, context, {options.hard_angle, options.cut_hard, options.roomy});
        if (hard) {
            for (const Index f : hard->rest) rest.push_back(piece.source_face[f]);
            name_by_input(piece, options.show, hard->parts);
            std::ranges::move(hard->parts, std::back_inserter(parts));
        } else {
            rest.insert(rest.end(), piece.source_face.begin(), piece.source_face.end());
        }
    }
    if (!rest.empty()) {
        std::ranges::sort(rest);
        opened = open_surface(vertices, triangles(rest, Eigen::all),
                              {.polygon = values_at(options.polygon, rest), .slit_beside_handles = false}, context);
        for (SurfacePiece& piece : opened.pieces) piece.source_face = values_at(rest, piece.source_face);
    }
    opened.left_out = std::move(connected.left_out);
    opened.handles = handles;
    return opened;
}

void name_by_input(const SurfacePiece& piece, const std::vector<double>& show, std::vector<FlatPart>& parts)
{
    for (FlatPart& part : parts) {
        part.faces = values_at(piece.source_face, part.faces);
        part.original = values_at(piece.source_vertex, part.original);
        part.shown = values_at(show, part.original);
        for (VertexLoop& loop : part.loops) loop = values_at(piece.source_vertex, loop);
    }
}

}  // namespace koebe
