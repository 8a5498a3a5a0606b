#include "parts/flat_parts.h"

#include "core/connectivity.h"
#include "core/side_by_side.h"
#include "quality/stored_uv.h"

#include <algorithm>
#include <iterator>
#include <utility>

namespace koebe {
namespace {

constexpr double square_side = 1.25;    // of the square that parts of area 1 are packed into, about
constexpr double most_lost = 0.005;     // of a part's area, in faces without area as stored
constexpr double lost_anyway = 1e-5;    // of the surface's area: not worth a cut
constexpr int most_halvings = 6;        // of one part
constexpr std::size_t few_faces = 8;    // a part of fewer is not cut

/// @param slit (3F) half-edges of the whole
void prefer_slits(PartMesh& part, const std::vector<char>& slit)
{
    part.slit.resize(3 * part.faces.size(), 0);
    for (std::size_t i = 0; i < part.faces.size(); ++i)
        for (std::size_t k = 0; k < 3; ++k)
            if (slit[3 * static_cast<std::size_t>(part.faces[i]) + k]) part.slit[3 * i + k] = 1;
}

/// @param opened (3F) half-edges of the whole, changed in place
void note_slit(const PartMesh& part, const FlatPart& flat, std::vector<char>& opened)
{
    for (std::size_t h = 0; h < part.surface.twin.size(); ++h)
        if (part.surface.twin[h] != no_twin && flat.surface.twin[h] == no_twin)
            opened[3 * static_cast<std::size_t>(part.faces[h / 3]) + h % 3] = 1;
}

/// What is wrong with parts as they are stored.
struct Flaws {
    double lost = 0.0;  ///< area of faces without area, where it is more than a part may lose
    Index turned = 0;   ///< faces turned over, and parts whose boundary crosses itself

    bool any() const { return lost > 0.0 || turned > 0; }
    bool operator<(const Flaws& other) const { return std::pair(lost, turned) < std::pair(other.lost, other.turned); }
    void operator+=(const Flaws& other)
    {
        lost += other.lost;
        turned += other.turned;
    }
};

/// @param uv in [0, 1]^2 @param areas (F)
Flaws flaws_of(const FlatPart& flat, const PlanarPoints& uv, const VectorXd& areas)
{
    const PlanarPoints points = 2.0 * uv.array() - 1.0;
    Flaws flaws;
    for (Eigen::Index f = 0; f < areas.size(); ++f) {
        const StoredFace face(flat.surface.triangles, points, f);
        if (!face.flipped()) continue;
        flaws.lost += areas[f];
        flaws.turned += !face.below_resolution();
    }
    if (flaws.lost <= std::max(most_lost * areas.sum(), lost_anyway)) flaws.lost = 0.0;
    flaws.turned += !loops_apart(flat, uv);
    return flaws;
}

/// Flat parts that one part has become.
struct Laid {
    std::vector<FlatPart> flats;
    Flaws flaws;
};

/// The part, its flipped faces turned back in a box of about the size that it will have.
Laid laid(const Part& part, const FlatOptions& options, ExecutionContext& context)
{
    Laid result;
    FlatPart& flat = result.flats.emplace_back(flat_part(part, options, context));
    const Eigen::RowVector2d low = flat.points.colwise().minCoeff(), high = flat.points.colwise().maxCoeff();
    const double side = std::max(square_side, (high - low).maxCoeff());
    const PlanarPoints before = (flat.points.rowwise() - low) / side;
    PlanarPoints uv = before;
    repair_flips(flat, uv, context);
    embed_safely(flat, uv, context);
    if (uv != before) flat.points = (side * uv).rowwise() + low;
    result.flaws = flaws_of(flat, uv, part.mesh.areas);
    return result;
}

/// The same, cut in two where it has flaws, if that makes them fewer.
Laid laid_well(const CutSurface& whole, const PartPointer& part, const FlatOptions& options, int halvings,
               ExecutionContext& context, SplitEffort& effort)
{
    Laid as_one = laid(*part, options, context);
    if (!as_one.flaws.any() || halvings == most_halvings || part->mesh.faces.size() < few_faces) return as_one;
    Laid in_two;
    for (const PartPointer& child : halved(whole, part, 1, context, effort)) {
        Laid own = laid_well(whole, child, options, halvings + 1, context, effort);
        in_two.flaws += own.flaws;
        std::ranges::move(own.flats, std::back_inserter(in_two.flats));
    }
    return in_two.flats.size() > 1 && in_two.flaws < as_one.flaws ? std::move(in_two) : std::move(as_one);
}

}  // namespace

std::vector<FlatPart> flat_parts(const CutSurface& whole, const Mirror& mirror, std::vector<PartPointer>& parts,
                                 const FlatOptions& options, int threads, ExecutionContext& context,
                                 SplitEffort& effort)
{
    std::vector<std::vector<FlatPart>> laid(parts.size());
    std::vector<SplitEffort> efforts(parts.size());
    std::vector<char> opened(whole.surface.twin.size(), 0);
    const bool in_turn = !mirror.image.empty();
    side_by_side(parts.size(), in_turn ? 1 : threads, context, [&](std::size_t k, ExecutionContext& own) {
        Part& part = *parts[k];
        if (part.map.positions.size() == 0) map_anew(whole, part, own, efforts[k]);
        const bool chosen = std::ranges::count(part.mesh.slit, 1) > 0;
        if (in_turn && part.map.kind == PartKind::tube && !chosen)
            prefer_slits(part.mesh, mirrored_slits(whole, mirror, opened));
        laid[k] = laid_well(whole, parts[k], {chosen ? 0.0 : options.slit_price, options.round_cuts}, 0, own,
                            efforts[k])
                      .flats;
        if (in_turn && laid[k].size() == 1) note_slit(part.mesh, laid[k].front(), opened);
        parts[k].reset();
    });
    std::vector<FlatPart> flats;
    for (auto& own : laid) std::ranges::move(own, std::back_inserter(flats));
    for (const SplitEffort& own : efforts) effort.maps += own.maps;
    return flats;
}

}  // namespace koebe
