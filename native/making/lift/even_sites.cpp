#include "lift/even_sites.h"

#include "core/errors.h"
#include "execution/thread_share.h"
#include "lift/outline.h"
#include "surface/nearest_triangles.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <unordered_map>

namespace koebe {
namespace {

constexpr int samples_of_a_site = 64, rounds = 40, least_rounds = 8;  // dimensionless; more change the picture little
constexpr double points_of_a_site = 160.0;  // of an outline: the work of a site, with 48 points of a circle
constexpr double few_sites = 3000.0;        // fewer rounds for more of them, so that the work stays in proportion
constexpr double rounding = 1.0 + 1e-6;     // dimensionless: no site is missed for it

/// SplitMix64 [Steele, Lea, Flood 2014]: alike on every machine.
class RandomNumbers {
public:
    explicit RandomNumbers(std::uint64_t seed) : state_(seed) {}
    double next()
    {
        state_ += 0x9E3779B97F4A7C15ULL;
        std::uint64_t z = state_;
        z = (z ^ (z >> 30)) * 0xBF58476D1CE4E5B9ULL;
        z = (z ^ (z >> 27)) * 0x94D049BB133111EBULL;
        return static_cast<double>((z ^ (z >> 31)) >> 11) * 0x1.0p-53;
    }

private:
    std::uint64_t state_;
};

struct Sample {
    Eigen::RowVector3d position, normal;
    double grade = 1.0;  // of the spacing
};

/// The grade in the middle of a face; 0 below the least.
double mean_grade(const FlatSheet& sheet, Index f)
{
    const double grade = sheet.grade_at(f, Eigen::RowVector3d::Constant(1.0 / 3.0));
    return grade < least_grade ? 0.0 : grade;
}

/// Twice the area of a face, as many cells are there as if it were larger by the grade.
double graded_area(double twice_area, double grade) { return grade > 0.0 ? twice_area / (grade * grade) : 0.0; }

/// Points at random, equally many per area, or per cell where the sheet has a grade.
std::vector<Sample> random_samples(const FlatSheet& sheet, std::size_t count, RandomNumbers& random)
{
    std::vector<double> sum(sheet.triangles.rows());
    std::vector<Eigen::RowVector3d> normals(sum.size());
    double area = 0.0;
    for (Index f = 0; f < static_cast<Index>(sum.size()); ++f) {
        const Eigen::RowVector3d a = sheet.vertices.row(sheet.triangles(f, 0));
        const Eigen::RowVector3d b = sheet.vertices.row(sheet.triangles(f, 1)) - a;
        const Eigen::RowVector3d c = sheet.vertices.row(sheet.triangles(f, 2)) - a;
        normals[f] = b.cross(c);
        const double length = normals[f].norm();
        if (length > 0.0) normals[f] /= length;
        sum[f] = area += sheet.grade.empty() ? length : graded_area(length, mean_grade(sheet, f));
    }
    std::vector<Sample> samples(count);
    for (std::size_t i = 0; i < count; ++i) {  // one in each stratum of equal area
        const double at = area * ((static_cast<double>(i) + random.next()) / static_cast<double>(count));
        const auto f = std::min<std::ptrdiff_t>(std::ranges::lower_bound(sum, at) - sum.begin(),
                                                static_cast<std::ptrdiff_t>(sum.size()) - 1);
        const double root = std::sqrt(random.next()), along = random.next();
        const Eigen::RowVector3d weights(1.0 - root, root * (1.0 - along), root * along);
        samples[i] = {sheet.position_at(static_cast<Index>(f), weights), normals[f],
                      std::max(least_grade, sheet.grade_at(static_cast<Index>(f), weights))};
    }
    for (std::size_t i = count; i > 1; --i)
        std::swap(samples[i - 1], samples[static_cast<std::size_t>(random.next() * static_cast<double>(i))]);
    return samples;
}

/// Squared distance of a sample from a site, with the normals' difference as a further direction.
double apart(const Sample& a, const Sample& b, double largest_spacing)
{
    const double spacing = a.grade * largest_spacing;
    return (a.position - b.position).squaredNorm() + spacing * spacing * (1.0 - a.normal.dot(b.normal));
}

/// Sites in cubes of the spacing's size, to find near ones.
class SiteGrid {
public:
    SiteGrid(const std::vector<Sample>& sites, double spacing) : sites_(sites), spacing_(spacing)
    {
        for (std::size_t i = 0; i < sites.size(); ++i) add(i);
    }
    void add(std::size_t site) { cells_[key(cell_of(sites_[site].position))].push_back(site); }
    /// The nearest site in the cubes around a sample, and its squared distance; or no site.
    /// @param guess a site that may be near, or -1: it saves time and changes nothing
    std::pair<std::ptrdiff_t, double> nearest(const Sample& sample, std::ptrdiff_t guess = -1) const
    {
        std::pair<std::ptrdiff_t, double> best{-1, std::numeric_limits<double>::infinity()};
        const Cell middle = cell_of(sample.position);
        const auto away = [&](int axis, std::int64_t step) {  // squared, from the cubes that lie a step away
            const double low = sample.position[axis] - spacing_ * static_cast<double>(middle[axis]);
            return step == 0 ? 0.0 : step < 0 ? low * low : (spacing_ - low) * (spacing_ - low);
        };
        double most = guess >= 0 && beside(middle, cell_of(sites_[guess].position))
                          ? rounding * apart(sample, sites_[guess], spacing_)
                          : best.second;
        for (std::int64_t x = -1; x <= 1; ++x)
            for (std::int64_t y = -1; y <= 1; ++y)
                for (std::int64_t z = -1; z <= 1; ++z) {
                    if (away(0, x) + away(1, y) + away(2, z) > most) continue;
                    const auto cell = cells_.find(key({middle[0] + x, middle[1] + y, middle[2] + z}));
                    if (cell == cells_.end()) continue;
                    for (const std::size_t i : cell->second)
                        if (const double d = apart(sample, sites_[i], spacing_); d < best.second)
                            best = {static_cast<std::ptrdiff_t>(i), d};
                    most = std::min(most, rounding * best.second);
                }
        return best;
    }

private:
    using Cell = std::array<std::int64_t, 3>;

    static bool beside(const Cell& a, const Cell& b)
    {
        return std::abs(a[0] - b[0]) <= 1 && std::abs(a[1] - b[1]) <= 1 && std::abs(a[2] - b[2]) <= 1;
    }
    Cell cell_of(const Eigen::RowVector3d& p) const
    {
        return {static_cast<std::int64_t>(std::floor(p[0] / spacing_)),
                static_cast<std::int64_t>(std::floor(p[1] / spacing_)),
                static_cast<std::int64_t>(std::floor(p[2] / spacing_))};
    }
    static std::uint64_t key(const Cell& cell)
    {
        std::uint64_t key = 0;
        for (const std::int64_t c : cell) key = (key << 21) ^ (static_cast<std::uint64_t>(c) & 0x1FFFFF);
        return key;
    }

    const std::vector<Sample>& sites_;
    double spacing_;
    std::unordered_map<std::uint64_t, std::vector<std::size_t>> cells_;
};

/// Samples, of which no two are nearer than three quarters of their spacing: as many as there is room for.
std::vector<Sample> first_sites(const std::vector<Sample>& samples, std::size_t count, double spacing)
{
    std::vector<Sample> sites;
    sites.reserve(samples.size());
    SiteGrid grid(sites, spacing);
    for (const Sample& sample : samples) {
        if (sites.size() == count) break;
        const double own = sample.grade * spacing;
        if (grid.nearest(sample).second < 0.5625 * own * own) continue;
        sites.push_back(sample);
        grid.add(sites.size() - 1);
    }
    return sites;
}

/// Moves each site to the mean of its samples. Where the spacing is smaller samples count more, as the density of sites
/// is the root of the density of what is spread [Gersho 1979].
/// @param site_of (n) the site of each sample: before, and now
void relax(std::vector<Sample>& sites, const std::vector<Sample>& samples, double spacing,
           std::vector<std::ptrdiff_t>& site_of)
{
    // The nearest site of each sample.
    const SiteGrid grid(sites, spacing);
    in_pieces(samples.size(), 4096, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) site_of[i] = grid.nearest(samples[i], site_of[i]).first;
    });
    // The mean of each site's samples, with the weight 1 / spacing^2.
    std::vector<Sample> sums(sites.size(), {Eigen::RowVector3d::Zero(), Eigen::RowVector3d::Zero(), 0.0});
    std::vector<double> counts(sites.size(), 0.0);
    for (std::size_t s = 0; s < samples.size(); ++s) {
        const std::ptrdiff_t i = site_of[s];
        if (i < 0) continue;
        const double weight = 1.0 / (samples[s].grade * samples[s].grade);
        sums[i].position += weight * samples[s].position;
        sums[i].normal += weight * samples[s].normal;
        sums[i].grade += weight * samples[s].grade;
        counts[i] += weight;
    }
    for (std::size_t i = 0; i < sites.size(); ++i) {
        if (counts[i] == 0.0) continue;
        sites[i].position = sums[i].position / counts[i];
        sites[i].grade = sums[i].grade / counts[i];
        const double length = sums[i].normal.norm();
        if (length > 0.0) sites[i].normal = sums[i].normal / length;
    }
}

/// The surface's area, where it has a grade counted in cells of the size asked for. @throws InputError there is none
double cell_area(const FlatSheet& sheet)
{
    if (sheet.grade.empty()) return sheet.area;
    double area = 0.0;
    for (Index f = 0; f < static_cast<Index>(sheet.triangles.rows()); ++f) {
        const Eigen::RowVector3d a = sheet.vertices.row(sheet.triangles(f, 0));
        const Eigen::RowVector3d b = sheet.vertices.row(sheet.triangles(f, 1)) - a;
        const Eigen::RowVector3d c = sheet.vertices.row(sheet.triangles(f, 2)) - a;
        area += 0.5 * graded_area(b.cross(c).norm(), mean_grade(sheet, f));
    }
    if (!(area > 0.0)) throw InputError("no outline is drawn: graded is below 0.1 everywhere");
    return area;
}

}  // namespace

std::vector<SurfacePoint> even_sites(const FlatSheet& sheet, double spacing, std::uint64_t seed)
{
    const double wanted = std::round(cell_area(sheet) / (spacing * spacing * std::sqrt(0.75)));  // hexagonal lattice
    require_few_outlines(wanted, wanted * points_of_a_site, "the distance of the outlines' middles");
    const auto count = static_cast<std::size_t>(std::max(1.0, wanted));
    RandomNumbers random(seed);
    const std::vector<Sample> samples = random_samples(sheet, count * samples_of_a_site, random);
    std::vector<Sample> sites = first_sites(samples, count, spacing);
    std::vector<std::ptrdiff_t> site_of(samples.size(), -1);
    const int enough = std::max(least_rounds, static_cast<int>(rounds * std::min(1.0, few_sites / wanted)));
    for (int round = 0; round < enough; ++round) relax(sites, samples, spacing, site_of);

    Vertices positions(static_cast<Eigen::Index>(sites.size()), 3);
    for (std::size_t i = 0; i < sites.size(); ++i) positions.row(static_cast<Eigen::Index>(i)) = sites[i].position;
    const PlacesInTriangles places = nearest_triangles(sheet.vertices, sheet.triangles, positions);
    std::vector<SurfacePoint> points(sites.size());
    for (std::size_t i = 0; i < sites.size(); ++i)
        points[i] = {places.face[static_cast<Eigen::Index>(i)], places.weights.row(static_cast<Eigen::Index>(i))};
    return points;
}

}  // namespace koebe
