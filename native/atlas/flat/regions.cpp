#include "flat/regions.h"

#include "core/connectivity.h"
#include "core/numbering.h"
#include "cost/tolerances.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <utility>

namespace koebe {
namespace {

constexpr double least_facing = 0.1;  // least cosine between a face's normal and its plane's
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
        if (angle < 0.5 * std::numbers::pi) return std::max(std::cos(angle), least_facing);
        return regions_.noise > 0.0 ? -1.0 : least_facing;  // noise may turn a sliver over
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

}  // namespace

PlanarRegions regions_within(const CutSurface& surface, double tolerance, bool is_noise)
{
    return RegionGrowth(surface, tolerance, is_noise).run();
}

}  // namespace koebe
