#include "flat/flat_parts.h"

#include "core/complex_places.h"
#include "core/connectivity.h"
#include "core/errors.h"
#include "core/numbering.h"
#include "cost/costs.h"
#include "execution/side_by_side.h"
#include "flat/flat_repair.h"
#include "foldover/angle_polish.h"
#include "pipeline/uniformize.h"
#include "quality/stored_uv.h"

#include <algorithm>
#include <iterator>
#include <utility>

namespace koebe {
namespace {

constexpr double most_lost = 0.005;       // of a part's area, in faces without area as stored
constexpr double lost_anyway = 1e-5;      // of the surface's area: not worth a cut
constexpr int most_halvings = 6;          // of one part
constexpr std::size_t few_faces = 24;     // a part with fewer faces is not cut
constexpr std::size_t many_faces = 4000;  // a part with more faces is cut first if
constexpr double most_turned = 0.01;      // more of its faces are turned over

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

bool fewer(const Flaws& a, const Flaws& b)
{
    return std::pair(a.lost + a.spoilt, a.turned) < std::pair(b.lost + b.spoilt, b.turned);
}

void add(const Flaws& more, Flaws& flaws)
{
    flaws.lost += more.lost;
    flaws.turned += more.turned;
    flaws.spoilt += more.spoilt;
}

double turned_share(const FlatPart& flat)
{
    Index turned = 0;
    for (Eigen::Index f = 0; f < flat.surface.triangles.rows(); ++f)
        turned += StoredFace(flat.surface.triangles, flat.points, f).flipped();
    return static_cast<double>(turned) / static_cast<double>(flat.surface.triangles.rows());
}

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

/// A box of about the size that a part will have in the unit square, its lower left corner at 0.
class Frame {
public:
    explicit Frame(const PlanarPoints& points) : low_(points.colwise().minCoeff())
    {
        side_ = std::max(packed_side, (points.rowwise() - low_).maxCoeff());
    }
    PlanarPoints uv(const PlanarPoints& points) const { return (points.rowwise() - low_) / side_; }
    PlanarPoints points(const PlanarPoints& uv) const { return (side_ * uv).rowwise() + low_; }

private:
    Eigen::RowVector2d low_;
    double side_;
};

/// The overflow of the flat part, in area times u.
double overflow_of(const FlatPart& flat, const VectorXd& areas)
{
    const FlatDensity density = flat_density(flat, areas);
    return evenness(density.u, areas, density.lost).overflow;
}

/// Flipped faces turned back.
Flaws repair(FlatPart& flat, const VectorXd& areas, ExecutionContext& context)
{
    const Frame box(flat.points);
    const PlanarPoints before = box.uv(flat.points);
    PlanarPoints uv = before;
    repair_flips(flat, uv, context);
    embed_safely(flat, uv, context);
    if (uv != before) flat.points = box.points(uv);
    return flaws_of(flat, uv, areas);
}

/// Angle errors made less, the boundary as it is.
void polish(FlatPart& flat, ExecutionContext& context)
{
    const Frame box(flat.points);
    PlanarPoints points = 2.0 * box.uv(flat.points).array() - 1.0;
    std::vector<Index> boundary;
    for (const VertexLoop& loop : flat.surface.loops) boundary.insert(boundary.end(), loop.begin(), loop.end());
    std::ranges::sort(boundary);
    const std::vector<Circle> circles(flat.surface.loops.size());
    if (polish_angles(flat.vertices, flat.surface, flat.surface.loops, circles, boundary, points, context))
        flat.points = box.points(0.5 * (points.array() + 1.0));
}

/// Turns flips back. Notes the cost of the repair if it is more than a part: the repaired part may be far less even
/// than the map that judged it, and bent.
void repair_and_judge(const Part& part, double part_price, FlatParts& as_one, ExecutionContext& context)
{
    FlatPart& flat = as_one.parts.front();
    const double error = angle_error(as_one.parts);
    as_one.flaws = repair(flat, part.mesh.areas, context);
    const double worse = overflow_of(flat, part.mesh.areas) - part.map.overflow;
    const double bent = angle_error(as_one.parts) - error;
    double cost = worse > tuning::free_unevenness * part.mesh.area ? worse : 0.0;
    if (bent > tuning::free_bend) cost += angle_cost(bent, part.mesh.area);
    if (cost > part_price) as_one.flaws.spoilt = cost / tuning::lost_cost;
}

FlatParts laid_in_two(const CutSurface& whole, const PartPointer& part, const FlatOptions& options, int halvings,
                      ExecutionContext& context, SplitEffort& effort);

/// Cuts a part with flaws in two, if that makes the flaws fewer. A large part with many flips is cut before it is
/// repaired: repairs take long there, and rarely help.
FlatParts laid(const CutSurface& whole, const PartPointer& part, const FlatOptions& options, int halvings,
               ExecutionContext& context, SplitEffort& effort)
{
    FlatParts as_one;
    as_one.parts.push_back(flat_part(*part, options, context));
    if (options.purpose == MapPurpose::judging) return as_one;
    const std::size_t count = part->mesh.faces.size();
    const bool may_be_cut = halvings < most_halvings && count >= few_faces;
    FlatParts in_two;
    if (may_be_cut && count > many_faces && part->map.overflow > options.prices.part_price &&
        turned_share(as_one.parts.front()) > most_turned) {
        in_two = laid_in_two(whole, part, options, halvings, context, effort);
        if (in_two.parts.size() > 1 && !in_two.flaws.any()) return in_two;
    }
    repair_and_judge(*part, options.prices.part_price, as_one, context);
    if (!as_one.flaws.any() || !may_be_cut) return as_one;
    if (in_two.parts.empty()) in_two = laid_in_two(whole, part, options, halvings, context, effort);
    return in_two.parts.size() > 1 && fewer(in_two.flaws, as_one.flaws) ? std::move(in_two) : std::move(as_one);
}

FlatParts laid_in_two(const CutSurface& whole, const PartPointer& part, const FlatOptions& options, int halvings,
                      ExecutionContext& context, SplitEffort& effort)
{
    FlatParts in_two;
    for (const PartPointer& child : halved(whole, part, 1, context, effort)) {
        FlatParts own = laid(whole, child, options, halvings + 1, context, effort);
        add(own.flaws, in_two.flaws);
        std::ranges::move(own.parts, std::back_inserter(in_two.parts));
    }
    return in_two;
}

/// What a flat part costs: its overflow, its angle error in the same unit, and the price of a part.
double cost_of(const FlatPart& part, double part_price)
{
    const VectorXd areas = face_areas(part.vertices, part.surface.triangles);
    const double error = sum_of_angle_errors(part) / static_cast<double>(part.faces.size());
    return overflow_of(part, areas) + angle_cost(error, areas.sum()) + part_price;
}

/// Whether the map by which a piece was split shows that as one map it loses much, or bends more.
bool hopeless_as_one(const Part& root, double error)
{
    if (root.map.lost_area > most_lost * root.mesh.area) return true;
    const double own =
        summed_angle_error(root.mesh.vertices, root.mesh.surface.triangles, planar_points(root.map.positions));
    return own > error * static_cast<double>(root.mesh.faces.size());
}

/// A whole piece in the map by which it was split, if that has no flaws as stored; else as uniformize repairs it, if
/// the parts are `broken`: repairs take long, and seldom bend less than cuts. @return no part if there is none
std::optional<FlatPart> as_one_map(const CutSurface& whole, const Part* root, bool broken, ExecutionContext& context)
{
    if (root != nullptr && root->map.positions.size() > 0) {
        FlatPart one = flat_as_mapped(root->mesh, planar_points(root->map.positions));
        if (!flaws_of(one, Frame(one.points).uv(one.points), whole.areas).any()) return one;
    }
    if (!broken) return {};
    std::vector<Index> faces = numbers_below(whole.areas.size());
    const PartMesh mesh = part_mesh(whole, std::move(faces));
    ExecutionContext inner({}, {}, [&context] { context.checkpoint(); });
    return flat_as_mapped(mesh, uniformize(mesh.vertices, mesh.surface.triangles, {}, inner).uv);
}

}  // namespace

FlatParts flat_parts(const CutSurface& whole, const Mirror& mirror, std::vector<PartPointer>& parts,
                     const FlatOptions& options, int threads, ExecutionContext& context, SplitEffort& effort)
{
    std::vector<FlatParts> flats(parts.size());
    std::vector<SplitEffort> efforts(parts.size());
    std::vector<char> opened(whole.surface.twin.size(), 0);
    // On a mirrored surface a tube's slit is the image of its partner's: so one after the other.
    const bool one_by_one = !mirror.image.empty();
    side_by_side(parts.size(), one_by_one ? 1 : threads, context, [&](std::size_t k, ExecutionContext& own) {
        Part& part = *parts[k];
        if (part.map.positions.size() == 0) map_anew(whole, part, own, efforts[k], options.purpose);
        const bool chosen = std::ranges::count(part.mesh.slit, 1) > 0;
        if (one_by_one && part.map.kind == PartKind::tube && !chosen)
            prefer_slits(part.mesh, mirrored_slits(whole, mirror, opened));
        FlatOptions own_options = options;
        if (chosen) own_options.prices.cut_price = 0.0;
        flats[k] = laid(whole, parts[k], own_options, 0, own, efforts[k]);
        if (one_by_one && flats[k].parts.size() == 1) note_slit(part.mesh, flats[k].parts.front(), opened);
        parts[k].reset();
    });
    // Join in the parts' order, whatever thread was first.
    FlatParts all;
    for (FlatParts& own : flats) {
        add(own.flaws, all.flaws);
        std::ranges::move(own.parts, std::back_inserter(all.parts));
    }
    for (const SplitEffort& own : efforts) effort.maps += own.maps;
    return all;
}

std::optional<FlatPart> better_as_one(const CutSurface& whole, const Part* root, FlatParts& parts, double part_price,
                                      ExecutionContext& context)
{
    // Worth a try? Not if the parts have no faults, and angles that one map cannot better.
    const double error = angle_error(parts.parts);
    const bool is_cut = root != nullptr && parts.parts.size() > 1;
    if (!parts.flaws.broken() && is_cut && hopeless_as_one(*root, error)) return {};
    // One map of the whole. It must beat the parts before its repair, and after it.
    std::optional<FlatPart> found;
    try {
        found = as_one_map(whole, root, parts.flaws.broken(), context);
    } catch (const SolverError&) {
    }
    if (!found) return {};
    FlatPart& one = *found;
    const auto error_of_one = [&] { return summed_angle_error(one.vertices, one.surface.triangles, one.points); };
    const double most = error * static_cast<double>(one.faces.size());
    if (!parts.flaws.broken() && error_of_one() > most) return {};
    const Flaws flaws = repair(one, whole.areas, context);
    parts.flaws.spoilt = 0.0;
    if (flaws.broken() && !fewer(flaws, parts.flaws)) return {};
    const double own = error_of_one();
    if (parts.flaws.broken()) return found;
    if (own >= most) return {};
    // Its cost must be lower too, and its angles better than those of polished parts.
    double cost = 0.0;
    for (const FlatPart& part : parts.parts) cost += cost_of(part, part_price);
    if (cost_of(one, part_price) >= cost) return {};
    for (FlatPart& part : parts.parts) polish(part, context);
    if (own >= angle_error(parts.parts) * static_cast<double>(one.faces.size())) return {};
    return found;
}

}  // namespace koebe
