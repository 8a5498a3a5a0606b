#include "parts/unfolding.h"

#include "core/errors.h"
#include "cost/tolerances.h"
#include "cost/tuning.h"
#include "cut/disjoint_sets.h"
#include "parts/flat_charts.h"
#include "parts/hard_room.h"
#include "parts/regions.h"
#include "planar/planar_predicates.h"
#include "planar/rigid_fit.h"
#include "surface/free_flattening.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numbers>
#include <numeric>
#include <optional>
#include <tuple>
#include <utility>

namespace koebe {
namespace {

constexpr double least_border = 0.12;     // of a chart's boundary: a shorter common border is not worth joining
constexpr std::size_t most_tips = 64;     // of one chart,
constexpr std::size_t most_charts = 300;  // of a surface: else it is smooth, or rough
constexpr std::size_t cone_tips = 2;      // of a chart of a hard surface
constexpr double least_hard = 0.25;       // of the area: hold so much of a hard surface

constexpr double side_of_nut = 1.80;  // longest island, in roots of its surface's area: the six sides of a nut;
constexpr double thin = 0.2;          // charts whose area over the square of the length is less are cut across;
constexpr double middle = 1e-6;       // of a piece: a region so near to its end belongs to the next piece

constexpr int most_border_fits = 4;  // of a border under noise

constexpr double whole_mesh = 0.999;  // of the area of all surfaces: this one is alone
constexpr double most_scaled = 4.0;   // factor by which the area of a face beside an island may change

/// The longest island, in roots of the area of all surfaces. @param area of this surface
double longest_island(double area, const UnfoldOptions& options)
{
    if (!options.roomy) return std::numeric_limits<double>::infinity();
    return options.compact ? tuning::longest_hard : std::max(tuning::longest_hard, side_of_nut * std::sqrt(area));
}

class Unfolding {
public:
    Unfolding(const CutSurface& surface, FlatCharts charts, const UnfoldOptions& options)
        : surface_(surface),
          longest_(longest_island(surface.areas.sum(), options)),
          charts_(std::move(charts)),
          islands_(charts_.faces),
          island_(islands_.size())
    {
        parts_ = std::move(charts_.parts);
        std::iota(island_.begin(), island_.end(), 0);
        chart_.assign(static_cast<std::size_t>(surface.areas.size()), -1);
        for (std::size_t k = 0; k < islands_.size(); ++k)
            for (const Index f : islands_[k]) chart_[f] = static_cast<Index>(k);
    }

    /// The area of charts that are not small, without single faces in the planes of which no other face lies. An
    /// animal of few faces has charts with such faces only. A chart between planar regions counts as a whole: the side
    /// of a cone consists of single faces.
    double hard_area(double least) const
    {
        const auto is_planar = [&](Index f) { return charts_.plane[f] > alone * surface_.areas[f]; };
        double sum = 0.0;
        for (const std::vector<Index>& faces : islands_) {
            const double area = surface_.areas(faces).sum();
            if (!(area >= least)) continue;
            double planar = 0.0, outline = 0.0, at_planar = 0.0;
            for (const Index f : faces) {
                if (is_planar(f)) planar += surface_.areas[f];
                for (Index h = 3 * f; h < 3 * f + 3; ++h) {
                    if (charts_.net.twin[h] != no_twin || !charts_.crease[h]) continue;
                    outline += surface_.lengths[h];
                    if (is_planar(face_of(twin(h)))) at_planar += surface_.lengths[h];
                }
            }
            sum += at_planar > tolerance::majority * outline ? area : planar;
        }
        return sum;
    }

    /// Cuts thin charts that are too long across, between planar regions.
    void cut_strips()
    {
        for (std::size_t k = 0, count = islands_.size(); k < count; ++k) {
            Complex along;
            const double length = extent(islands_[k], along);
            if (length > tuning::longest_hard && surface_.areas(islands_[k]).sum() < thin * length * length)
                cut_strip(k, along, static_cast<int>(std::ceil(length / tuning::longest_hard)));
        }
    }

    /// @param smooth_only not over creases
    void join_charts(bool smooth_only, ExecutionContext& context)
    {
        for (const Index h : borders()) {
            context.checkpoint();
            if (smooth_only && charts_.crease[h]) continue;
            const Index a = island_of(h), b = island_of(twin(h));
            if (a == b) continue;
            islands_[a].size() < islands_[b].size() ? join(twin(h)) : join(h);
        }
    }

    /// Small pieces of the rest, such as the corner between three fillets, go with the island with which they have the
    /// longest border. Their map bends, the island does not move.
    void attach_rest(ExecutionContext& context)
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

    double noise() const { return charts_.noise; }

    double cut_length() const
    {
        double length = 0.0;
        for (Index h = 0; h < halfedges(); ++h)
            if (twin(h) > h && charts_.net.twin[h] == no_twin) length += surface_.lengths[h];
        return length;
    }

    std::vector<Index> rest()
    {
        std::ranges::sort(charts_.rest);
        return charts_.rest;
    }

    std::vector<FlatPart> parts()
    {
        const auto is_cut = [&](Index h) { return charts_.net.twin[h] == no_twin && chart_[face_of(h)] >= 0; };
        for (const Index h : charts_.slits)
            if (is_cut(h)) parts_[island_of(h)].slit += surface_.lengths[h];
        for (const Index h : charts_.darts)
            if (is_cut(h)) parts_[island_of(h)].dart_length += surface_.lengths[h];
        std::vector<FlatPart> found;
        for (std::size_t k = 0; k < parts_.size(); ++k)
            if (!islands_[k].empty()) found.push_back(std::move(parts_[k]));
        return found;
    }

    /// The parts, cut between planar regions where the pieces need less room in the square; empty: nowhere.
    std::vector<FlatPart> roomier(const std::vector<FlatPart>& parts, ExecutionContext& context) const
    {
        return cut_between_planes(surface_, charts_, parts, context);
    }

private:
    Index halfedges() const { return charts_.net.halfedge_count(); }
    Index twin(Index h) const { return surface_.surface.twin[h]; }
    Index island_of(Index h) const { return island_[chart_[face_of(h)]]; }

    bool same(Complex a, Complex b) const { return std::abs(a - b) < charts_.near; }

    /// The longer side of the box round laid faces, along most of their border up to quarter turns. Sets its direction.
    double extent(const std::vector<Index>& faces, Complex& along) const
    {
        Complex most = 0.0;
        for (const Index f : faces)
            for (Index h = 3 * f; h < 3 * f + 3; ++h) {
                const Complex edge = charts_.at[next_halfedge(h)] - charts_.at[h], square = edge * edge;
                const double length = std::abs(edge);
                if (charts_.net.twin[h] == no_twin && length > 0.0)
                    most += square * square / (length * length * length);
            }
        along = std::polar(1.0, 0.25 * std::arg(most));
        PlanarPoints points(3 * static_cast<Eigen::Index>(faces.size()), 2);
        Eigen::Index row = 0;
        for (const Index f : faces)
            for (Index h = 3 * f; h < 3 * f + 3; ++h)
                points.row(row++) << dot(along, charts_.at[h]), cross(along, charts_.at[h]);
        const Eigen::RowVector2d size = box_size(points);
        if (size[1] > size[0]) along *= Complex(0.0, 1.0);
        return size.maxCoeff();
    }

    /// Cuts a chart into equally long pieces. Nothing changes if it falls into more pieces, or does not get shorter.
    void cut_strip(std::size_t chart, const Complex& along, int count)
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
            Complex unused;
            auto part = part_of(own);
            if (!part || extent(own, unused) > tuning::longest_hard) break;
            parts.push_back(std::move(*part));
        }
        if (parts.size() != pieces.size()) {
            for (const Index h : cuts) {
                charts_.net.twin[h] = twin(h);
                charts_.net.twin[twin(h)] = h;
            }
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

    /// The motion that brings the face across a crease to the crease's place.
    PlaneMotion motion_to(Index h) const
    {
        const Index t = twin(h);
        const Complex from = charts_.at[next_halfedge(t)] - charts_.at[t],
                      to = charts_.at[h] - charts_.at[next_halfedge(h)];
        const Complex turn = to / from / std::abs(to / from);
        return {turn, charts_.at[next_halfedge(h)] - turn * charts_.at[t]};
    }

    /// The motion that brings the chart across a border to its place at one of its edges. Under noise to the place
    /// nearest to all edges that then meet.
    PlaneMotion motion_over(const std::vector<Index>& border, Index crease) const
    {
        PlaneMotion motion = motion_to(crease);
        for (int round = 0; charts_.noise > 0.0 && round < most_border_fits; ++round) {
            RigidFit fit;
            for (const Index h : border) {
                if (!meets(h, motion)) continue;
                fit.add(charts_.at[next_halfedge(h)], charts_.at[twin(h)], surface_.lengths[h]);
                fit.add(charts_.at[h], charts_.at[next_halfedge(twin(h))], surface_.lengths[h]);
            }
            if (fit.weight > 0.0) motion = {fit.turn(), fit.moved(0.0)};
        }
        return motion;
    }

    bool meets(Index h, const PlaneMotion& motion) const
    {
        const Index t = twin(h);
        return same(motion(charts_.at[t]), charts_.at[next_halfedge(h)]) &&
               same(motion(charts_.at[next_halfedge(t)]), charts_.at[h]);
    }

    /// For each pair of charts the crease at which they are best joined, if their straight common border is long
    /// enough. Smooth borders first, then the longest.
    std::vector<Index> borders() const
    {
        // Borders of each pair of charts, and the whole boundary of each chart.
        std::map<std::pair<Index, Index>, std::vector<Index>> common;
        std::vector<double> boundary(islands_.size(), 0.0);
        for (Index h = 0; h < halfedges(); ++h) {
            if (charts_.net.twin[h] != no_twin) continue;
            const Index a = chart_[face_of(h)];
            if (a < 0) continue;
            boundary[a] += surface_.lengths[h];
            if (twin(h) == no_twin) continue;
            if (const Index b = chart_[face_of(twin(h))]; a < b) common[{a, b}].push_back(h);
        }
        // At the longest edge of a border the charts are joined: what then lies in one place counts as common.
        std::vector<std::tuple<char, double, Index>> found;
        for (const auto& [charts, halfedges] : common) {
            const Index longest =
                *std::ranges::max_element(halfedges, {}, [&](Index h) { return surface_.lengths[h]; });
            const PlaneMotion motion = motion_over(halfedges, longest);
            double length = 0.0, price = 0.0;
            for (const Index h : halfedges)
                if (meets(h, motion)) {
                    length += surface_.lengths[h];
                    price += charts_.net.length[h];
                }
            if (length >= least_border * std::min(boundary[charts.first], boundary[charts.second]))
                found.emplace_back(charts_.crease[longest], -price, longest);
        }
        std::ranges::sort(found);
        std::vector<Index> order;
        for (const auto& border : found) order.push_back(std::get<2>(border));
        return order;
    }

    /// Joins two islands at this half-edge of the first one, unless they overlap.
    void join(Index crease)
    {
        const Index a = island_of(crease), b = island_of(twin(crease));
        Complex unused;
        const double longest = std::max({longest_, extent(islands_[a], unused), extent(islands_[b], unused)});
        // The second island moves to the first one. Edges that then lie in one place are joined.
        std::vector<Index> joined;
        std::vector<Complex> before;
        for (const Index f : islands_[b])
            for (Index t = 3 * f; t < 3 * f + 3; ++t) {
                before.push_back(charts_.at[t]);
                const Index h = twin(t);
                if (h != no_twin && charts_.net.twin[h] == no_twin && chart_[face_of(h)] >= 0 && island_of(h) == a)
                    joined.push_back(h);
            }
        const PlaneMotion motion = motion_over(joined, crease);
        std::erase_if(joined, [&](Index h) { return !meets(h, motion); });
        for (const Index h : joined) {
            charts_.net.twin[h] = twin(h);
            charts_.net.twin[twin(h)] = h;
        }
        for (const Index f : islands_[b])
            for (Index c = 3 * f; c < 3 * f + 3; ++c) charts_.at[c] = motion(charts_.at[c]);
        std::vector<Index> faces = islands_[a];
        faces.insert(faces.end(), islands_[b].begin(), islands_[b].end());
        std::ranges::sort(faces);
        // Undo it if the joined island is too long, or overlaps itself.
        std::optional<FlatPart> part;
        if (!(extent(faces, unused) > longest)) part = part_of(faces);
        if (!part) {
            auto at = before.begin();
            for (const Index f : islands_[b])
                for (Index c = 3 * f; c < 3 * f + 3; ++c) charts_.at[c] = *at++;
            for (const Index h : joined) charts_.net.cut(h);
            return;
        }
        parts_[a] = std::move(*part);
        islands_[a] = std::move(faces);
        islands_[b].clear();
        std::ranges::replace(island_, b, a);
    }

    /// Half-edges of a piece of the rest: its longest border with an island that is in one run there, too.
    std::vector<Index> longest_border(const SeamedMesh& piece) const
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
    bool attach(const SeamedMesh& piece)
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
        for (const Index t : border) {
            charts_.net.twin[t] = twin(t);
            charts_.net.twin[twin(t)] = t;
        }
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

    std::optional<FlatPart> part_of(const std::vector<Index>& faces) const
    {
        return laid_part(surface_, charts_, faces);
    }

    const CutSurface& surface_;
    const double longest_;                     // extent of an island
    FlatCharts charts_;                        // twins over creases where charts are joined
    std::vector<std::vector<Index>> islands_;  // faces of joined charts, ascending
    std::vector<Index> island_;                // (charts)
    std::vector<Index> chart_;                 // (F)
    std::vector<FlatPart> parts_;              // (islands)
};

/// A mesh that became one island which leaves most of the square empty, such as the cross of a cube, becomes several
/// islands if they are much larger there. @param unfold does it with other options
template <class Unfold>
std::optional<UnfoldedParts> larger_when_packed(const CutSurface& surface, UnfoldOptions options, const Unfold& unfold)
{
    std::optional<UnfoldedParts> whole = unfold(options);
    const double area = surface.areas.sum();
    if (!whole || !options.roomy || whole->parts.size() != 1 || !whole->rest.empty() || area < whole_mesh) return whole;
    const double scale = quickly_packed_scale(whole->parts);
    if (area * scale * scale >= tuning::packed_badly) return whole;
    options.compact = true;
    std::optional<UnfoldedParts> apart = unfold(options);
    return apart && quickly_packed_scale(apart->parts) > tuning::worth_apart * scale ? apart : whole;
}

std::optional<UnfoldedParts> unfolded_once(const CutSurface& surface, ExecutionContext& context,
                                           const UnfoldOptions& options)
{
    FlatCharts charts = flat_charts(surface, most_tips, options.hard_angle);
    if (!charts.rest.empty() || charts.faces.size() > most_charts) return {};
    Unfolding unfolding(surface, std::move(charts), options);
    if (options.roomy) unfolding.cut_strips();
    unfolding.join_charts(options.cut_hard, context);
    return UnfoldedParts{unfolding.parts(), {}, {}, unfolding.cut_length(), unfolding.noise()};
}

std::optional<UnfoldedParts> hard_parts_once(const CutSurface& surface, ExecutionContext& context,
                                             const UnfoldOptions& options)
{
    const double area = surface.areas.sum();
    Unfolding unfolding(surface, flat_charts(surface, cone_tips, options.hard_angle), options);
    if (!(unfolding.hard_area(tuning::small_area * area) >= least_hard * area)) return {};
    if (options.roomy) unfolding.cut_strips();
    unfolding.join_charts(options.cut_hard, context);
    unfolding.attach_rest(context);
    UnfoldedParts found{unfolding.parts(), {}, unfolding.rest(), unfolding.cut_length(), unfolding.noise()};
    if (options.roomy && !options.cut_hard) found.roomier = unfolding.roomier(found.parts, context);
    return found;
}

}  // namespace

std::optional<UnfoldedParts> unfolded(const CutSurface& surface, ExecutionContext& context,
                                      const UnfoldOptions& options)
{
    return larger_when_packed(surface, options,
                              [&](const UnfoldOptions& own) { return unfolded_once(surface, context, own); });
}

std::optional<UnfoldedParts> hard_parts(const CutSurface& surface, ExecutionContext& context,
                                        const UnfoldOptions& options)
{
    return larger_when_packed(surface, options,
                              [&](const UnfoldOptions& own) { return hard_parts_once(surface, context, own); });
}

}  // namespace koebe
