#include "flat/regions.h"

#include "core/connectivity.h"
#include "core/numbering.h"
#include "cost/tolerances.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <optional>
#include <utility>

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
constexpr double upright = 0.1;            // least cosine between a face's normal and its plane's
constexpr int most_fits = 8;
constexpr double much_larger = 20.0;  // times larger regions have faces beside them that are off by more
constexpr int absorbing_rounds = 8;

class RegionGrowth {
public:
    RegionGrowth(const CutSurface& surface, double tolerance, bool noisy)
        : surface_(surface),
          next_piece_(numbers_below(surface.areas.size())),
          vector_area_(surface.areas.size(), 3),
          least_cosine_(surface.areas.size())
    {
        regions_.tolerance = tolerance;
        if (noisy) regions_.noise = tolerance;
        for (Index f = 0; f < faces(); ++f) {
            vector_area_.row(f) = 0.5 * (corner(f, 1) - corner(f, 0)).cross(corner(f, 2) - corner(f, 0));
            least_cosine_[f] = least_cosine(f, tolerance);
        }
        if (noisy) keep_together(surface.polygon);
        keep_together(surface.face);
    }

    PlanarRegions run()
    {
        regions_.of.assign(static_cast<std::size_t>(faces()), -1);
        std::vector<Index> seeds = numbers_below(regions_.of.size());
        std::ranges::stable_sort(seeds, std::ranges::greater(), [&](Index f) { return surface_.areas[f]; });
        for (const Index seed : seeds)
            if (regions_.of[seed] < 0) add_region(seed);
        for (int round = 0; regions_.noise > 0.0 && round < absorbing_rounds && absorb(); ++round) continue;
        return std::move(regions_);
    }

private:
    Index faces() const { return static_cast<Index>(surface_.areas.size()); }
    Eigen::RowVector3d corner(Index f, int k) const { return surface_.vertices.row(surface_.surface.triangles(f, k)); }

    /// Faces of one number are pieces of one face, if they lie in one plane.
    void keep_together(const std::vector<Index>& number)
    {
        std::map<Index, std::vector<Index>> pieces;
        for (std::size_t f = 0; f < number.size(); ++f)
            if (next_piece_[f] == static_cast<Index>(f)) pieces[number[f]].push_back(static_cast<Index>(f));
        for (const auto& [own, faces] : pieces) {
            const RegionPlane plane = plane_of(faces);
            if (!std::ranges::all_of(faces, [&](Index f) { return lies_in(plane, f); })) continue;
            for (std::size_t i = 0; i < faces.size(); ++i) next_piece_[faces[i]] = faces[(i + 1) % faces.size()];
        }
    }

    /// A vertex off by the tolerance turns a face's normal by the tolerance over the height.
    double least_cosine(Index f, double tolerance) const
    {
        const double longest = surface_.lengths.segment<3>(3 * static_cast<Eigen::Index>(f)).maxCoeff();
        const double angle =
            tolerance::coplanar + 2.0 * tolerance * longest / std::max(2.0 * surface_.areas[f], 1e-300);
        if (angle < 0.5 * std::numbers::pi) return std::max(std::cos(angle), upright);
        return regions_.noise > 0.0 ? -1.0 : upright;  // noise may turn a sliver over
    }

    /// The plane of least squares for faces weighted by area, with their common vector area as its normal.
    RegionPlane plane_of(const std::vector<Index>& own) const
    {
        RegionPlane plane;
        Eigen::RowVector3d sum = Eigen::RowVector3d::Zero(), centre = Eigen::RowVector3d::Zero();
        for (const Index f : own) {
            sum += vector_area_.row(f);
            centre += surface_.areas[f] * (corner(f, 0) + corner(f, 1) + corner(f, 2)) / 3.0;
            plane.area += surface_.areas[f];
        }
        plane.origin = plane.area > 0.0 ? Eigen::RowVector3d(centre / plane.area) : corner(own.front(), 0);
        plane.normal = sum.stableNormalized();
        if (!(plane.normal.squaredNorm() > 0.5)) plane.normal = Eigen::RowVector3d::UnitZ();
        plane.right = plane.normal.unitOrthogonal();
        plane.up = plane.normal.cross(plane.right);
        return plane;
    }

    /// A face with the other pieces of the face that was divided.
    template <class Visit>
    void each_piece(Index f, const Visit& visit) const
    {
        visit(f);
        for (Index g = next_piece_[f]; g != f; g = next_piece_[g]) visit(g);
    }

    bool lies_in(const RegionPlane& plane, Index f) const
    {
        bool all = true;
        each_piece(f, [&](Index g) { all = all && lies_near(plane, g, least_cosine_[g], regions_.tolerance); });
        return all;
    }

    bool lies_near(const RegionPlane& plane, Index f, double cosine, double tolerance) const
    {
        if (vector_area_.row(f).dot(plane.normal) < cosine * surface_.areas[f]) return false;
        for (int k = 0; k < 3; ++k)
            if (!(std::abs((corner(f, k) - plane.origin).dot(plane.normal)) <= tolerance)) return false;
        return true;
    }

    /// Faces beside a much larger region that lie in its plane up to a few times the noise become faces of it: the few
    /// of many faces that are off by more. @return whether there are any
    bool absorb()
    {
        bool any = false;
        for (Index h = 0; h < 3 * faces(); ++h) {
            const Index t = surface_.surface.twin[h], f = face_of(h);
            if (t == no_twin || regions_.of[f] == regions_.of[face_of(t)]) continue;
            const RegionPlane &own = regions_.planes[regions_.of[f]], &other = regions_.planes[regions_.of[face_of(t)]];
            const double most = noise_reach * regions_.noise;
            if (!(other.area > much_larger * own.area)) continue;
            bool all = true;
            each_piece(f, [&](Index g) { all = all && lies_near(other, g, least_cosine(g, most), most); });
            if (!all) continue;
            each_piece(f, [&](Index g) { regions_.of[g] = regions_.of[face_of(t)]; });
            any = true;
        }
        return any;
    }

    /// The faces that lie in this plane and are connected with the seed. They get the number of the next region.
    std::vector<Index> grown(Index seed, const RegionPlane& plane)
    {
        const Index number = static_cast<Index>(regions_.planes.size());
        std::vector<Index> own;
        const auto add = [&](Index f) {
            regions_.of[f] = number;
            own.push_back(f);
        };
        each_piece(seed, add);
        for (std::size_t head = 0; head < own.size(); ++head)
            for (Index h = 3 * own[head]; h < 3 * own[head] + 3; ++h) {
                const Index t = surface_.surface.twin[h];
                if (t == no_twin || regions_.of[face_of(t)] >= 0 || !lies_in(plane, face_of(t))) continue;
                each_piece(face_of(t), add);
            }
        return own;
    }

    void add_region(Index seed)
    {
        std::vector<Index> own;
        each_piece(seed, [&](Index f) { own.push_back(f); });
        const RegionPlane plane = plane_of(own);
        own = grown(seed, plane);
        for (int fit = 0; fit < most_fits && own.size() > 1; ++fit) {
            const RegionPlane fitted = plane_of(own);
            if (!lies_in(fitted, seed)) break;
            for (const Index f : own) regions_.of[f] = -1;
            std::vector<Index> larger = grown(seed, fitted);
            const bool grows = larger.size() > own.size();
            own = std::move(larger);
            if (!grows) break;
        }
        regions_.planes.push_back(plane_of(own));
    }

    const CutSurface& surface_;
    std::vector<Index> next_piece_;  // (F) of the same divided face, in a cycle; of another face itself
    Vertices vector_area_;           // (F, 3)
    VectorXd least_cosine_;          // (F) between a face's normal and the normal of its plane
    PlanarRegions regions_;
};

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
    PlanarRegions exact = RegionGrowth(surface, stored_digits * diagonal, false).run();
    if (exact.planes.size() < fewest_planes) return exact;
    const auto at_level = [&](const NoiseLevel& level) {
        PlanarRegions regions = RegionGrowth(surface, level.tolerance * diagonal, !level.waves).run();
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
