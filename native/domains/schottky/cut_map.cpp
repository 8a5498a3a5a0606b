#include "schottky/cut_map.h"

#include "balance/area_balance.h"
#include "core/connectivity.h"
#include "core/errors.h"
#include "execution/stopwatch.h"
#include "schottky/glued_state.h"
#include "schottky/schottky_tile.h"
#include "surface/curvature_weights.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <optional>
#include <utility>

namespace koebe {
namespace {

constexpr double least_edge_share = 0.02;  // of an edge on either side of a cut, to avoid needles

/// Share of a segment's length before it crosses a circle.
double share_before(const Circle& circle, Complex from, Complex to)
{
    const Complex step = to - from, away = from - circle.center;
    const double a = std::norm(step), b = (std::conj(step) * away).real();
    const double c = std::norm(away) - circle.radius * circle.radius;
    const double root = std::sqrt(std::max(0.0, b * b - a * c));
    // The points lie on different sides, so one of the two crossings is between them.
    const double first = (-b - root) / a, second = (-b + root) / a;
    const double share = c > 0.0 ? first : second;
    return std::isfinite(share) ? std::clamp(share, least_edge_share, 1.0 - least_edge_share) : 0.5;
}

class CircleCutter {
public:
    CircleCutter(const HandleCut& cut, const FinerFaces& faces, const SchottkyPlane& plane,
                 const FundamentalCircles& circles)
        : cut_(cut), plane_(plane), circles_(circles), tiling_(cut, faces, {})
    {
    }

    std::optional<HandleCut> run()
    {
        largest_ = *std::ranges::max_element(cut_.original);
        take_vertices();
        for (std::size_t f = 0; f < cut_.corners.size(); ++f)
            if (!divide(static_cast<Index>(f))) return {};
        result_.vertices.resize(static_cast<Eigen::Index>(positions_.size()), 3);
        for (std::size_t v = 0; v < positions_.size(); ++v)
            result_.vertices.row(static_cast<Eigen::Index>(v)) = positions_[v];
        Triangles triangles(static_cast<Eigen::Index>(faces_.size()), 3);
        for (std::size_t f = 0; f < faces_.size(); ++f)
            for (int k = 0; k < 3; ++k) triangles(static_cast<Eigen::Index>(f), k) = faces_[f][k];
        result_.handles = cut_.handles;
        try {
            if (!take_loops(result_, triangles, handle_of_)) return {};
        } catch (const TopologyError&) {
            return {};  // a circle runs twice round a handle that is thinner than its faces
        }
        return result_.surface.reoriented.empty() ? std::optional(std::move(result_)) : std::nullopt;
    }

private:
    /// A vertex of the input: its number here, and the word that moves it from the map's place out of all circles.
    struct Place {
        Index number = -1;
        Complex at;
        GroupWord out;
    };

    /// Takes all vertices of the input's faces, each once.
    void take_vertices()
    {
        for (const auto& corners : cut_.corners)
            for (const Index h : corners) {
                const Index v = origin(cut_.surface.triangles, h);
                Place& place = places_[cut_.original[v]];
                if (place.number >= 0) continue;
                place.number = add(cut_.original[v], cut_.vertices.row(v), {-1, -1});
                const Complex first = plane_.z[tiling_.first_side_of(v)];
                place.out = way_out(first, plane_, circles_);
                place.at = applied(place.out, plane_.generators, first);
            }
    }

    Index add(Index name, const Eigen::RowVector3d& position, std::array<int, 2> side)
    {
        result_.original.push_back(name);
        positions_.push_back(position);
        handle_of_.push_back(side);
        return static_cast<Index>(positions_.size()) - 1;
    }

    /// Divides one face of the input.
    bool divide(Index f)
    {
        const auto& corners = cut_.corners[f];
        std::array<const Place*, 3> place;
        std::array<GroupWord, 3> chamber;  // the word that moves the face until this corner is out of all circles
        for (int k = 0; k < 3; ++k) {
            place[k] = &places_.at(cut_.original[origin(cut_.surface.triangles, corners[k])]);
            chamber[k] = product(place[k]->out, inverse_of(tiling_.corner_word(corners[k])));
        }
        auto& own = result_.corners.emplace_back();
        const auto begin = static_cast<Index>(faces_.size());
        const auto add_face = [&](Index a, Index b, Index c) {
            faces_.push_back({a, b, c});
            result_.input_face.push_back(f);
        };
        if (chamber[0] == chamber[1] && chamber[1] == chamber[2]) {
            add_face(place[0]->number, place[1]->number, place[2]->number);
            own = {3 * begin, 3 * begin + 1, 3 * begin + 2};
            return true;
        }
        int lone = 0;  // the corner that is alone on its side
        while (lone < 3 && chamber[(lone + 1) % 3] != chamber[(lone + 2) % 3]) ++lone;
        if (lone == 3) return false;
        const int next = (lone + 1) % 3, last = (lone + 2) % 3;
        const GroupWord over = product(chamber[lone], inverse_of(chamber[next]));
        if (over.size() != 1) return false;
        const auto x = crossing(*place[lone], *place[next], corners[lone], corners[next], over.front());
        const auto y = crossing(*place[lone], *place[last], corners[lone], corners[last], over.front());
        if (!x || !y) return false;
        add_face(place[lone]->number, (*x)[0], (*y)[0]);
        own[lone] = 3 * begin;
        const Index b = place[next]->number, c = place[last]->number;
        const auto apart = [&](Index v, Index w) { return (positions_[v] - positions_[w]).norm(); };
        if (apart((*x)[1], c) < apart((*y)[1], b)) {
            add_face((*x)[1], b, c);
            add_face((*x)[1], c, (*y)[1]);
            own[next] = 3 * begin + 4;
            own[last] = 3 * begin + 5;
        } else {
            add_face((*x)[1], b, (*y)[1]);
            add_face(b, c, (*y)[1]);
            own[next] = 3 * begin + 4;
            own[last] = 3 * begin + 7;
        }
        return true;
    }

    /// The point where an edge crosses a circle: its copy on the first corner's side, and on the other's.
    /// @param over the letter from the other corner's copy, out of all circles, to the first corner's
    std::optional<std::array<Index, 2>> crossing(const Place& from, const Place& to, Index from_corner, Index to_corner,
                                                 int over)
    {
        if (from.number > to.number) {
            const auto other = crossing(to, from, to_corner, from_corner, -over);
            if (!other) return {};
            return std::array<Index, 2>{(*other)[1], (*other)[0]};
        }
        const int handle = std::abs(over) - 1, side = over > 0 ? 1 : 0;
        auto [known, is_new] = crossings_.try_emplace({from.number, to.number}, std::array<Index, 2>{});
        if (!is_new) return known->second;
        const Complex beyond = applied({over}, plane_.generators, to.at);
        const double share = share_before(circles_.pairs[handle][side], from.at, beyond);
        const Eigen::RowVector3d position =
            (1.0 - share) * cut_.vertices.row(origin(cut_.surface.triangles, from_corner)) +
            share * cut_.vertices.row(origin(cut_.surface.triangles, to_corner));
        const Index name = largest_ + static_cast<Index>(crossings_.size());
        known->second[0] = add(name, position, {handle, side});
        known->second[1] = add(name, position, {handle, 1 - side});
        return known->second;
    }

    const HandleCut& cut_;
    const SchottkyPlane& plane_;
    const FundamentalCircles& circles_;
    SchottkyTiling tiling_;
    std::map<Index, Place> places_;  // of the input's vertices
    Index largest_ = 0;
    std::map<std::pair<Index, Index>, std::array<Index, 2>> crossings_;
    HandleCut result_;
    std::vector<Eigen::RowVector3d> positions_;
    std::vector<std::array<Index, 3>> faces_;
    std::vector<std::array<int, 2>> handle_of_;
};

/// Cuts the same surface again, along the fundamental circles of a map. A path along edges has corners, where the flux
/// through it is known to first order at best; a circle is smooth.
/// @param cut along edges or otherwise @param faces that were cut @param plane its map @param circles apart
/// @return nothing where a face meets two circles, or a circle and a hole: the mesh is too coarse for them
std::optional<HandleCut> cut_along_circles(const HandleCut& cut, const FinerFaces& faces, const SchottkyPlane& plane,
                                           const FundamentalCircles& circles)
{
    return CircleCutter(cut, faces, plane, circles).run();
}

constexpr Index balanced_faces = 20000;  // number of faces used to balance
constexpr double worst_spread = 1e3;     // worse than all maps with circles apart
constexpr int circle_cuts = 2;           // after the first along edges

std::vector<Index> all_loop_vertices(const HandleCut& cut)
{
    std::vector<Index> result;
    for (const CutLoop& loop : cut.loops) result.insert(result.end(), loop.vertices.begin(), loop.vertices.end());
    return result;
}

/// Makes the inside harmonic between the loops. First shifts the loops, which were moved a little onto circles and to
/// fit each other: otherwise a flux would run to the smallest loop and dominate the map there.
void fill_inside(CondensedLaplacian& surface, const GluedState& state, SchottkyPlane& plane)
{
    plane.shift(state.shifts_without_flux(plane.images));
    Eigen::Index count = 0, row = 0;
    for (const VectorXcd& image : plane.images) count += image.size();
    MatrixXd boundary(count, 2);
    for (const VectorXcd& image : plane.images) {
        boundary.middleRows(row, image.size()) << image.real(), image.imag();
        row += image.size();
    }
    const MatrixXd z = surface.extend(boundary);
    plane.z = z.col(0) + Complex(0.0, 1.0) * z.col(1);
}

PlanarPoints as_points(const VectorXcd& z)
{
    PlanarPoints points(z.size(), 2);
    points << z.real(), z.imag();
    return points;
}

/// With holes: applies the automorphism of the disk with the most even texels, or the nearest one with room for equal
/// circles. The loops are solved for again, not moved: for a handle's tiny loops, a flux as large as the mesh's errors
/// would draw all of them to one side.
SchottkyPlane plane_in_disk(const HandleCut& cut, CondensedLaplacian& surface, const GluedState& state,
                            SchottkyNormalization normalization)
{
    const VectorXcd rim = state.rim();
    SchottkyPlane plane = schottky_plane(cut, state.images_in_disk(rim));
    fill_inside(surface, state, plane);
    double left = 0.0;
    const Moebius even = least_area_distortion(
        face_scales(cut.vertices, cut.surface.triangles, as_points(plane.z), balanced_faces), left);
    plane = schottky_plane(cut, state.images_in_disk(even(rim)));
    if (normalization == SchottkyNormalization::circles)
        plane = schottky_plane(cut, state.images_in_disk(nearest_with_room(plane)(even(rim))));
    fill_inside(surface, state, plane);
    return plane;
}

/// Without holes: of the handles whose generator can be z -> lambda z, takes the one with the most even texels.
SchottkyPlane annular_plane(const HandleCut& cut, CondensedLaplacian& surface, const GluedState& state)
{
    SchottkyPlane plane = schottky_plane(cut, state.images_round_infinity());
    fill_inside(surface, state, plane);
    SchottkyPlane best;
    double least = std::numeric_limits<double>::infinity();
    for (int handle = 0; handle < cut.handles; ++handle) {
        SchottkyPlane tried = plane;
        make_annular(tried, handle);
        SchottkyPlane scaled = tried;
        const bool apart = fundamental_circles(scaled).apart;
        const double spread = measure_distortion(cut.vertices, cut.surface.triangles, as_points(tried.z)).area.log_sd +
                              (apart ? 0.0 : worst_spread);
        if (handle > 0 && !(spread < least)) continue;
        least = spread;
        best = std::move(tried);
    }
    return best;
}

CutMap map_of(HandleCut cut, const SchottkyOptions& options, StageSeconds& seconds, double from, double until,
              ExecutionContext& context)
{
    Stopwatch stage;
    context.begin_stage("factor", from, from + 0.6 * (until - from));
    CutMap map;
    map.cut = std::move(cut);
    // Cotangent Laplacian on the intrinsic Delaunay triangulation, condensed onto all loops.
    const IntrinsicMetric metric = intrinsic_metric(map.cut.vertices, map.cut.surface);
    const SparseMatrix laplacian = cotan_laplacian(
        metric.triangles, curvature_weights(metric, map.cut.surface.vertex_count), map.cut.surface.vertex_count);
    seconds.metric += stage.lap();
    CondensedLaplacian surface(laplacian, all_loop_vertices(map.cut));
    seconds.factor += stage.lap();
    context.begin_stage("iterate", from + 0.6 * (until - from), until);
    // The iteration, with the two sides of each cut glued by a Moebius map.
    GluedState state(surface, map.cut.loops);
    while (!map.converged && static_cast<int>(map.changes.size()) < options.max_sweeps) {
        context.checkpoint();
        map.changes.push_back(state.sweep());
        map.converged = map.changes.back() < options.tolerance;
        context.advance(1.0 - std::pow(0.6, static_cast<double>(map.changes.size())));
    }
    // The whole map, and the circles that bound a fundamental domain.
    map.plane = map.cut.holes > 0 ? plane_in_disk(map.cut, surface, state, options.normalization)
                                  : annular_plane(map.cut, surface, state);
    map.circles = fundamental_circles(map.plane);
    seconds.iterate += stage.lap();
    return map;
}

}  // namespace

std::vector<CutMap> cut_maps(HandleCut cut, const FinerFaces& faces, const SchottkyOptions& options,
                             StageSeconds& seconds, ExecutionContext& context)
{
    std::vector<CutMap> maps;
    maps.push_back(map_of(std::move(cut), options, seconds, 0.15, 0.5, context));
    for (int i = 0; i < circle_cuts && maps.back().circles.apart; ++i) {
        std::optional<HandleCut> again =
            cut_along_circles(maps.back().cut, faces, maps.back().plane, maps.back().circles);
        if (!again) break;
        maps.push_back(map_of(std::move(*again), options, seconds, 0.5 + 0.2 * i, 0.7 + 0.2 * i, context));
    }
    return maps;
}

}  // namespace koebe
