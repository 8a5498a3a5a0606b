#include "hard/chart_islands.h"

#include "core/numbering.h"
#include "cost/tuning.h"
#include "cut/disjoint_sets.h"
#include "planar/planar_predicates.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <utility>

namespace koebe {
namespace {

constexpr double thin = 0.2;     // charts whose area over the square of the length is less are cut across;
constexpr double middle = 1e-6;  // of a piece: a region so near to its end belongs to the next piece

}  // namespace

ChartIslands::ChartIslands(const CutSurface& surface, FlatCharts charts)
    : surface_(surface),
      charts_(std::move(charts)),
      islands_(charts_.faces),
      parts_(std::move(charts_.parts)),
      island_(numbers_below(islands_.size())),
      chart_(static_cast<std::size_t>(surface.areas.size()), -1)
{
    for (std::size_t k = 0; k < islands_.size(); ++k)
        for (const Index f : islands_[k]) chart_[f] = static_cast<Index>(k);
}

double ChartIslands::extent(const std::vector<Index>& faces, Complex* direction) const
{
    Complex most = 0.0;
    for (const Index f : faces)
        for (Index h = 3 * f; h < 3 * f + 3; ++h) {
            const Complex edge = charts_.at[next_halfedge(h)] - charts_.at[h], square = edge * edge;
            const double length = std::abs(edge);
            if (charts_.net.twin[h] == no_twin && length > 0.0) most += square * square / (length * length * length);
        }
    Complex along = std::polar(1.0, 0.25 * std::arg(most));
    PlanarPoints points(3 * static_cast<Eigen::Index>(faces.size()), 2);
    Eigen::Index row = 0;
    for (const Index f : faces)
        for (Index h = 3 * f; h < 3 * f + 3; ++h)
            points.row(row++) << dot(along, charts_.at[h]), cross(along, charts_.at[h]);
    const Eigen::RowVector2d size = box_size(points);
    if (size[1] > size[0]) along *= Complex(0.0, 1.0);
    if (direction != nullptr) *direction = along;
    return size.maxCoeff();
}

void ChartIslands::cut_strips()
{
    for (std::size_t k = 0, count = islands_.size(); k < count; ++k) {
        Complex along;
        const double length = extent(islands_[k], &along);
        if (length > tuning::longest_hard && surface_.areas(islands_[k]).sum() < thin * length * length)
            cut_strip(k, along, static_cast<int>(std::ceil(length / tuning::longest_hard)));
    }
}

/// Cuts a chart into equally long pieces. Nothing changes if it falls into more pieces, or does not get shorter.
void ChartIslands::cut_strip(std::size_t chart, const Complex& along, int count)
{
    // The place of each planar region along the strip decides its piece.
    const std::vector<Index> faces = islands_[chart];
    std::map<Index, std::pair<double, double>> regions;  // area, and its first moment
    double low = std::numeric_limits<double>::infinity(), high = -low;
    for (const Index f : faces)
        for (Index h = 3 * f; h < 3 * f + 3; ++h) {
            const double place = dot(along, charts_.at[h]);
            low = std::min(low, place);
            high = std::max(high, place);
            regions[charts_.region[f]].first += surface_.areas[f];
            regions[charts_.region[f]].second += surface_.areas[f] * place;
        }
    const auto piece = [&](Index h) {
        const auto& [area, moment] = regions.at(charts_.region[face_of(h)]);
        const double place = area > 0.0 ? (moment / area - low) / (high - low) : 0.0;
        return std::clamp(static_cast<int>(count * place + middle), 0, count - 1);
    };
    std::vector<Index> cuts;
    DisjointSets sets(faces.size());
    const auto number = [&](Index h) {
        return static_cast<Index>(std::ranges::lower_bound(faces, face_of(h)) - faces.begin());
    };
    for (const Index f : faces)
        for (Index h = 3 * f; h < 3 * f + 3; ++h) {
            const Index t = charts_.net.twin[h];
            if (t == no_twin) continue;
            if (piece(h) == piece(t)) sets.join(number(h), number(t));
            if (piece(h) < piece(t)) cuts.push_back(h);
        }
    std::map<Index, std::vector<Index>> pieces;
    for (const Index f : faces) pieces[sets.find(number(3 * f))].push_back(f);
    if (static_cast<int>(pieces.size()) != count ||
        std::ranges::any_of(cuts, [&](Index h) { return charts_.net.whole[h] != 0; }))
        return;
    for (const Index h : cuts) charts_.net.cut(h);
    std::vector<FlatPart> parts;
    for (const auto& [root, own] : pieces) {
        auto part = part_of(own);
        if (!part || extent(own) > tuning::longest_hard) break;
        parts.push_back(std::move(*part));
    }
    if (parts.size() != pieces.size()) {
        for (const Index h : cuts) charts_.net.join(h, twin(h));
        return;
    }
    auto at = parts.begin();
    for (const auto& [root, own] : pieces) {
        if (at == parts.begin()) {
            islands_[chart] = own;
            parts_[chart] = std::move(*at++);
            continue;
        }
        for (const Index f : own) chart_[f] = static_cast<Index>(islands_.size());
        island_.push_back(static_cast<Index>(islands_.size()));
        islands_.push_back(own);
        parts_.push_back(std::move(*at++));
    }
}

}  // namespace koebe
