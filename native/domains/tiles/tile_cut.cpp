#include "tiles/tile_cut.h"

#include "core/connectivity.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace koebe {
namespace {

constexpr int tried_origins = 12;  // along each period

Lift operator+(Lift a, Lift b) { return {a[0] + b[0], a[1] + b[1]}; }
Lift operator-(Lift a, Lift b) { return {a[0] - b[0], a[1] - b[1]}; }

/// The other face of a polygon over one of its inner edges, or no_twin.
Index twin_in_polygon(const PeriodicSurface& domain, Index h)
{
    const Index twin = domain.surface.twin[h];
    if (domain.polygon.empty() || twin == no_twin) return no_twin;
    return domain.polygon[face_of(h)] == domain.polygon[face_of(twin)] ? twin : no_twin;
}

/// The lift that moves a face next to its neighbour over a half-edge of that neighbour.
Lift step_over(const PeriodicSurface& domain, const std::vector<Lift>& lift, Index h)
{
    return lift[next_halfedge(h)] - lift[domain.surface.twin[h]];
}

/// (3F) the lifts of the corners that put each polygon's middle in the cell.
std::vector<Lift> lifts_in_cell(const PeriodicSurface& domain, const FlatMap& map, std::array<double, 2> origin)
{
    const Triangles& triangles = domain.surface.triangles;
    std::vector<Lift> lift(static_cast<std::size_t>(triangles.size()));
    std::vector<char> met(static_cast<std::size_t>(triangles.rows()), 0);
    for (Index first = 0; first < static_cast<Index>(triangles.rows()); ++first) {
        if (met[first]) continue;
        met[first] = 1;
        lift[3 * static_cast<std::size_t>(first)] = {0, 0};
        std::vector<Index> starts{3 * first};  // half-edges whose origin has its lift
        Complex sum = 0.0;
        for (std::size_t head = 0; head < starts.size(); ++head) {
            for (Index h = starts[head], k = 0; k < 3; ++k, h = next_halfedge(h)) {
                if (k < 2) lift[next_halfedge(h)] = lift[h] + domain.shift(h);
                sum += lifted(map, map.z[triangles.data()[h]], lift[h]) / 3.0;
            }
            for (Index h = 3 * face_of(starts[head]), k = 0; k < 3; ++k, ++h) {
                const Index twin = twin_in_polygon(domain, h);
                if (twin == no_twin || met[face_of(twin)]) continue;
                met[face_of(twin)] = 1;
                lift[twin] = lift[next_halfedge(h)];
                starts.push_back(twin);
            }
        }
        const auto p = in_periods(map, sum / static_cast<double>(starts.size()));
        Lift back{0, 0};
        for (std::size_t j = 0; j < map.periods.size(); ++j) back[j] = static_cast<int>(std::floor(p[j] - origin[j]));
        for (const Index start : starts)
            for (Index c = 3 * face_of(start), k = 0; k < 3; ++k, ++c) lift[c] = lift[c] - back;
    }
    return lift;
}

/// Moves parts to their neighbours until all are joined, starting with the largest.
void join_parts(const PeriodicSurface& domain, std::vector<Lift>& lift)
{
    const Index face_count = static_cast<Index>(domain.surface.triangles.rows());
    // Parts of the tile between its seams.
    std::vector<Index> part(face_count, -1);
    std::vector<std::vector<Index>> parts;
    for (Index seed = 0; seed < face_count; ++seed) {
        if (part[seed] >= 0) continue;
        std::vector<Index> queue{seed};
        part[seed] = static_cast<Index>(parts.size());
        for (std::size_t head = 0; head < queue.size(); ++head)
            for (Index h = 3 * queue[head]; h < 3 * queue[head] + 3; ++h) {
                if (domain.surface.twin[h] == no_twin || is_seam(domain, lift, h)) continue;
                const Index g = face_of(domain.surface.twin[h]);
                if (part[g] >= 0) continue;
                part[g] = part[seed];
                queue.push_back(g);
            }
        parts.push_back(std::move(queue));
    }
    // From the largest part outwards: each other part moves by the period between it and the part beside it.
    const auto largest = std::ranges::max_element(parts, {}, [](const auto& faces) { return faces.size(); });
    std::vector<char> placed(parts.size(), 0);
    placed[largest - parts.begin()] = 1;
    std::vector<Index> queue = *largest;
    for (std::size_t head = 0; head < queue.size(); ++head)
        for (Index h = 3 * queue[head]; h < 3 * queue[head] + 3; ++h) {
            if (domain.surface.twin[h] == no_twin) continue;
            const Index other = part[face_of(domain.surface.twin[h])];
            if (placed[other]) continue;
            placed[other] = 1;
            const Lift step = step_over(domain, lift, h);
            for (const Index f : parts[other]) {
                for (Index c = 3 * f; c < 3 * f + 3; ++c) lift[c] = lift[c] + step;
                queue.push_back(f);
            }
        }
}

}  // namespace

std::array<double, 2> in_periods(const FlatMap& map, Complex z)
{
    if (map.periods.size() < 2) return {(z / map.periods[0]).real(), 0.0};
    const Complex a = map.periods[0], b = map.periods[1];
    const double area = (std::conj(a) * b).imag();
    return {(std::conj(z) * b).imag() / area, (std::conj(a) * z).imag() / area};
}

Complex lifted(const FlatMap& map, Complex z, Lift lift)
{
    for (std::size_t j = 0; j < map.periods.size(); ++j) z += static_cast<double>(lift[j]) * map.periods[j];
    return z;
}

std::array<double, 2> clear_origin(const PeriodicSurface& domain, const FlatMap& map)
{
    std::array<std::vector<std::pair<double, double>>, 2> spans;  // of each hole along each period
    for (std::size_t k = domain.first_hole; k < domain.loops.size(); ++k) {
        std::array<double, 2> low{1e300, 1e300}, high{-1e300, -1e300};
        for (const Index v : domain.loops[k]) {
            const auto p = in_periods(map, map.z[v]);
            for (int j = 0; j < 2; ++j) {
                low[j] = std::min(low[j], p[j]);
                high[j] = std::max(high[j], p[j]);
            }
        }
        for (int j = 0; j < 2; ++j) spans[j].emplace_back(low[j], high[j]);
    }
    std::array<double, 2> best{0.0, 0.0};
    for (std::size_t j = 0; j < map.periods.size(); ++j) {
        int fewest = std::numeric_limits<int>::max();
        for (int i = 0; i < tried_origins; ++i) {
            const double at = static_cast<double>(i) / tried_origins;
            int cut = 0;
            for (const auto& [low, high] : spans[j]) cut += std::floor(low - at) != std::floor(high - at) ? 1 : 0;
            if (cut >= fewest) continue;
            fewest = cut;
            best[j] = at;
        }
    }
    return best;
}

std::vector<Lift> cut_tile(const PeriodicSurface& domain, const FlatMap& map, std::array<double, 2> origin)
{
    std::vector<Lift> lift = lifts_in_cell(domain, map, origin);
    join_parts(domain, lift);
    return lift;
}

bool is_seam(const PeriodicSurface& domain, const std::vector<Lift>& lift, Index h)
{
    return domain.surface.twin[h] != no_twin && step_over(domain, lift, h) != Lift{0, 0};
}

}  // namespace koebe
