#include "flat/noise_level.h"

#include "core/connectivity.h"
#include "cost/tolerances.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>
#include <vector>

namespace koebe {
namespace {

constexpr double stored_digits = 1e-5;  // in the diagonal of the surface's box: coordinates with five digits
/// A level of noise: the tolerance in that unit, and the share of the area in large regions from which it is taken. A
/// patch of a ball is no large region at the first levels.
struct NoiseLevel {
    double tolerance, share, large;
    bool waves = false;
};
constexpr NoiseLevel noise_levels[] = {{3e-5, 0.04, 0.01}, {1e-4, 0.04, 0.01}, {3e-4, 0.25, 0.01},
                                       {1e-3, 0.25, 0.01}, {2e-3, 0.4, 0.02},  {4e-3, 0.6, 0.03}};
constexpr NoiseLevel slight_noise[] = {{1e-4, 0.15, 0.01}};  // tried first: most surfaces have none
constexpr NoiseLevel any_noise[] = {{1e-4, 0.04, 0.01}, {3e-4, 0.15, 0.01}, {4e-3, 0.15, 0.01}};
constexpr NoiseLevel sheet_waves{4e-3, 0.6, 0.03, true};  // tried last: a sheet with low waves is flat
constexpr double most_worth_noise = 0.1;   // of the area: large regions hold so much more with noise, or half as
                                           // much as at least
constexpr std::size_t fewest_planes = 12;  // of surfaces on which noise is looked for: a box of triangles
constexpr double sharp_edge = 0.94;        // cosine of 20 degrees between the planes on both sides of a crease
constexpr double still_grows = 0.03;       // of the area: a level that holds so much more is better
constexpr double by_chance = 2.5;          // standard deviations of the sum of bends, if their signs are random
constexpr double most_area = 0.6;          // of the area, in regions of several faces: then noise is slight at most
constexpr Index exact_faces = 3;           // of a region
constexpr double most_exact = 0.1;         // of the area, in large regions of so many faces: then it is slight at most

/// The bends of edges, positive where the edge is concave.
struct EdgeBends {
    double sum = 0.0, all = 0.0, square = 0.0;
    Index count = 0;
    void add(double bend)
    {
        ++count;
        sum += bend;
        all += std::abs(bend);
        square += bend * bend;
    }
    /// Whether they go to both sides, as noise does. On a curved surface they go to one.
    bool both_sides() const
    {
        return !(std::abs(sum) > std::max(tolerance::majority * all, by_chance * std::sqrt(square)));
    }
};

struct LargeRegions {
    double share = 0.0;  ///< of the area
    Index count = 0;
};

/// The large regions of several faces. With noise only if their edges bend to both sides, most of
/// their outlines are creases, and heights of neighbours over the plane differ by chance: a wave goes on beyond the
/// region, or lifts neighbours alike. For low waves of a sheet only the bends are asked, those of each region.
LargeRegions large_regions(const CutSurface& surface, const PlanarRegions& regions, const NoiseLevel& level)
{
    std::vector<EdgeBends> bends(regions.planes.size());
    const auto side = [&](Index h, int k) -> Eigen::RowVector3d {
        const Index from = k == 1 ? h : previous_halfedge(h);
        return surface.vertices.row(target(surface.surface.triangles, from)) -
               surface.vertices.row(origin(surface.surface.triangles, from));
    };
    std::vector<double> outline(bends.size(), 0.0), sharp(outline), heights(outline), steps(outline);
    for (Index h = 0; h < static_cast<Index>(surface.surface.twin.size()); ++h) {
        const Index t = surface.surface.twin[h], own = regions.of[face_of(h)];
        const Index other = t == no_twin ? -1 : regions.of[face_of(t)];
        const auto height = [&](Index v) {
            return (surface.vertices.row(v) - regions.planes[own].origin).dot(regions.planes[own].normal);
        };
        const double from = height(origin(surface.surface.triangles, h)),
                     to = height(target(surface.surface.triangles, h));
        heights[own] += from * from;
        steps[own] += (to - from) * (to - from);
        if (own != other) {
            outline[own] += surface.lengths[h];
            if (other < 0 || regions.planes[own].normal.dot(regions.planes[other].normal) < sharp_edge)
                sharp[own] += surface.lengths[h];
        }
        if (t < h || own != other) continue;
        // The signed volume between the faces.
        bends[regions.of[face_of(h)]].add(side(h, 1).cross(-side(h, 0)).dot(side(t, 0)));
    }
    const double whole = surface.areas.sum();
    LargeRegions found;
    EdgeBends together;
    for (std::size_t r = 0; r < bends.size(); ++r) {
        if (!(regions.planes[r].area >= level.large * whole) || bends[r].count == 0) continue;
        const bool rough = steps[r] > heights[r];
        if (level.waves && !(std::abs(bends[r].sum) < tolerance::majority * bends[r].all)) continue;
        if (regions.noise > 0.0 && !(rough && bends[r].both_sides() && sharp[r] > tolerance::majority * outline[r]))
            continue;
        found.share += regions.planes[r].area / whole;
        ++found.count;
        if (bends[r].all > 0.0) together.add(bends[r].sum / bends[r].all * regions.planes[r].area);
    }
    return regions.noise > 0.0 && !together.both_sides() ? LargeRegions{} : found;
}

/// The share of the area in regions of so many faces that are so large.
double share_in_regions(const CutSurface& surface, const PlanarRegions& regions, Index least, double least_area)
{
    std::vector<Index> faces(regions.planes.size(), 0);
    for (const Index region : regions.of) ++faces[region];
    const double whole = surface.areas.sum();
    double share = 0.0;
    for (std::size_t r = 0; r < faces.size(); ++r)
        if (faces[r] >= least && regions.planes[r].area >= least_area * whole) share += regions.planes[r].area / whole;
    return share;
}

}  // namespace

PlanarRegions planar_regions(const CutSurface& surface)
{
    const double diagonal = (surface.vertices.colwise().maxCoeff() - surface.vertices.colwise().minCoeff()).norm();
    PlanarRegions exact = regions_within(surface, stored_digits * diagonal, false);
    if (exact.planes.size() < fewest_planes) return exact;
    const auto at_level = [&](const NoiseLevel& level) {
        PlanarRegions regions = regions_within(surface, level.tolerance * diagonal, !level.waves);
        const LargeRegions large = large_regions(surface, regions, level);
        return std::pair(std::move(regions), large);
    };
    const LargeRegions at_exact = large_regions(surface, exact, noise_levels[0]);
    const auto least_at = [&](const NoiseLevel& level) {
        return std::max(at_exact.share + std::min(most_worth_noise, 0.5 * level.share), level.share);
    };
    const auto is_noisy = [&](const NoiseLevel& level) {
        const LargeRegions large = at_level(level).second;
        const bool joins = large.count < at_exact.count && large.share >= std::max(at_exact.share, level.share);
        return joins || large.share >= least_at(level);
    };
    // Faces of several triangles, or of two on most of the surface, are not in one plane by chance.
    const bool is_flat = share_in_regions(surface, exact, 2, 0.0) >= most_area ||
                         share_in_regions(surface, exact, exact_faces, noise_levels[0].large) >= most_exact;
    if (is_flat ? std::ranges::any_of(slight_noise, is_noisy) : std::ranges::any_of(any_noise, is_noisy)) {
        // The first level at which large regions hold nearly as much as at the next two levels.
        std::optional<PlanarRegions> found;
        LargeRegions most = at_exact;
        int waited = 0;
        for (const NoiseLevel& level : noise_levels) {
            if (waited == 2 || (is_flat && level.tolerance > slight_noise[0].tolerance)) break;
            auto [regions, large] = at_level(level);
            const bool joins = !found && large.count < most.count && large.share >= std::max(most.share, level.share);
            if (!joins && large.share < (found ? std::max(most.share + still_grows, level.share) : least_at(level))) {
                waited += found ? 1 : 0;
                continue;
            }
            found = std::move(regions);
            most = large;
            waited = 0;
        }
        if (found) return std::move(*found);
    }
    if (!is_flat)
        if (auto [regions, large] = at_level(sheet_waves); large.share >= sheet_waves.share) return std::move(regions);
    return exact;
}

}  // namespace koebe
