#include "splitting/mirror_symmetry.h"

#include "mesh/connectivity.h"

#include <Eigen/Eigenvalues>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numeric>
#include <set>
#include <unordered_map>

namespace koebe {
namespace {

constexpr double tolerance = 1e-5;  // of the root of the area
constexpr double worth = 1.5;       // of what the parts cost: symmetric ones may cost so much,
constexpr double little = 0.03;     // or so much more: the whole area 3 % off in texel density, which nobody sees

/// Points of the unit cube by cells as wide as the tolerance.
class Cells {
public:
    explicit Cells(const Vertices& points) : points_(points)
    {
        for (Eigen::Index i = 0; i < points.rows(); ++i)
            cells_[key(cell(points.row(i)))].push_back(static_cast<Index>(i));
    }
    /// The point within the tolerance; -1: none or several.
    Index at(const Eigen::RowVector3d& place) const
    {
        const std::array<long, 3> middle = cell(place);
        Index found = -1;
        for (long x = -1; x <= 1; ++x)
            for (long y = -1; y <= 1; ++y)
                for (long z = -1; z <= 1; ++z) {
                    const auto it = cells_.find(key({middle[0] + x, middle[1] + y, middle[2] + z}));
                    if (it == cells_.end()) continue;
                    for (const Index i : it->second) {
                        if ((points_.row(i) - place).norm() > tolerance) continue;
                        if (found >= 0) return -1;
                        found = i;
                    }
                }
        return found;
    }

private:
    static std::array<long, 3> cell(const Eigen::RowVector3d& place)
    {
        std::array<long, 3> result{};
        for (int k = 0; k < 3; ++k) result[k] = std::lround(std::clamp(place[k] / tolerance, -1e15, 1e15));
        return result;
    }
    static std::uint64_t key(const std::array<long, 3>& at)
    {
        std::uint64_t hash = 0;
        for (const long x : at) hash = (hash ^ static_cast<std::uint64_t>(x)) * 0x9E3779B97F4A7C15ULL;
        return hash;
    }
    const Vertices& points_;
    std::unordered_map<std::uint64_t, std::vector<Index>> cells_;
};

std::vector<Index> numbered_groups(const CutSurface& whole, Index& count)
{
    std::vector<Index> group(static_cast<std::size_t>(whole.areas.size()));
    std::unordered_map<Index, Index> number;
    for (std::size_t f = 0; f < group.size(); ++f)
        group[f] = number
                       .try_emplace(whole.polygon.empty() ? static_cast<Index>(f) : whole.polygon[f],
                                    static_cast<Index>(number.size()))
                       .first->second;
    count = static_cast<Index>(number.size());
    return group;
}

/// The middle of each polygon's vertices, each once: another diagonal changes nothing.
Vertices middles_of(const CutSurface& whole, const std::vector<Index>& group, Index count)
{
    std::vector<std::vector<Index>> corners(count);
    for (std::size_t f = 0; f < group.size(); ++f)
        for (int k = 0; k < 3; ++k)
            corners[group[f]].push_back(whole.surface.triangles(static_cast<Eigen::Index>(f), k));
    Vertices middles = Vertices::Zero(count, 3);
    for (Index g = 0; g < count; ++g) {
        std::ranges::sort(corners[g]);
        corners[g].erase(std::unique(corners[g].begin(), corners[g].end()), corners[g].end());
        for (const Index v : corners[g])
            middles.row(g) += whole.vertices.row(v) / static_cast<double>(corners[g].size());
    }
    return middles;
}

struct Plane {
    Eigen::RowVector3d normal;
    double offset;
};

/// The normal of a mirror is an axis of the spread of the polygons' middles, where no two are alike.
std::vector<Plane> candidates(const Vertices& middles)
{
    const Eigen::RowVector3d low = middles.colwise().minCoeff(), high = middles.colwise().maxCoeff();
    std::vector<Plane> planes;
    for (int k = 0; k < 3; ++k) planes.push_back({Eigen::RowVector3d::Unit(k), 0.5 * (low[k] + high[k])});
    const Eigen::RowVector3d center = middles.colwise().mean();
    const Vertices from_center = middles.rowwise() - center;
    const Eigen::Matrix3d spread = from_center.transpose() * from_center;
    if (!spread.allFinite()) return planes;
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> axes(spread);
    for (int k = 0; k < 3; ++k) {
        const Eigen::RowVector3d normal = axes.eigenvectors().col(k).transpose();
        planes.push_back({normal, normal.dot(center)});
    }
    return planes;
}

double border_of(const CutSurface& whole, const std::vector<PartPointer>& parts)
{
    std::vector<Index> label(static_cast<std::size_t>(whole.areas.size()), -1);
    for (std::size_t k = 0; k < parts.size(); ++k)
        for (const Index f : parts[k]->mesh.faces) label[f] = static_cast<Index>(k);
    double length = 0.0;
    for (Index h = 0; h < static_cast<Index>(whole.surface.twin.size()); ++h) {
        const Index t = whole.surface.twin[h];
        if (t > h && label[face_of(t)] != label[face_of(h)]) length += whole.lengths[h];
    }
    return length;
}

double cost_of(const CutSurface& whole, const SplitOptions& options, const std::vector<PartPointer>& parts)
{
    double cost = options.part_price * static_cast<double>(parts.size()) + options.cut_price * border_of(whole, parts);
    for (const PartPointer& part : parts) cost += part->map.overflow;
    return cost;
}

/// Sets of faces: those of one side as they are in parts, and their images.
std::vector<std::vector<Index>> mirrored_faces(const CutSurface& whole, const Mirror& mirror,
                                               const std::vector<PartPointer>& parts, double chosen)
{
    const std::size_t count = mirror.group.size();
    std::vector<Index> label(mirror.image.size());
    for (std::size_t k = 0; k < parts.size(); ++k)
        for (const Index f : parts[k]->mesh.faces) label[mirror.group[f]] = static_cast<Index>(k);
    const auto own = [&](Index g) { return mirror.image[g] == g || chosen * mirror.side[g] > 0.0; };
    // Faces are joined over an edge if their polygons are in one part on the chosen side, or the images are; over the
    // plane if they were in one part.
    const auto joined = [&](Index a, Index b) {
        if (own(a) && own(b)) return label[a] == label[b];
        if (!own(a) && !own(b)) return label[mirror.image[a]] == label[mirror.image[b]];
        const Index here = own(a) ? a : b, there = own(a) ? b : a, image = mirror.image[there];
        return image == here ? label[here] == label[there] : label[here] == label[image];
    };
    std::vector<std::vector<Index>> pieces;
    std::vector<char> seen(count, 0);
    for (Index seed = 0; seed < static_cast<Index>(count); ++seed) {
        if (seen[seed]) continue;
        std::vector<Index> queue{seed};
        seen[seed] = 1;
        for (std::size_t head = 0; head < queue.size(); ++head)
            for (Index h = 3 * queue[head]; h < 3 * queue[head] + 3; ++h) {
                const Index t = whole.surface.twin[h];
                if (t == no_twin || seen[face_of(t)] || !joined(mirror.group[face_of(h)], mirror.group[face_of(t)]))
                    continue;
                seen[face_of(t)] = 1;
                queue.push_back(face_of(t));
            }
        std::ranges::sort(queue);
        pieces.push_back(std::move(queue));
    }
    return pieces;
}

}  // namespace

Mirror find_mirror(const CutSurface& whole)
{
    Mirror mirror;
    Index count = 0;
    mirror.group = numbered_groups(whole, count);
    const Vertices middles = middles_of(whole, mirror.group, count);
    const Cells cells(middles);
    for (const Plane& plane : candidates(middles)) {
        std::vector<Index> image(count, -1);
        std::vector<double> side(count);
        bool all = true;
        for (Index g = 0; g < count && all; ++g) {
            side[g] = plane.normal.dot(middles.row(g)) - plane.offset;
            image[g] = cells.at(middles.row(g) - 2.0 * side[g] * plane.normal);
            all = image[g] >= 0;
        }
        for (Index g = 0; g < count && all; ++g) all = image[image[g]] == g;
        if (!all) continue;
        mirror.image = std::move(image);
        mirror.side = std::move(side);
        break;
    }
    return mirror;
}

bool make_symmetric(const CutSurface& whole, const SplitOptions& options, const Mirror& mirror,
                    std::vector<PartPointer>& parts, ExecutionContext& context, SplitEffort& effort)
{
    if (mirror.image.empty()) return false;
    if (parts.size() < 2) return true;
    std::map<std::vector<Index>, PartPointer> known;
    for (const PartPointer& part : parts) known.emplace(part->mesh.faces, part);
    const double cost_as_they_are = cost_of(whole, options, parts);
    double best = std::max(worth * cost_as_they_are, cost_as_they_are + little);
    std::vector<PartPointer> chosen;
    for (const double side : {1.0, -1.0}) {
        std::vector<PartPointer> mirrored;
        std::vector<std::vector<Index>> sets = mirrored_faces(whole, mirror, parts, side);
        if (sets.size() == 1 && whole.surface.loops.empty()) continue;  // closed
        for (std::vector<Index>& faces : sets) {
            PartPointer& part = known[faces];
            if (!part) {
                part = std::make_shared<Part>(Part{part_mesh(whole, std::move(faces)), {}, {}});
                map_anew(whole, *part, context, effort);
            }
            mirrored.push_back(part);
        }
        const double cost = cost_of(whole, options, mirrored);
        if (cost >= best) continue;
        best = cost;
        chosen = std::move(mirrored);
    }
    if (chosen.empty()) return false;
    parts = std::move(chosen);
    return true;
}

std::vector<char> mirrored_slits(const CutSurface& whole, const Mirror& mirror, const std::vector<char>& opened)
{
    std::vector<char> slit(whole.surface.twin.size(), 0);
    if (mirror.image.empty()) return slit;
    std::set<std::pair<Index, Index>> images;
    const auto groups = [&](Index h) {
        return std::pair{mirror.group[face_of(h)], mirror.group[face_of(whole.surface.twin[h])]};
    };
    for (Index h = 0; h < static_cast<Index>(slit.size()); ++h) {
        if (whole.surface.twin[h] == no_twin) continue;
        const auto sides = groups(h);
        slit[h] = sides.first != sides.second && mirror.image[sides.first] == sides.second;
        if (opened[h]) images.emplace(mirror.image[sides.first], mirror.image[sides.second]);
    }
    for (Index h = 0; h < static_cast<Index>(slit.size()); ++h)
        if (whole.surface.twin[h] != no_twin && images.contains(groups(h))) slit[h] = 1;
    return slit;
}

}  // namespace koebe
