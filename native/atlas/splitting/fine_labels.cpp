#include "splitting/fine_labels.h"

#include "core/connectivity.h"
#include "splitting/dual_cut.h"

#include <algorithm>
#include <map>
#include <utility>

namespace koebe {
namespace {

constexpr int none = -1;

/// The labels of faces that the cuts do not come near: all three corners were drawn to vertices inside one coarse part.
std::vector<int> sure_labels(const CutSurface& whole, const CoarseSurface& coarse, const std::vector<int>& label)
{
    constexpr int unset = -2;
    std::vector<int> inside(static_cast<std::size_t>(coarse.vertices.rows()), unset);
    for (std::size_t f = 0; f < label.size(); ++f)
        for (int k = 0; k < 3; ++k) {
            int& own = inside[coarse.triangles(static_cast<Eigen::Index>(f), k)];
            own = own == unset || own == label[f] ? label[f] : none;
        }
    std::vector<int> sure(static_cast<std::size_t>(whole.areas.size()), none);
    std::vector<char> any(label.size() + 1, 0);
    for (std::size_t f = 0; f < sure.size(); ++f) {
        const auto row = whole.surface.triangles.row(static_cast<Eigen::Index>(f));
        const int a = inside[coarse.vertex_at[row[0]]];
        if (a >= 0 && a == inside[coarse.vertex_at[row[1]]] && a == inside[coarse.vertex_at[row[2]]]) {
            sure[f] = a;
            any[a] = 1;
        }
    }
    // A part without an inside is held by the faces that stayed.
    for (std::size_t f = 0; f < label.size(); ++f)
        if (!any[label[f]]) sure[coarse.face[f]] = label[f];
    return sure;
}

/// Unlabelled faces take the label that reaches them first.
std::vector<int> grown(const CutSurface& whole, std::vector<int> label)
{
    std::vector<Index> queue;
    for (std::size_t f = 0; f < label.size(); ++f)
        if (label[f] >= 0) queue.push_back(static_cast<Index>(f));
    for (std::size_t head = 0; head < queue.size(); ++head)
        for (Index h = 3 * queue[head]; h < 3 * queue[head] + 3; ++h)
            if (const Index t = whole.surface.twin[h]; t != no_twin && label[face_of(t)] < 0) {
                label[face_of(t)] = label[queue[head]];
                queue.push_back(face_of(t));
            }
    return label;
}

/// (F) connected pieces of one label.
std::vector<Index> pieces_by_label(const CutSurface& whole, const std::vector<int>& label, std::vector<double>& area)
{
    std::vector<Index> piece(label.size(), -1), queue;
    area.clear();
    for (Index seed = 0; seed < static_cast<Index>(label.size()); ++seed) {
        if (piece[seed] >= 0) continue;
        const auto own = static_cast<Index>(area.size());
        area.push_back(0.0);
        queue.assign(1, seed);
        piece[seed] = own;
        for (std::size_t head = 0; head < queue.size(); ++head) {
            area[own] += whole.areas[queue[head]];
            for (Index h = 3 * queue[head]; h < 3 * queue[head] + 3; ++h) {
                const Index t = whole.surface.twin[h];
                if (t == no_twin || piece[face_of(t)] >= 0 || label[face_of(t)] != label[seed]) continue;
                piece[face_of(t)] = own;
                queue.push_back(face_of(t));
            }
        }
    }
    return piece;
}

/// Whether edges connect the faces. @param faces ascending
bool are_connected(const CutSurface& whole, const std::vector<Index>& faces)
{
    std::vector<char> open(static_cast<std::size_t>(whole.areas.size()), 0);
    for (const Index f : faces) open[f] = 1;
    std::vector<Index> queue{faces.front()};
    open[faces.front()] = 0;
    for (std::size_t head = 0; head < queue.size(); ++head)
        for (Index h = 3 * queue[head]; h < 3 * queue[head] + 3; ++h)
            if (const Index t = whole.surface.twin[h]; t != no_twin && open[face_of(t)]) {
                open[face_of(t)] = 0;
                queue.push_back(face_of(t));
            }
    return queue.size() == faces.size();
}

/// Of each label only the largest piece stays. The others go to the neighbour with the longest border, the smallest
/// first.
void join_pieces(const CutSurface& whole, std::vector<int>& label, int count)
{
    for (std::size_t round = 0; round < label.size(); ++round) {
        std::vector<double> area;
        const std::vector<Index> piece = pieces_by_label(whole, label, area);
        std::vector<Index> largest(count, -1);
        std::vector<int> label_of(area.size());
        for (std::size_t f = 0; f < label.size(); ++f) label_of[piece[f]] = label[f];
        for (std::size_t k = 0; k < area.size(); ++k)
            if (Index& best = largest[label_of[k]]; best < 0 || area[k] > area[best]) best = static_cast<Index>(k);
        std::map<std::pair<Index, int>, double> border;
        for (std::size_t h = 0; h < whole.surface.twin.size(); ++h) {
            const Index t = whole.surface.twin[h];
            if (t == no_twin) continue;
            const Index p = piece[face_of(static_cast<Index>(h))], q = piece[face_of(t)];
            if (p != q && largest[label_of[p]] != p)
                border[{p, label_of[q]}] += whole.lengths[static_cast<Eigen::Index>(h)];
        }
        if (border.empty()) return;
        std::vector<std::pair<double, int>> to(area.size(), {-1.0, none});
        for (const auto& [key, length] : border)
            if (length > to[key.first].first) to[key.first] = {length, key.second};
        for (std::size_t f = 0; f < label.size(); ++f)
            if (to[piece[f]].second >= 0) label[f] = to[piece[f]].second;
    }
}

}  // namespace

std::vector<int> fine_labels(const CutSurface& whole, const CoarseSurface& coarse, const std::vector<int>& label,
                             int count, ExecutionContext& context)
{
    const std::vector<int> sure = sure_labels(whole, coarse, label);
    std::vector<int> fine = grown(whole, sure);
    join_pieces(whole, fine, count);
    std::map<std::pair<int, int>, double> borders;
    for (std::size_t h = 0; h < whole.surface.twin.size(); ++h)
        if (const Index t = whole.surface.twin[h]; t != no_twin) {
            const int a = fine[face_of(static_cast<Index>(h))], b = fine[face_of(t)];
            if (a < b) borders[{a, b}] += whole.lengths[static_cast<Eigen::Index>(h)];
        }
    for (const auto& [pair, length] : borders) {
        context.checkpoint();
        std::vector<Index> faces;
        for (std::size_t f = 0; f < fine.size(); ++f)
            if (fine[f] == pair.first || fine[f] == pair.second) faces.push_back(static_cast<Index>(f));
        if (faces.empty() || !are_connected(whole, faces)) continue;  // an earlier border has separated them
        const PartMesh both = some_or_all(whole, std::move(faces));
        std::vector<Side> sides;
        for (const Index f : both.faces)
            sides.push_back(sure[f] != fine[f] ? Side::free : fine[f] == pair.first ? Side::inside : Side::outside);
        const std::vector<int> cut = minimum_cut(both, sides);
        for (std::size_t i = 0; i < cut.size(); ++i) fine[both.faces[i]] = cut[i] ? pair.first : pair.second;
    }
    join_pieces(whole, fine, count);
    return fine;
}

}  // namespace koebe
