#include "hard/flat_charts.h"

#include "core/grouping.h"
#include "core/numbering.h"
#include "cost/tolerances.h"
#include "cost/tuning.h"
#include "cut/disjoint_sets.h"
#include "darts/tension.h"
#include "flat/noise_level.h"
#include "hard/laid_part.h"
#include "hard/loose_strips.h"
#include "mesh/connected_pieces.h"
#include "planar/rigid_fit.h"
#include "surface/face_vectors.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numbers>
#include <queue>
#include <tuple>
#include <utility>

namespace koebe {
namespace {

constexpr double flat_angle = 1e-3;      // radians by which the angles round a flat vertex may miss a full turn
constexpr double turned_by_noise = 1.0;  // radians that an edge as short as the noise may add to that
constexpr double same_place = 1e-5;      // in roots of the surface's area
constexpr double most_single = 0.75;     // of a chart's area, in faces that are alone in their planes
constexpr Index least_plate = 3;         // faces of a plate: two are a quadrilateral, as animals have
constexpr double core = 0.5;             // least cosine to its plane of a face that stays if the plane overlaps itself
constexpr double plate_to_strip = 2.0;   // a plate is so many times larger than its neighbours

class ChartLayer {
public:
    ChartLayer(const CutSurface& surface, std::size_t most_tips, double hard_angle)
        : surface_(surface),
          regions_(planar_regions(surface)),
          most_tips_(most_tips),
          least_fold_(hard_angle * std::numbers::pi / 180.0 + tolerance::off_axis)
    {
        net_ = seamed(surface.vertices, surface.surface, surface.polygon, surface.shown);
        charts_.at.resize(net_.twin.size());
        charts_.noise = regions_.noise;
        charts_.near = std::max(same_place * std::sqrt(surface.areas.sum()), 2.0 * regions_.tolerance);
        for (const Index region : regions_.of) charts_.plane.push_back(regions_.planes[region].area);
        planar_ = group_ = charts_.region = regions_.of;
    }

    FlatCharts run()
    {
        for (Index h = 0; h < net_.halfedge_count(); ++h) charts_.crease.push_back(is_crease(h) ? bent_edge : 0);
        for (Index h = 0; h < net_.halfedge_count(); ++h)
            if (charts_.crease[h]) net_.cut(h);
        number_fans(net_);
        find_plates();
        for (const SeamedMesh& chart : connected_parts(net_)) {
            if (is_curved(chart)) {
                settle_plates(chart);
                continue;
            }
            for (const SeamedMesh& piece : without_loose_strips(chart))
                if (!settle(piece, most_tips_)) settle_mixed(piece);
        }
        join_rest();
        return std::move(charts_);
    }

private:
    static Index in_net(const SeamedMesh& chart, Index h) { return 3 * chart.face[face_of(h)] + h % 3; }

    const RegionPlane& plane(Index f) const { return regions_.planes[regions_.of[f]]; }
    /// The place of a corner in the plane of its region.
    Complex in_plane(Index h) const { return plane(face_of(h)).place(surface_.vertices.row(origin(net_.corners, h))); }
    bool same(Complex a, Complex b) const { return std::abs(a - b) < charts_.near; }

    Index twin(Index h) const { return surface_.surface.twin[h]; }
    bool is_crease(Index h) const
    {
        if (twin(h) == no_twin || net_.whole[h]) return false;
        const Eigen::RowVector3d &a = plane(face_of(h)).normal, &b = plane(face_of(twin(h))).normal;
        return std::atan2(a.cross(b).norm(), a.dot(b)) > least_fold_;
    }

    /// Plates are planar regions of several faces that are not small, and whose outline is mostly creases: so the flat
    /// base of a ball is one, but a facet of its round side is none.
    void find_plates()
    {
        std::vector<Index> faces(regions_.planes.size(), 0);
        std::vector<double> outline(faces.size(), 0.0), creased(outline);
        for (const Index region : regions_.of) ++faces[region];
        for (Index h = 0; h < net_.halfedge_count(); ++h) {
            const Index t = twin(h), own = regions_.of[face_of(h)];
            if (t == no_twin) continue;
            if (charts_.crease[h]) creased[own] += surface_.lengths[h];
            if (charts_.crease[h] || regions_.of[face_of(t)] != own) outline[own] += surface_.lengths[h];
        }
        const double small = tuning::small_area * surface_.areas.sum();
        for (const Index region : regions_.of)
            charts_.plate.push_back(faces[region] >= least_plate && regions_.planes[region].area >= small &&
                                    creased[region] > tolerance::majority * outline[region]);
    }

    /// Of a curved chart only the plates are laid flat.
    void settle_plates(const SeamedMesh& chart)
    {
        for (const Index f : chart.face) group_[f] = charts_.plate[f] ? regions_.of[f] : -1;
        settle_groups(chart);
    }

    /// Lays the groups of a chart flat, each by itself. Faces in no group, and groups that cannot be laid, are the
    /// rest.
    void settle_groups(const SeamedMesh& chart)
    {
        for (const SeamedMesh& piece : cut_between_groups(chart))
            if (group_[piece.face.front()] < 0 || !settle(piece, 0))
                charts_.rest.insert(charts_.rest.end(), piece.face.begin(), piece.face.end());
    }

    /// Whether a chart is curved in both directions, so that only plates of it can be laid flat: most faces are alone
    /// in their planes, and the total curvature of its inner vertices is that of half a ball.
    bool is_curved(const SeamedMesh& chart) const
    {
        std::vector<double> defect(static_cast<std::size_t>(chart.fan_count), 2.0 * std::numbers::pi);
        std::vector<char> outside(defect.size(), 0);
        double area = 0.0, single = 0.0, curvature = 0.0;
        for (Index h = 0; h < chart.halfedge_count(); ++h) {
            const auto at = [&](Index own) { return surface_.vertices.row(origin(chart.corners, own)); };
            const Eigen::RowVector3d a = at(next_halfedge(h)) - at(h), b = at(previous_halfedge(h)) - at(h);
            defect[origin(chart.fans, h)] -= std::atan2(a.cross(b).norm(), a.dot(b));
            if (chart.twin[h] == no_twin) outside[origin(chart.fans, h)] = outside[target(chart.fans, h)] = 1;
        }
        for (std::size_t v = 0; v < defect.size(); ++v)
            if (!outside[v]) curvature += std::abs(defect[v]);
        for (const Index f : chart.face) {
            area += surface_.areas[f];
            if (!(plane(f).area > alone * surface_.areas[f])) single += surface_.areas[f];
        }
        return single > most_single * area && curvature > 2.0 * std::numbers::pi;
    }

    /// (F) the connected pieces of regions in a chart, numbered from 0 on.
    std::vector<Index> planar_pieces(const SeamedMesh& chart, Index& count) const
    {
        return connected_pieces(chart.twin, values_at(regions_.of, chart.face), count);
    }

    /// Lays the planar pieces of a chart side by side, over a spanning tree of the longest edges between them.
    void lay(const SeamedMesh& chart)
    {
        Index count = 0;
        const std::vector<Index> piece = planar_pieces(chart, count);
        const std::vector<std::vector<Index>> faces = places_of_numbers(piece, count);
        std::vector<char> laid(faces.size(), 0);
        using Step = std::tuple<double, Index, Index>;  // length, minus its turn, half-edge to the next piece
        std::priority_queue<Step> steps;
        Index turn = 0;
        const auto put = [&](Index number, const PlaneMotion& motion) {
            laid[number] = 1;
            for (const Index f : faces[number])
                for (Index h = 3 * f; h < 3 * f + 3; ++h) {
                    charts_.at[in_net(chart, h)] = motion(in_plane(in_net(chart, h)));
                    if (chart.twin[h] == no_twin || laid[piece[face_of(chart.twin[h])]]) continue;
                    const double length =
                        chart.whole[h] ? std::numeric_limits<double>::max() : net_.length[in_net(chart, h)];
                    steps.emplace(length, --turn, h);
                }
        };
        put(0, {});
        while (!steps.empty()) {
            const Index h = std::get<2>(steps.top()), t = chart.twin[h];
            steps.pop();
            if (laid[piece[face_of(t)]]) continue;
            // The motion of the next plane: its edge runs back along the edge that is laid.
            const Complex a = charts_.at[in_net(chart, h)], b = charts_.at[in_net(chart, next_halfedge(h))];
            const Complex from = in_plane(in_net(chart, next_halfedge(t))), to = in_plane(in_net(chart, t));
            Complex turned = (b - a) / (to - from);
            turned = std::isfinite(std::abs(turned)) && std::abs(turned) > 0.0 ? turned / std::abs(turned) : 1.0;
            PlaneMotion motion{turned, 0.5 * (a + b) - turned * 0.5 * (from + to)};
            if (regions_.noise > 0.0) {  // then one edge says little: all edges between the two count
                RigidFit fit;
                for (const Index f : faces[piece[face_of(t)]])
                    for (Index own = 3 * f; own < 3 * f + 3; ++own) {
                        const Index other = chart.twin[own];
                        if (other == no_twin || piece[face_of(other)] != piece[face_of(h)]) continue;
                        const double length = surface_.lengths[in_net(chart, own)];
                        fit.add(charts_.at[in_net(chart, next_halfedge(other))], in_plane(in_net(chart, own)), length);
                        fit.add(charts_.at[in_net(chart, other)], in_plane(in_net(chart, next_halfedge(own))), length);
                    }
                motion = {fit.turn(), fit.moved(0.0)};
            }
            put(piece[face_of(t)], motion);
        }
    }

    /// Half-edges, one each, at which the laid chart does not close.
    std::vector<Index> open_edges(const SeamedMesh& chart) const
    {
        std::vector<Index> open;
        for (Index h = 0; h < chart.halfedge_count(); ++h) {
            const Index t = chart.twin[h];
            if (t < h) continue;
            if (!same(charts_.at[in_net(chart, t)], charts_.at[in_net(chart, next_halfedge(h))]) ||
                !same(charts_.at[in_net(chart, next_halfedge(t))], charts_.at[in_net(chart, h)]))
                open.push_back(h);
        }
        return open;
    }

    /// Half-edges, one each, from the inner vertices whose angles do not sum to a full turn, up to one more than
    /// allowed.
    std::vector<Index> tips_of(const SeamedMesh& chart) const
    {
        std::vector<double> sum(static_cast<std::size_t>(chart.fan_count), 0.0);
        std::vector<Index> leaving(sum.size(), no_twin);
        std::vector<char> outside(sum.size(), 0);
        std::vector<double> noise(sum.size(), flat_angle);
        for (Index h = 0; h < chart.halfedge_count(); ++h) {
            const Index v = origin(chart.fans, h), here = in_net(chart, h);
            for (const Index end : {v, target(chart.fans, h)})
                noise[end] = std::max(noise[end], turned_by_noise * regions_.noise / surface_.lengths[here]);
            const Complex corner = in_plane(here);
            sum[v] += std::arg((in_plane(previous_halfedge(here)) - corner) / (in_plane(next_halfedge(here)) - corner));
            leaving[v] = h;
            if (chart.twin[h] == no_twin) outside[v] = outside[target(chart.fans, h)] = 1;
        }
        std::vector<Index> tips;
        for (std::size_t v = 0; v < sum.size(); ++v)
            if (!outside[v] && !(std::abs(sum[v] - 2.0 * std::numbers::pi) < noise[v])) tips.push_back(leaving[v]);
        return tips;
    }

    /// Lays a chart flat, and cuts it where it does not close: by a dart if the cut ends in a tip, else by a slit.
    /// @return false, and nothing is cut, if it has too many tips or overlaps itself
    bool settle(const SeamedMesh& chart, std::size_t most_tips)
    {
        lay(chart);
        const std::vector<Index> open = open_edges(chart);
        std::vector<Index> tips;
        if (!open.empty()) {
            if (std::ranges::any_of(open, [&](Index h) { return chart.whole[h] != 0; })) return false;
            tips = tips_of(chart);
            if (tips.size() > most_tips) return false;
        }
        // Cut it there. Cuts that reach a tip are darts.
        DisjointSets cuts(static_cast<std::size_t>(chart.fan_count));
        for (const Index h : open) {
            cuts.join(origin(chart.fans, h), target(chart.fans, h));
            net_.cut(in_net(chart, h));
        }
        std::set<Index> with_tip, before = charts_.tips;
        for (const Index h : tips) {
            with_tip.insert(cuts.find(origin(chart.fans, h)));
            charts_.tips.insert(origin(chart.corners, h));
        }
        // Undo this if it overlaps itself.
        std::optional<FlatPart> part = laid_part(surface_, charts_, chart.face);
        if (!part) {
            for (const Index h : open) net_.join(in_net(chart, h), in_net(chart, chart.twin[h]));
            charts_.tips = std::move(before);
            return false;
        }
        for (const Index h : open)
            (with_tip.contains(cuts.find(origin(chart.fans, h))) ? charts_.darts : charts_.slits)
                .push_back(in_net(chart, h));
        charts_.parts.push_back(std::move(*part));
        charts_.faces.push_back(chart.face);
        return true;
    }

    /// Lays a plane without the slivers that noise has turned into it: they belong to the faces beside it, and become
    /// the rest. @return false, and nothing is cut, if there are none
    bool settle_core(const SeamedMesh& plane_chart)
    {
        const RegionPlane& own = plane(plane_chart.face.front());
        bool any = false;
        for (const Index f : plane_chart.face) {
            if (&plane(f) != &own) return false;
            const bool stays =
                twice_area_vector(surface_.vertices, net_.corners, f).dot(own.normal) > 2.0 * core * surface_.areas[f];
            group_[f] = stays ? 0 : -1;
            any = any || !stays;
        }
        if (!any || !(regions_.noise > 0.0)) return false;
        settle_groups(plane_chart);
        return true;
    }

    /// Cuts loose strips off, each a piece by itself. @return the pieces of the chart
    std::vector<SeamedMesh> without_loose_strips(SeamedMesh chart)
    {
        lay(chart);
        const std::vector<Index> edges = edges_of_loose_strips(surface_, regions_, chart, charts_.at);
        for (const Index h : edges) {
            for (const Index own : {in_net(chart, h), in_net(chart, chart.twin[h])}) charts_.crease[own] = loose_edge;
            net_.cut(in_net(chart, h));
            chart.cut(h);
        }
        return edges.empty() ? std::vector{std::move(chart)} : connected_parts(chart);
    }

    /// Cuts a chart between faces of different groups. @return its pieces
    std::vector<SeamedMesh> cut_between_groups(SeamedMesh chart)
    {
        for (Index h = 0; h < chart.halfedge_count(); ++h) {
            const Index t = chart.twin[h];
            if (t == no_twin || chart.whole[h] || group_[chart.face[face_of(h)]] == group_[chart.face[face_of(t)]])
                continue;
            net_.cut(in_net(chart, h));
            chart.cut(h);
        }
        return connected_parts(chart);
    }

    /// The plates of a chart that is not flat as a whole, then the rolled faces. The other faces are the rest.
    void settle_mixed(const SeamedMesh& chart)
    {
        Index count = 0;
        const std::vector<Index> planar = planar_pieces(chart, count);
        const std::vector<char> curved = curved_vertices(chart);
        const double small = tuning::small_area * surface_.areas.sum();
        std::vector<double> area(static_cast<std::size_t>(count)), outline(area.size(), 0.0), largest(area.size(), 0.0);
        std::map<std::pair<Index, Index>, double> borders;
        for (std::size_t f = 0; f < planar.size(); ++f) {
            area[planar[f]] = plane(chart.face[f]).area;
            planar_[chart.face[f]] = planar[f];
        }
        for (Index h = 0; h < chart.halfedge_count(); ++h) {
            const Index t = chart.twin[h], own = planar[face_of(h)], other = t == no_twin ? -1 : planar[face_of(t)];
            if (own == other) continue;
            outline[own] += surface_.lengths[in_net(chart, h)];
            if (other < 0) continue;
            borders[{own, other}] += surface_.lengths[in_net(chart, h)];
            largest[own] = std::max(largest[own], area[other]);
        }
        // A plate is much larger than the planar pieces round it. Long thin pieces side by side are rolled.
        const double least = tuning::least_piece * surface_.areas.sum();
        std::vector<char> is_plate(area.size());
        for (std::size_t p = 0; p < area.size(); ++p)
            is_plate[p] = area[p] >= std::max(least, plate_to_strip * largest[p]);
        for (std::size_t f = 0; f < planar.size(); ++f)
            if (charts_.plate[chart.face[f]]) is_plate[planar[f]] = 1;
        DisjointSets rolled(area.size());
        for (const auto& [pair, length] : borders)
            if (const auto [p, q] = pair;
                !is_plate[p] && !is_plate[q] && length > tolerance::rolled_outline * std::max(outline[p], outline[q]))
                rolled.join(p, q);
        for (const Index f : chart.face) group_[f] = is_plate[planar_[f]] ? planar_[f] : -1;
        // A polygon that leaves the plane of a plate is no part of the plate.
        for (bool changes = true; changes;) {
            changes = false;
            for (Index h = 0; h < chart.halfedge_count(); ++h) {
                if (!chart.whole[h] || chart.twin[h] == no_twin) continue;
                Index &own = group_[chart.face[face_of(h)]], other = group_[chart.face[face_of(chart.twin[h])]];
                if (own < 0 || own == other) continue;
                own = -1;
                changes = true;
            }
        }
        for (const SeamedMesh& group : cut_between_groups(chart))
            for (const SeamedMesh& piece : without_loose_strips(group)) {
                if (settle(piece, 0) || settle_core(piece)) continue;
                for (const Index f : piece.face) group_[f] = rolled.find(planar_[f]);
                for (const SeamedMesh& strip : cut_between_groups(piece)) {
                    if (looseness(strip, piece) <= tolerance::rolled_outline && settle(strip, 0)) continue;
                    // Large facets between flat vertices are no ball, and stay flat: a cylinder beside any faces.
                    const bool is_flat = curved_share(strip, chart, curved) <= tolerance::rolled_outline;
                    for (const Index f : strip.face) group_[f] = is_flat && plane(f).area >= small ? planar_[f] : -1;
                    for (const SeamedMesh& facet : cut_between_groups(strip))
                        if (group_[facet.face.front()] < 0 || !settle(facet, 0))
                            charts_.rest.insert(charts_.rest.end(), facet.face.begin(), facet.face.end());
                }
            }
    }

    /// (fans of the chart) 1 for inner vertices round which the chart is not flat.
    std::vector<char> curved_vertices(const SeamedMesh& chart) const
    {
        std::vector<char> curved(static_cast<std::size_t>(chart.fan_count), 0);
        for (const Index h : tips_of(chart)) curved[origin(chart.fans, h)] = 1;
        return curved;
    }

    /// The share of the vertices on the outline of a facet round which its chart is curved: all on a ball, and none on
    /// a cylinder.
    double curved_share(const SeamedMesh& facet, const SeamedMesh& chart, const std::vector<char>& curved) const
    {
        double all = 0.0, found = 0.0;
        for (Index h = 0; h < facet.halfedge_count(); ++h) {
            if (facet.twin[h] != no_twin) continue;
            const auto at = std::ranges::lower_bound(chart.face, facet.face[face_of(h)]) - chart.face.begin();
            all += 1.0;
            found += curved[chart.fans(at, h % 3)];
        }
        return found / all;
    }

    /// The share of a strip's outline along which its piece goes on.
    double looseness(const SeamedMesh& strip, const SeamedMesh& piece) const
    {
        double outline = 0.0, loose = 0.0;
        for (Index h = 0; h < strip.halfedge_count(); ++h) {
            if (strip.twin[h] != no_twin) continue;
            const double length = surface_.lengths[in_net(strip, h)];
            const auto at = std::ranges::lower_bound(piece.face, strip.face[face_of(h)]) - piece.face.begin();
            outline += length;
            if (piece.twin[3 * at + h % 3] != no_twin) loose += length;
        }
        return loose / outline;
    }

    /// Joins the rest again where it was cut without a crease.
    void join_rest()
    {
        std::ranges::sort(charts_.rest);
        std::vector<char> is_rest(charts_.plane.size(), 0);
        for (const Index f : charts_.rest) is_rest[f] = 1;
        for (const Index f : charts_.rest)
            for (Index h = 3 * f; h < 3 * f + 3; ++h)
                if (twin(h) != no_twin && is_rest[face_of(twin(h))] && charts_.crease[h] != bent_edge)
                    net_.twin[h] = twin(h);
    }

    const CutSurface& surface_;
    PlanarRegions regions_;
    std::size_t most_tips_;
    double least_fold_;                  // radians between the faces of a crease
    std::vector<Index> planar_, group_;  // (F) of the chart at work: planar piece, and what is not cut apart
    FlatCharts charts_;
    SeamedMesh& net_ = charts_.net;
};

}  // namespace

FlatCharts flat_charts(const CutSurface& surface, std::size_t most_tips, double hard_angle)
{
    return ChartLayer(surface, most_tips, hard_angle).run();
}

}  // namespace koebe
