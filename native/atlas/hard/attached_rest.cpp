#include "core/errors.h"
#include "cost/tuning.h"
#include "cut/disjoint_sets.h"
#include "hard/chart_islands.h"
#include "surface/free_flattening.h"

#include <algorithm>
#include <map>
#include <utility>

namespace koebe {
namespace {

constexpr double most_scaled = 4.0;  // factor by which the area of a face beside an island may change

}  // namespace

void ChartIslands::attach_rest(ExecutionContext& context)
{
    SeamedMesh rest = charts_.net;
    for (Index h = 0; h < halfedges(); ++h)
        if (chart_[face_of(h)] >= 0) rest.cut(h);
    std::vector<SeamedMesh> pieces = connected_parts(rest);
    std::erase_if(pieces, [&](const SeamedMesh& piece) {
        return chart_[piece.face.front()] >= 0 ||
               surface_.areas(piece.face).sum() > tuning::noticeable * surface_.areas.sum();
    });
    // A piece between two others waits until one of them is attached.
    for (std::size_t before = 0; before != pieces.size();) {
        before = pieces.size();
        std::erase_if(pieces, [&](const SeamedMesh& piece) {
            context.checkpoint();
            return attach(piece);
        });
    }
    std::erase_if(charts_.rest, [&](Index f) { return chart_[f] >= 0; });
}

/// Half-edges of a piece of the rest: its longest border with an island that is in one run there, too.
std::vector<Index> ChartIslands::longest_border(const SeamedMesh& piece) const
{
    std::vector<Index> border;
    std::map<Index, std::vector<std::pair<Complex, Index>>> ends;  // of vertices: places in islands, border edges
    const auto across = [&](Index h) { return twin(3 * piece.face[face_of(h)] + h % 3); };
    for (Index h = 0; h < piece.halfedge_count(); ++h) {
        const Index t = across(h);
        if (piece.twin[h] != no_twin || t == no_twin || chart_[face_of(t)] < 0) continue;
        ends[origin(piece.fans, h)].emplace_back(charts_.at[next_halfedge(t)], static_cast<Index>(border.size()));
        ends[target(piece.fans, h)].emplace_back(charts_.at[t], static_cast<Index>(border.size()));
        border.push_back(h);
    }
    DisjointSets runs(border.size());
    for (const auto& entry : ends)
        for (const auto& [a, i] : entry.second)
            for (const auto& [b, k] : entry.second)
                if (same(a, b) && island_of(across(border[i])) == island_of(across(border[k]))) runs.join(i, k);
    std::vector<double> length(border.size(), 0.0);
    for (std::size_t i = 0; i < border.size(); ++i)
        length[runs.find(static_cast<Index>(i))] += surface_.lengths[across(border[i])];
    const auto best = std::ranges::max_element(length) - length.begin();
    std::vector<Index> run;
    for (std::size_t i = 0; i < border.size(); ++i)
        if (runs.find(static_cast<Index>(i)) == best) run.push_back(border[i]);
    return run;
}

/// Maps a piece of the rest beside the island with which it has the longest border: conformal in the sense of least
/// squares, with the border pinned. @return false, and nothing changes, if there is no place for it
bool ChartIslands::attach(const SeamedMesh& piece)
{
    const auto in_net = [&](Index h) { return 3 * piece.face[face_of(h)] + h % 3; };
    std::vector<Index> border = longest_border(piece);
    if (border.empty()) return false;
    const Index island = island_of(twin(in_net(border.front())));
    // Its border stays where the island has it. The rest follows, conformal in the sense of least squares.
    std::map<Index, Complex> places;
    for (Index& h : border) {
        const Index t = twin(in_net(h));
        places.emplace(origin(piece.fans, h), charts_.at[next_halfedge(t)]);
        places.emplace(target(piece.fans, h), charts_.at[t]);
        h = t;
    }
    std::vector<Index> pinned, original(piece.fan_count);
    std::vector<Complex> images;
    for (const auto& [v, place] : places) {
        pinned.push_back(v);
        images.push_back(place);
    }
    for (Index h = 0; h < piece.halfedge_count(); ++h) original[origin(piece.fans, h)] = origin(piece.corners, h);
    VectorXcd image;
    try {
        image = flatten_freely(surface_.vertices(original, Eigen::all), piece.fans, pinned, images);
    } catch (const SolverError&) {
        return false;
    }
    // Draw it. It stays by itself if a face becomes much larger or smaller.
    for (Index h = 0; h < piece.halfedge_count(); ++h) {
        charts_.at[in_net(h)] = image[origin(piece.fans, h)];
        if (piece.twin[h] != no_twin) charts_.net.twin[in_net(h)] = in_net(piece.twin[h]);
    }
    for (Index f = 0; f < static_cast<Index>(piece.face.size()); ++f) {
        const Complex a = charts_.at[3 * piece.face[f]], b = charts_.at[3 * piece.face[f] + 1] - a,
                      c = charts_.at[3 * piece.face[f] + 2] - a;
        const double scale = 0.5 * std::imag(std::conj(b) * c) / std::max(surface_.areas[piece.face[f]], 1e-300);
        if (!(scale > 1.0 / most_scaled && scale < most_scaled)) return false;
    }
    // Join it to the island, unless they overlap.
    for (const Index t : border) charts_.net.join(t, twin(t));
    std::vector<Index> faces = islands_[island];
    faces.insert(faces.end(), piece.face.begin(), piece.face.end());
    std::ranges::sort(faces);
    auto part = part_of(faces);
    if (!part) {
        for (const Index t : border) charts_.net.cut(t);
        return false;
    }
    parts_[island] = std::move(*part);
    islands_[island] = std::move(faces);
    for (const Index f : piece.face) chart_[f] = island;
    return true;
}

}  // namespace koebe
