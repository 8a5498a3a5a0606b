#include "lift/even_sites.h"

#include "core/errors.h"
#include "transfer/nearest_triangles.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>
#include <unordered_map>

namespace koebe {
namespace {

constexpr int samples_of_a_site = 64, rounds = 40;  // dimensionless; more change the picture little
constexpr double most_sites = 1e6;

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
};

/// Points at random, equally many per area.
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
        sum[f] = area += length;
    }
    std::vector<Sample> samples(count);
    for (std::size_t i = 0; i < count; ++i) {  // one in each stratum of equal area
        const double at = area * ((static_cast<double>(i) + random.next()) / static_cast<double>(count));
        const auto f = std::min<std::ptrdiff_t>(std::ranges::lower_bound(sum, at) - sum.begin(),
                                                static_cast<std::ptrdiff_t>(sum.size()) - 1);
        const double root = std::sqrt(random.next()), along = random.next();
        samples[i] = {sheet.position_at(static_cast<Index>(f), {1.0 - root, root * (1.0 - along), root * along}),
                      normals[f]};
    }
    for (std::size_t i = count; i > 1; --i)
        std::swap(samples[i - 1], samples[static_cast<std::size_t>(random.next() * static_cast<double>(i))]);
    return samples;
}

/// Squared distance, with the normals' difference as a further direction.
double apart(const Sample& a, const Sample& b, double spacing)
{
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
    std::pair<std::ptrdiff_t, double> nearest(const Sample& sample) const
    {
        std::pair<std::ptrdiff_t, double> best{-1, std::numeric_limits<double>::infinity()};
        const std::array<std::int64_t, 3> middle = cell_of(sample.position);
        for (std::int64_t x = -1; x <= 1; ++x)
            for (std::int64_t y = -1; y <= 1; ++y)
                for (std::int64_t z = -1; z <= 1; ++z) {
                    const auto cell = cells_.find(key({middle[0] + x, middle[1] + y, middle[2] + z}));
                    if (cell == cells_.end()) continue;
                    for (const std::size_t i : cell->second)
                        if (const double d = apart(sample, sites_[i], spacing_); d < best.second)
                            best = {static_cast<std::ptrdiff_t>(i), d};
                }
        return best;
    }

private:
    std::array<std::int64_t, 3> cell_of(const Eigen::RowVector3d& p) const
    {
        return {static_cast<std::int64_t>(std::floor(p[0] / spacing_)),
                static_cast<std::int64_t>(std::floor(p[1] / spacing_)),
                static_cast<std::int64_t>(std::floor(p[2] / spacing_))};
    }
    static std::uint64_t key(const std::array<std::int64_t, 3>& cell)
    {
        std::uint64_t key = 0;
        for (const std::int64_t c : cell) key = (key << 21) ^ (static_cast<std::uint64_t>(c) & 0x1FFFFF);
        return key;
    }

    const std::vector<Sample>& sites_;
    double spacing_;
    std::unordered_map<std::uint64_t, std::vector<std::size_t>> cells_;
};

/// Samples, of which no two are nearer than three quarters of the spacing: as many as there is room for.
std::vector<Sample> first_sites(const std::vector<Sample>& samples, std::size_t count, double spacing)
{
    std::vector<Sample> sites;
    sites.reserve(samples.size());
    SiteGrid grid(sites, spacing);
    for (const Sample& sample : samples) {
        if (sites.size() == count) break;
        if (grid.nearest(sample).second < 0.5625 * spacing * spacing) continue;
        sites.push_back(sample);
        grid.add(sites.size() - 1);
    }
    return sites;
}

/// Moves each site to the mean of its samples.
void relax(std::vector<Sample>& sites, const std::vector<Sample>& samples, double spacing)
{
    const SiteGrid grid(sites, spacing);
    std::vector<Sample> sums(sites.size(), {Eigen::RowVector3d::Zero(), Eigen::RowVector3d::Zero()});
    std::vector<double> counts(sites.size(), 0.0);
    for (const Sample& sample : samples) {
        const std::ptrdiff_t i = grid.nearest(sample).first;
        if (i < 0) continue;
        sums[i].position += sample.position;
        sums[i].normal += sample.normal;
        counts[i] += 1.0;
    }
    for (std::size_t i = 0; i < sites.size(); ++i) {
        if (counts[i] == 0.0) continue;
        sites[i].position = sums[i].position / counts[i];
        const double length = sums[i].normal.norm();
        if (length > 0.0) sites[i].normal = sums[i].normal / length;
    }
}

}  // namespace

std::vector<SurfacePoint> even_sites(const FlatSheet& sheet, double spacing, std::uint64_t seed)
{
    const double wanted = std::round(sheet.area / (spacing * spacing * std::sqrt(0.75)));  // as in a hexagonal lattice
    if (!(wanted < most_sites)) throw InputError("the size is too small for the surface: over a million outlines");
    const auto count = static_cast<std::size_t>(std::max(1.0, wanted));
    RandomNumbers random(seed);
    const std::vector<Sample> samples = random_samples(sheet, count * samples_of_a_site, random);
    std::vector<Sample> sites = first_sites(samples, count, spacing);
    for (int round = 0; round < rounds; ++round) relax(sites, samples, spacing);

    Vertices positions(static_cast<Eigen::Index>(sites.size()), 3);
    for (std::size_t i = 0; i < sites.size(); ++i) positions.row(static_cast<Eigen::Index>(i)) = sites[i].position;
    const PlacesInTriangles places = nearest_triangles(sheet.vertices, sheet.triangles, positions);
    std::vector<SurfacePoint> points(sites.size());
    for (std::size_t i = 0; i < sites.size(); ++i)
        points[i] = {places.face[static_cast<Eigen::Index>(i)], places.weights.row(static_cast<Eigen::Index>(i))};
    return points;
}

}  // namespace koebe
