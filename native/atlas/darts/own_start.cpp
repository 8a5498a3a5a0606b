#include "darts/own_start.h"

#include "core/complex_places.h"
#include "cost/tuning.h"
#include "darts/dart_rounds.h"
#include "darts/tension.h"
#include "flat/flat_repair.h"
#include "part_maps/part_map.h"

#include <algorithm>
#include <limits>
#include <utility>

namespace koebe {
namespace {

enum class Storing { mends, mends_or_embeds };

/// Turns faces upright, as far as that can be done.
void make_storable(FlatPart& piece, Storing way, ExecutionContext& context)
{
    PlanarPoints uv = (piece.points.rowwise() - piece.points.colwise().minCoeff()) / packed_side;
    repair_flips(piece, uv, context);
    if (way == Storing::mends_or_embeds) embed_safely(piece, uv, context);
    piece.points = packed_side * uv;
}

void map_by_itself(FlatPart& piece, ExecutionContext& context)
{
    PartMesh mesh;
    mesh.faces = piece.faces;
    mesh.original = piece.original;
    mesh.vertices = piece.vertices;
    mesh.surface = piece.surface;
    mesh.areas = face_areas(piece.vertices, piece.surface.triangles);
    mesh.area = mesh.areas.sum();
    mesh.border.assign(piece.original.size(), 0);
    const PartMap map = map_part(mesh, MapPurpose::judging, context);
    piece.points = flat_as_mapped(mesh, planar_points(map.positions)).points;
    make_storable(piece, Storing::mends_or_embeds, context);
}

/// Gives a piece the places that its faces have in one part of the same surface. @return whether there is such a part
bool take_places_in(const std::vector<FlatPart>& uncut, FlatPart& piece)
{
    const auto own = std::ranges::find_if(
        uncut, [&](const FlatPart& part) { return std::ranges::binary_search(part.faces, piece.faces.front()); });
    if (own == uncut.end()) return false;
    for (std::size_t f = 0; f < piece.faces.size(); ++f) {
        const auto found = std::ranges::lower_bound(own->faces, piece.faces[f]);
        if (found == own->faces.end() || *found != piece.faces[f]) return false;
        for (int k = 0; k < 3; ++k)
            piece.points.row(piece.surface.triangles(static_cast<Index>(f), k)) =
                own->points.row(own->surface.triangles(found - own->faces.begin(), k));
    }
    return true;
}

}  // namespace

void start_by_itself(const std::vector<FlatPart>& uncut, FlatPart& piece, ExecutionContext& context)
{
    const auto energy = [](const FlatPart& part) {
        return lies_one_to_one(part, part.points) && survives_storing(part)
                   ? forces_in(part, tuning::dart_even).energy.sum()
                   : std::numeric_limits<double>::infinity();
    };
    FlatPart by_itself = piece;
    map_by_itself(by_itself, context);
    const bool has_places = take_places_in(uncut, piece);
    if (has_places) make_storable(piece, Storing::mends, context);  // embedded, it would be as the other
    if (!has_places || !(energy(piece) < energy(by_itself))) piece = std::move(by_itself);
}

}  // namespace koebe
