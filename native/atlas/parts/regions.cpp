#include "parts/regions.h"

#include "core/connectivity.h"
#include "cost/tolerances.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

namespace koebe {
namespace {

constexpr double stored_digits = 1e-5;  // in the diagonal of the surface's box: coordinates with five digits
/// A level of noise: the tolerance in that unit, and the share of the area in large regions from which it is taken. A
/// patch of a ball is no large region at the first level.
struct NoiseLevel {
    double tolerance, share;
};
constexpr NoiseLevel noise_levels[] = {{3e-4, 0.25}, {4e-3, 0.6}};  // a coarse scan, noise of 0.1 %
constexpr double large_region = 0.03;                               // of the area: noise hides no smaller region
constexpr double most_area = 0.6;  // of the area, in regions of several faces: then there is no noise
constexpr double upright = 0.1;    // least cosine between a face's normal and its plane's
constexpr int most_fits = 8;

class RegionGrowth {
public:
    RegionGrowth(const CutSurface& surface, double tolerance)
        : surface_(surface), vector_area_(surface.areas.size(), 3), least_cosine_(surface.areas.size())
    {
        regions_.tolerance = tolerance;
        for (Index f = 0; f < faces(); ++f) {
            vector_area_.row(f) = 0.5 * (corner(f, 1) - corner(f, 0)).cross(corner(f, 2) - corner(f, 0));
            // A vertex off by the tolerance turns the normal by the tolerance over the height.
            const double longest = surface.lengths.segment<3>(3 * static_cast<Eigen::Index>(f)).maxCoeff();
            const double angle =
                tolerance::coplanar + 2.0 * tolerance * longest / std::max(2.0 * surface.areas[f], 1e-300);
            least_cosine_[f] = angle < 0.5 * std::numbers::pi ? std::max(std::cos(angle), upright) : upright;
        }
    }

    PlanarRegions run()
    {
        regions_.of.assign(static_cast<std::size_t>(faces()), -1);
        std::vector<Index> seeds(regions_.of.size());
        std::iota(seeds.begin(), seeds.end(), 0);
        std::ranges::stable_sort(seeds, std::ranges::greater(), [&](Index f) { return surface_.areas[f]; });
        for (const Index seed : seeds)
            if (regions_.of[seed] < 0) add_region(seed);
        return std::move(regions_);
    }

private:
    Index faces() const { return static_cast<Index>(surface_.areas.size()); }
    Eigen::RowVector3d corner(Index f, int k) const { return surface_.vertices.row(surface_.surface.triangles(f, k)); }

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

    bool lies_in(const RegionPlane& plane, Index f) const
    {
        if (vector_area_.row(f).dot(plane.normal) < least_cosine_[f] * surface_.areas[f]) return false;
        for (int k = 0; k < 3; ++k)
            if (!(std::abs((corner(f, k) - plane.origin).dot(plane.normal)) <= regions_.tolerance)) return false;
        return true;
    }

    /// The faces that lie in this plane and are connected with the seed. They get the number of the next region.
    std::vector<Index> grown(Index seed, const RegionPlane& plane)
    {
        const Index number = static_cast<Index>(regions_.planes.size());
        std::vector<Index> own{seed};
        regions_.of[seed] = number;
        for (std::size_t head = 0; head < own.size(); ++head)
            for (Index h = 3 * own[head]; h < 3 * own[head] + 3; ++h) {
                const Index t = surface_.surface.twin[h];
                if (t == no_twin || regions_.of[face_of(t)] >= 0 || !lies_in(plane, face_of(t))) continue;
                regions_.of[face_of(t)] = number;
                own.push_back(face_of(t));
            }
        return own;
    }

    void add_region(Index seed)
    {
        RegionPlane plane = plane_of({seed});
        std::vector<Index> own = grown(seed, plane);
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
    Vertices vector_area_;   // (F, 3)
    VectorXd least_cosine_;  // (F) between a face's normal and the normal of its plane
    PlanarRegions regions_;
};

/// The share of the area in large regions whose edges bend to both sides: noise. On a curved surface they bend to one.
double noisy_share(const CutSurface& surface, const PlanarRegions& regions)
{
    std::vector<double> sum(regions.planes.size(), 0.0), all(sum);
    const auto side = [&](Index h, int k) -> Eigen::RowVector3d {
        const Index from = k == 1 ? h : previous_halfedge(h);
        return surface.vertices.row(target(surface.surface.triangles, from)) -
               surface.vertices.row(origin(surface.surface.triangles, from));
    };
    for (Index h = 0; h < static_cast<Index>(surface.surface.twin.size()); ++h) {
        const Index t = surface.surface.twin[h];
        if (t < h || regions.of[face_of(h)] != regions.of[face_of(t)]) continue;
        // The signed volume between the faces: positive where the edge is concave.
        const double bend = side(h, 1).cross(-side(h, 0)).dot(side(t, 0));
        sum[regions.of[face_of(h)]] += bend;
        all[regions.of[face_of(h)]] += std::abs(bend);
    }
    const double whole = surface.areas.sum();
    double share = 0.0;
    for (std::size_t r = 0; r < sum.size(); ++r)
        if (regions.planes[r].area >= large_region * whole && std::abs(sum[r]) < tolerance::majority * all[r])
            share += regions.planes[r].area;
    return share / whole;
}

/// The share of the area in regions of several faces, or large ones.
double flat_share(const CutSurface& surface, const PlanarRegions& regions)
{
    std::vector<Index> faces(regions.planes.size(), 0);
    for (const Index region : regions.of) ++faces[region];
    const double whole = surface.areas.sum();
    double share = 0.0;
    for (std::size_t r = 0; r < faces.size(); ++r)
        if (faces[r] > 1 || regions.planes[r].area >= large_region * whole) share += regions.planes[r].area;
    return share / whole;
}

}  // namespace

PlanarRegions planar_regions(const CutSurface& surface)
{
    const double diagonal = (surface.vertices.colwise().maxCoeff() - surface.vertices.colwise().minCoeff()).norm();
    PlanarRegions exact = RegionGrowth(surface, stored_digits * diagonal).run();
    if (flat_share(surface, exact) >= most_area) return exact;
    for (const auto& [tolerance, share] : noise_levels)
        if (PlanarRegions noisy = RegionGrowth(surface, tolerance * diagonal).run();
            noisy_share(surface, noisy) >= share)
            return noisy;
    return exact;
}

}  // namespace koebe
