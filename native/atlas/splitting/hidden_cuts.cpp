#include "splitting/hidden_cuts.h"

#include "core/connectivity.h"
#include "core/errors.h"
#include "cost/costs.h"
#include "execution/profile.h"
#include "execution/side_by_side.h"
#include "mesh/nearest_first.h"
#include "splitting/concavity.h"
#include "splitting/dual_cut.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <utility>

namespace koebe {
namespace {

/// Distance of each face from the border, from middle to middle; the nearest first. @param label (F) 0 and 1
std::vector<double> border_distance(const PartMesh& both, const std::vector<int>& label)
{
    const Triangles& triangles = both.surface.triangles;
    const auto middle = [&](Index f) {
        return ((both.vertices.row(triangles(f, 0)) + both.vertices.row(triangles(f, 1)) +
                 both.vertices.row(triangles(f, 2))) /
                3.0)
            .eval();
    };
    NearestFirst nearest(static_cast<Index>(label.size()));
    for (Index h = 0; h < static_cast<Index>(both.surface.twin.size()); ++h)
        if (const Index t = both.surface.twin[h]; t != no_twin && label[face_of(t)] != label[face_of(h)])
            nearest.reach(face_of(h), 0.5 * (middle(face_of(h)) - middle(face_of(t))).norm());
    for (Index f = nearest.take(); f >= 0; f = nearest.take())
        for (Index h = 3 * f; h < 3 * f + 3; ++h)
            if (const Index t = both.surface.twin[h]; t != no_twin)
                nearest.reach(face_of(t), nearest.distance()[f] + (middle(f) - middle(face_of(t))).norm());
    return nearest.distance();
}

/// The width within which neither part loses too much.
double band_width(const PartMesh& both, const std::vector<int>& label, const std::vector<double>& distance)
{
    double width = tuning::hidden_band;
    for (const int side : {0, 1}) {
        std::vector<std::pair<double, double>> order;
        double whole = 0.0, passed = 0.0;
        for (std::size_t f = 0; f < label.size(); ++f)
            if (label[f] == side) {
                order.emplace_back(distance[f], both.areas[static_cast<Eigen::Index>(f)]);
                whole += order.back().second;
            }
        std::ranges::sort(order);
        for (const auto& [d, area] : order) {
            passed += area;
            if (passed > (1.0 - tuning::hidden_core) * whole) {
                width = std::min(width, d);
                break;
            }
        }
    }
    return width;
}

/// Factors on the lengths of edges (3F), by their curvature and by what is shown. Outside the band curvature counts
/// not.
VectorXd visibility(const PartMesh& both, const VectorXd& curvature, const std::vector<char>& in_band)
{
    const Triangles& triangles = both.surface.triangles;
    const auto of_edge = [&](Index h) {
        return 0.5 * (curvature[both.original[origin(triangles, h)]] + curvature[both.original[target(triangles, h)]]);
    };
    double sum = 0.0, squares = 0.0, count = 0.0;
    for (Index h = 0; h < static_cast<Index>(triangles.size()); ++h)
        if (in_band[face_of(h)]) {
            sum += of_edge(h);
            squares += of_edge(h) * of_edge(h);
            count += 1.0;
        }
    VectorXd factor(triangles.size());
    for (Index h = 0; h < static_cast<Index>(triangles.size()); ++h)
        factor[h] = price_of_edge(both.shown, origin(triangles, h), target(triangles, h));
    if (count == 0.0) return factor;
    const double mean = sum / count, deviation = std::sqrt(std::max(squares / count - mean * mean, 0.0));
    if (!(deviation > 0.0)) return factor;
    for (Index h = 0; h < static_cast<Index>(triangles.size()); ++h)
        factor[h] *= hollow_factor((of_edge(h) - mean) / deviation);
    return factor;
}

struct BorderCost {
    double length = 0.0;
    double shown = 0.0;  // longer where the surface is shown
    double seen = 0.0;   // with the factors
};

BorderCost border_cost(const PartMesh& both, const std::vector<int>& label, const VectorXd& factor)
{
    BorderCost cost;
    for (Index h = 0; h < static_cast<Index>(both.surface.twin.size()); ++h) {
        const Index t = both.surface.twin[h];
        if (t == no_twin || t < h || label[face_of(t)] == label[face_of(h)]) continue;
        const Index a = origin(both.surface.triangles, h), b = target(both.surface.triangles, h);
        const double length = (both.vertices.row(a) - both.vertices.row(b)).norm();
        cost.length += length;
        cost.shown += length * price_of_edge(both.shown, a, b);
        cost.seen += length * factor[h];
    }
    return cost;
}

/// Whether the parts share an edge: an earlier move may have separated them.
bool are_neighbours(const CutSurface& whole, const Part& a, const Part& b)
{
    return std::ranges::any_of(a.mesh.faces, [&](Index f) {
        for (Index h = 3 * f; h < 3 * f + 3; ++h)
            if (const Index t = whole.surface.twin[h];
                t != no_twin && std::ranges::binary_search(b.mesh.faces, face_of(t)))
                return true;
        return false;
    });
}

/// The two parts with a new border; empty if that is no better.
std::pair<PartPointer, PartPointer> moved_border(const CutSurface& whole, const SplitOptions& options,
                                                 const VectorXd& curvature, const Part& a, const Part& b,
                                                 ExecutionContext& context, SplitEffort& effort)
{
    if (!are_neighbours(whole, a, b)) return {};
    std::vector<Index> faces = a.mesh.faces;
    faces.insert(faces.end(), b.mesh.faces.begin(), b.mesh.faces.end());
    const PartMesh both = some_or_all(whole, std::move(faces));
    // The border may move in a band beside it.
    std::vector<int> label;
    for (const Index f : both.faces) label.push_back(std::ranges::binary_search(a.mesh.faces, f));
    const std::vector<double> distance = border_distance(both, label);
    const double width = band_width(both, label, distance);
    std::vector<Side> sides(label.size(), Side::free);
    std::vector<char> in_band(label.size(), 1);
    for (std::size_t f = 0; f < label.size(); ++f)
        if (distance[f] >= width) {
            sides[f] = label[f] ? Side::inside : Side::outside;
            in_band[f] = 0;
        }
    // It becomes the cut of least weighted length there, if that is worth it: not longer, no more pieces or loops.
    const VectorXd factor = visibility(both, curvature, in_band);
    const std::vector<int> cut = minimum_cut(both, sides, factor);
    if (cut.empty() || cut == label) return {};
    const BorderCost before = border_cost(both, label, factor), after = border_cost(both, cut, factor);
    if (!(after.seen < (1.0 - tuning::noticeable) * before.seen) ||
        after.shown > (1.0 + tuning::noticeable) * before.shown)
        return {};
    Index pieces = 0;
    connected_pieces(both, cut, pieces);
    if (pieces != 2) return {};
    std::vector<Index> own[2];
    for (std::size_t f = 0; f < cut.size(); ++f) own[cut[f]].push_back(both.faces[f]);
    auto first = std::make_shared<Part>(Part{part_mesh(whole, std::move(own[1])), {}, {}});
    auto second = std::make_shared<Part>(Part{part_mesh(whole, std::move(own[0])), {}, {}});
    if (first->mesh.surface.loops.size() != a.mesh.surface.loops.size() ||
        second->mesh.surface.loops.size() != b.mesh.surface.loops.size())
        return {};
    // The parts may cost a little more.
    map_anew(whole, *first, context, effort);
    map_anew(whole, *second, context, effort);
    const double gain = a.map.overflow + b.map.overflow - first->map.overflow - second->map.overflow +
                        options.of(0.0, before.length - after.length);
    const bool loses = first->map.lost_area + second->map.lost_area > a.map.lost_area + b.map.lost_area;
    if (loses || gain < -tuning::little_price * options.part_price) return {};
    return {first, second};
}

using Borders = std::vector<std::pair<int, int>>;

/// Borders between parts, the longest first.
Borders longest_borders(const CutSurface& whole, const std::vector<PartPointer>& parts)
{
    std::vector<int> label(static_cast<std::size_t>(whole.areas.size()), -1);
    for (std::size_t k = 0; k < parts.size(); ++k)
        for (const Index f : parts[k]->mesh.faces) label[f] = static_cast<int>(k);
    std::map<std::pair<int, int>, double> lengths;
    for (Index h = 0; h < static_cast<Index>(whole.surface.twin.size()); ++h) {
        const Index t = whole.surface.twin[h];
        if (t == no_twin || t < h || label[face_of(h)] == label[face_of(t)]) continue;
        lengths[std::minmax(label[face_of(h)], label[face_of(t)])] += whole.lengths[h];
    }
    std::vector<std::pair<double, std::pair<int, int>>> order;
    for (const auto& [pair, length] : lengths) order.emplace_back(length, pair);
    std::ranges::sort(order, std::greater<>());
    Borders borders;
    for (const auto& [length, pair] : order) borders.push_back(pair);
    return borders;
}

/// Takes out the borders that share no part with an earlier border. Done side by side, their result is the same as one
/// after the other.
Borders next_borders(Borders& borders)
{
    std::set<int> taken;
    Borders next;
    std::erase_if(borders, [&](const std::pair<int, int>& border) {
        const bool ready = !taken.contains(border.first) && !taken.contains(border.second);
        taken.insert({border.first, border.second});
        if (ready) next.push_back(border);
        return ready;
    });
    return next;
}

}  // namespace

void hide_cuts(const CutSurface& whole, const SplitOptions& options, std::vector<PartPointer>& parts,
               ExecutionContext& context, SplitEffort& effort)
{
    const ProfiledStage profiled("hidden cuts");
    if (parts.size() < 2) return;
    const VectorXd curvature = mean_curvature(whole, tuning::hollow_scale);
    for (Borders borders = longest_borders(whole, parts); !borders.empty();) {
        const Borders wave = next_borders(borders);
        std::vector<std::pair<PartPointer, PartPointer>> moved(wave.size());
        std::vector<SplitEffort> efforts(wave.size());
        side_by_side(wave.size(), options.threads, context, [&](std::size_t i, ExecutionContext& own) {
            own.checkpoint();
            moved[i] =
                moved_border(whole, options, curvature, *parts[wave[i].first], *parts[wave[i].second], own, efforts[i]);
        });
        for (std::size_t i = 0; i < wave.size(); ++i) {
            effort.maps += efforts[i].maps;
            if (!moved[i].first) continue;
            parts[wave[i].first] = std::move(moved[i].first);
            parts[wave[i].second] = std::move(moved[i].second);
        }
    }
}

}  // namespace koebe
