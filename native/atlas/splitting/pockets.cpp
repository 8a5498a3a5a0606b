#include "splitting/pockets.h"

#include "core/connectivity.h"
#include "core/length.h"
#include "core/numbering.h"
#include "cost/costs.h"
#include "splitting/dual_cut.h"
#include "surface/ambient_visibility.h"

#include <algorithm>
#include <cstddef>
#include <map>
#include <utility>

namespace koebe {
namespace {

/// (F) What is seen of each face, in the mean of its polygon.
VectorXd seen_of_faces(const PartMesh& all)
{
    const Triangles& triangles = all.surface.triangles;
    const VectorXd seen = ambient_visibility(all.vertices, triangles);
    VectorXd own(triangles.rows());
    for (Eigen::Index f = 0; f < own.size(); ++f)
        own[f] = (seen[triangles(f, 0)] + seen[triangles(f, 1)] + seen[triangles(f, 2)]) / 3.0;
    if (all.polygon.empty()) return own;
    std::map<Index, std::pair<double, int>> sums;
    for (Eigen::Index f = 0; f < own.size(); ++f) {
        auto& [sum, faces] = sums[all.polygon[static_cast<std::size_t>(f)]];
        sum += own[f];
        ++faces;
    }
    for (Eigen::Index f = 0; f < own.size(); ++f) {
        const auto& [sum, faces] = sums.at(all.polygon[static_cast<std::size_t>(f)]);
        own[f] = sum / faces;
    }
    return own;
}

/// (F) 1 in connected regions of label 1 that are large, and deep behind their rim: area > pocket_depth rim^2.
std::vector<int> only_pockets(const PartMesh& all, const std::vector<int>& label)
{
    Index count = 0;
    const std::vector<Index> piece = connected_pieces(all, label, count);
    std::vector<double> area(static_cast<std::size_t>(count), 0.0), rim = area;
    const Surface& surface = all.surface;
    for (std::size_t f = 0; f < piece.size(); ++f) area[piece[f]] += all.areas[static_cast<Eigen::Index>(f)];
    for (Index h = 0; h < static_cast<Index>(surface.twin.size()); ++h) {
        const Index t = surface.twin[h];
        if (t != no_twin && piece[face_of(h)] != piece[face_of(t)])
            rim[piece[face_of(h)]] += length_of(all.vertices.row(origin(surface.triangles, h)) -
                                                all.vertices.row(target(surface.triangles, h)));
    }
    std::vector<int> pocket(label.size());
    for (std::size_t f = 0; f < label.size(); ++f) {
        const double own = area[piece[f]], around = rim[piece[f]];
        pocket[f] = label[f] == 1 && around > 0.0 && own > tuning::pocket_depth * around * around &&
                    own > tuning::least_pocket && own < 0.5 * all.area;
    }
    return pocket;
}

}  // namespace

std::vector<std::array<Index, 2>> pocket_rims(const CutSurface& whole)
{
    // Hidden regions that are deep.
    const PartMesh all = some_or_all(whole, numbers_below(whole.areas.size()));
    const VectorXd seen = seen_of_faces(all);
    std::vector<int> hidden(all.faces.size());
    for (std::size_t f = 0; f < hidden.size(); ++f)
        hidden[f] = seen[static_cast<Eigen::Index>(f)] < tuning::pocket_seen;
    const std::vector<int> deep = only_pockets(all, hidden);
    if (std::ranges::count(deep, 1) == 0) return {};

    // The rim is the minimum cut between their depths and what is seen. A cut costs its length times what is seen
    // there.
    std::vector<Side> sides(deep.size(), Side::free);
    for (std::size_t f = 0; f < deep.size(); ++f) {
        const double own = seen[static_cast<Eigen::Index>(f)];
        if (deep[f] == 1 && own < 0.5 * tuning::pocket_seen) sides[f] = Side::inside;
        if (own > 2.0 * tuning::pocket_seen || (hidden[f] == 1 && deep[f] == 0)) sides[f] = Side::outside;
    }
    const Surface& surface = all.surface;
    VectorXd factor(static_cast<Eigen::Index>(surface.twin.size()));
    for (Index h = 0; h < static_cast<Index>(factor.size()); ++h) {
        const Index t = surface.twin[h] == no_twin ? h : surface.twin[h];
        factor[h] = (tuning::least_seen + 0.5 * (seen[face_of(h)] + seen[face_of(t)])) *
                    price_of_edge(all.shown, origin(surface.triangles, h), target(surface.triangles, h));
    }
    const std::vector<int> cut = minimum_cut(all, sides, factor);
    if (cut.empty()) return {};
    const std::vector<int> pocket = only_pockets(all, cut);
    std::vector<std::array<Index, 2>> rims;
    for (Index h = 0; h < static_cast<Index>(factor.size()); ++h) {
        const Index t = surface.twin[h];
        if (t != no_twin && h < t && pocket[face_of(h)] != pocket[face_of(t)])
            rims.push_back({all.original[origin(surface.triangles, h)], all.original[target(surface.triangles, h)]});
    }
    return rims;
}

}  // namespace koebe
