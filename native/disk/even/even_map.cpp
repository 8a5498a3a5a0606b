#include "even/even_map.h"

#include "core/errors.h"
#include "core/types.h"
#include "even/wanted_shapes.h"
#include "foldover/face_energy.h"
#include "foldover/newton_system.h"
#include "foldover/turn_upright.h"
#include "foldover/void_mesh.h"
#include "planar/boundary_crossings.h"
#include "planar/planar_predicates.h"
#include "quality/stored_uv.h"
#include "surface/laplacian.h"

#include <Eigen/LU>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <span>
#include <utility>
#include <vector>

namespace koebe {
namespace {

using Mobility = FoldoverProblem::Mobility;

constexpr double longest_approach = 8.0;     // most ratio of a face's next area to its present area,
constexpr double few_far = 1e-3;             // until the wanted sizes differ by more only on this share of the area
constexpr double much_far = 0.1;             // and the way is so long that its energy may rise
constexpr int rising_rounds = 4;             // in which that share and the energy may rise on a large surface;
constexpr Eigen::Index small_surface = 500;  // faces: with no more they may rise longer, which takes little time
constexpr double all_far = 0.95;             // and on more no way ends: the surface is made of needles
constexpr double nearer = 0.9;               // and as long as this share, or the energy, falls to this
constexpr double much_less = 0.99;           // the energy must fall to this, for faces to go on
constexpr int steps_an_approach = 4;
constexpr double settled_decrease = 5e-4;  // relative decrease of the energy
constexpr double exact_length = 1e-6;      // of a face's longest edge: error of an edge that is true to size
constexpr int steps_a_round = 5;           // with the void,
constexpr double settled_round = 1e-3;     // and the relative decrease of the energy at which they end
constexpr double void_weight = 1e-3;       // weight of a face of the void, over a mean face of the surface
constexpr double least_weight = 1e-3;      // weight of a face of the surface, over the mean
constexpr double hopeless = 100.0;         // ratio of a face's stretches: above it a face weighs less
constexpr std::size_t any_circle = 3;      // points lie on a circle wherever they are
constexpr double least_gap = 1e-4;         // between loops, over the extent
constexpr double area_rounding = 1.5e-7;   // twice the area lost by 32-bit floats, over the edge and the extent
constexpr double ample_face = 1000.0;      // times that: a face as large is not hindered
constexpr double shortest_drawn = 1e-7;    // over the extent: shorter edges say nothing about a loop's course
constexpr double held_power = 2.0;  // of the energy: at 1 held vertices of fine meshes move only their neighbours
constexpr int fine_grid = 1 << 21;  // with the void, which opens narrow gaps again
constexpr std::array grids{1 << 19, 1 << 20, 1 << 21, 1 << 22};  // points along the extent; 32-bit floats have 1 << 24

double area(const CornerPlaces& at) { return 0.5 * cross(at[1] - at[0], at[2] - at[0]); }

double longest_edge(const CornerPlaces& at)
{
    return std::max({std::abs(at[1] - at[0]), std::abs(at[2] - at[1]), std::abs(at[0] - at[2])});
}

class EvenProblem {
public:
    EvenProblem(const FlatSurface& flat, double even, double extent, const EvenEffort& effort,
                ExecutionContext& context, NewtonPattern& pattern)
        : flat_(flat),
          weight_(area_weight(even)),
          extent_(extent),
          effort_(effort),
          context_(context),
          pattern_(pattern)
    {
        ride();
        mobility_.assign(static_cast<std::size_t>(flat.points.rows()), Mobility::free);
        track_of_.assign(mobility_.size(), -1);
        std::vector<char> rides(mobility_.size(), 0);
        for (std::size_t k = 0; k < flat.round.size(); ++k)
            for (const Index v : flat.round[k].vertices) {
                mobility_[v] = Mobility::riding;
                track_of_[v] = static_cast<int>(k);
                rides[v] = 1;
            }
        for (const Index v : flat.held) {
            mobility_[v] = Mobility::held;
            rides[v] = 1;
        }
        if (!flat.periods) turn_upright(flat.vertices, flat.triangles, flat.loops, rides, flat.points, context);
        shapes_ = wanted_shapes(flat.vertices, flat.triangles, flat.points, flat.sizes);
        if (!apart(flat.points, 0.0)) shortest_ = shortest_drawn * extent;
        for (const int grid : grids)
            if (grid_ == 0 && apart_on_grid(flat.points, grid)) grid_ = grid;
        // Otherwise the whole map could move, so one vertex stays.
        if (!flat.held.empty() || !flat.pull.vertices.empty()) return;
        if (const auto free = std::ranges::find(mobility_, Mobility::free); free != mobility_.end())
            *free = Mobility::held;
    }

    bool one_to_one() const { return one_to_one(flat_.points, periods()); }
    bool one_to_one(const PlanarPoints& points, const std::vector<Complex>& periods) const
    {
        if (!points.allFinite()) return false;
        for (Eigen::Index f = 0; f < flat_.triangles.rows(); ++f)
            if (!(area(corners(points, periods, f)) > 0.0)) return false;
        return apart(points, shortest_);
    }

    /// Minimizes without the void, at first towards sizes near the present sizes (Liu, Ye, Ni and Fu 2018).
    /// @return whether a loop was in the way
    bool relax_alone(EvenMap& result)
    {
        double before = std::numeric_limits<double>::infinity(), energy_before = before;
        for (double far = far_off(); far > few_far && !is_spent(result); far = far_off()) {
            const double now = energy();
            if (!(far < nearer * before) && !(now < nearer * energy_before)) break;
            before = far;
            energy_before = now;
            if (relax_once(result, std::min(steps_an_approach, effort_.most_in_all - result.iterations))) return true;
        }
        for (double before = energy_before; true; before = energy()) {  // again while a face is still on its way
            if (relax_once(result, effort_.most_steps)) return true;
            if (is_spent(result) || !(far_off() > 0.0) || !(energy() < much_less * before)) return false;
        }
    }

    bool is_spent(const EvenMap& result) const { return result.iterations >= effort_.most_in_all; }

    bool relax_once(EvenMap& result, int iterations)
    {
        FoldoverProblem problem = surface_problem();
        const FoldoverResult done = minimize(problem, iterations, grid_, &pattern_);
        take_solution(problem, done, result);
        return done.hindered;
    }

    void relax_with_void(EvenMap& result)
    {
        const double first = energy();
        const PlanarPoints points = flat_.points;
        const std::vector<RoundLoop> round = flat_.round;
        const double off = far_off();
        const int most_far = off > much_far && off < all_far ? effort_.most_far : 0;
        go_rounds_with_void(first, off, most_far, result);
        if (most_far == 0 || energy() < first) return;
        flat_.points = points;  // the way was too long
        flat_.round = round;
    }

private:
    /// @param first, first_off energy() and far_off() @param most_far rounds while faces are far from their size
    void go_rounds_with_void(double first, double first_off, int most_far, EvenMap& result)
    {
        double before = first;
        for (int round = 0, far = 0; round < effort_.most_rounds;) {
            FoldoverProblem problem = surface_problem();
            try {
                add_void(void_mesh(flat_.loops, problem.points, VoidPoints::frame),
                         void_weight / static_cast<double>(flat_.triangles.rows()), least_gap * extent_, problem);
            } catch (const InputError&) {
                return;
            }
            const FoldoverResult done = minimize(problem, steps_a_round, grid_ > 0 ? std::max(grid_, fine_grid) : 0);
            const PlanarPoints last = flat_.points;
            take_solution(problem, done, result);
            if (flat_.points == last) return;
            ++result.rounds;
            const double now = energy();
            // From far off the energy rises before it falls: most faces shrink until the narrow places are through.
            const bool is_far = far < most_far && done.iterations > 0 && far_off() > much_far;
            if (!is_far && !(before - now > settled_round * before)) return;
            ++(is_far ? far : round);
            if (far >= rising_rounds && flat_.triangles.rows() > small_surface && now > first && far_off() > first_off)
                return;
            before = now;
        }
    }

    double power() const { return flat_.held.empty() ? 1.0 : held_power; }

    /// Lower bound of the minimized sum.
    double least_sum(const FoldoverProblem& problem) const
    {
        return problem.weight.sum() * (flat_.held.empty() ? 2.0 * (1.0 + weight_) : std::pow(weight_, held_power));
    }

    /// @param grid on which loops stay apart; 0: none
    FoldoverResult minimize(FoldoverProblem& problem, int iterations, int grid, NewtonPattern* pattern = nullptr) const
    {
        const Eigen::Index own = flat_.points.rows();
        return minimize_foldover_free(problem, context_,
                                      {.max_iterations = iterations,
                                       .area_weight = weight_,
                                       .settled = settled_decrease,
                                       .least = least_sum(problem),
                                       .strict = true,
                                       .power = power(),
                                       .pattern = pattern,
                                       .refuses = [&](const FoldoverPlaces& places) {
                                           const PlanarPoints points = places.points.topRows(own);
                                           return !(grid > 0 ? apart_on_grid(points, grid)
                                                             : apart(points, shortest_)) ||
                                                  (flat_.refuses && flat_.refuses(places));
                                       }});
    }

    /// Puts vertices exactly onto their tracks, and frees those whose faces would turn over or lose half their area.
    void ride()
    {
        const PlanarPoints before = flat_.points;
        for (const RoundLoop& loop : flat_.round)
            for (const Index v : loop.vertices) {
                const Complex place = loop.track.nearest({before(v, 0), before(v, 1)});
                flat_.points.row(v) << place.real(), place.imag();
            }
        std::vector<char> freed(static_cast<std::size_t>(before.rows()), 0);
        for (bool again = true; std::exchange(again, false);)
            for (Eigen::Index f = 0; f < flat_.triangles.rows(); ++f) {
                if (area(corners(f)) >= 0.5 * area(corners(before, periods(), f))) continue;
                for (const Index v : flat_.triangles.row(f)) {
                    if (flat_.points.row(v) == before.row(v)) continue;
                    flat_.points.row(v) = before.row(v);
                    freed[v] = again = true;
                }
            }
        for (RoundLoop& loop : flat_.round) {
            std::erase_if(loop.vertices, [&](Index v) { return freed[v]; });
            if (loop.vertices.size() <= any_circle) loop.vertices.clear();
        }
    }

    CornerPlaces corners(const PlanarPoints& points, const std::vector<Complex>& periods, Eigen::Index f) const
    {
        return corners_of(points, flat_.triangles, flat_.lift, periods, f);
    }
    CornerPlaces corners(Eigen::Index f) const { return corners(flat_.points, periods(), f); }

    const std::vector<Complex>& periods() const { return flat_.periods ? *flat_.periods : none_; }

    /// Whether no loop crosses itself or another, and none is turned over.
    bool apart(const PlanarPoints& points, double shortest) const
    {
        const LoopDrawing drawing{points, shortest};
        return apart(std::span(&drawing, 1), 0.0);
    }

    /// The same in several drawings that are nearly alike. @param reach as in loops_cross
    bool apart(std::span<const LoopDrawing> drawings, double reach) const
    {
        if (flat_.periods)
            return std::ranges::all_of(flat_.loops, [&](const VertexLoop& loop) {
                return std::ranges::all_of(drawings,
                                           [&](const auto& of) { return enclosed_area(loop, of.points) < 0.0; }) &&
                       !loops_cross({loop}, drawings, reach);
            });
        return std::ranges::all_of(
                   drawings,
                   [&](const auto& of) { return turned_loops(flat_.loops, of.points, of.shortest).empty(); }) &&
               !loops_cross(flat_.loops, drawings, reach);
    }

    /// The same also when points are rounded more coarsely than they will be stored, on two grids half a cell apart: on
    /// one grid alone two sides that all but touch may lie in two cells by chance.
    bool apart_on_grid(const PlanarPoints& points, int grid) const
    {
        const double cell = extent_ / grid, least = shortest_drawn * extent_;
        const PlanarPoints first = (points.array() / cell).round() * cell;
        const PlanarPoints second = (points.array() / cell + 0.5).round() * cell;
        return apart(std::array{LoopDrawing{points, shortest_}, LoopDrawing{first, least}, LoopDrawing{second, least}},
                     cell);
    }

    /// The share of the surface's area in faces that are far from their size.
    double far_off() const
    {
        double far = 0.0;
        for (Eigen::Index f = 0; f < flat_.triangles.rows(); ++f) {
            const double ratio = area(corners(f)) / shapes_.areas[f];
            if (std::max(ratio, 1.0 / ratio) > longest_approach) far += shapes_.areas[f];
        }
        return far / shapes_.areas.sum();
    }

    FaceMap face_map(const Eigen::Matrix2d& reference, Eigen::Index f) const
    {
        const CornerPlaces at = corners(f);
        return WantedShape(reference).map_to(at[1] - at[0], at[2] - at[0]);
    }

    double weight_of(Eigen::Index f) const { return flat_.weights.size() > 0 ? flat_.weights[f] : 1.0; }

    double mean_area() const { return shapes_.areas.sum() / static_cast<double>(shapes_.areas.size()); }

    FoldoverProblem surface_problem() const
    {
        FoldoverProblem problem;
        problem.points = flat_.points;
        problem.triangles = flat_.triangles;
        problem.reference = shapes_.references;
        problem.weight = shapes_.areas.cwiseMax(least_weight * mean_area()) / shapes_.areas.sum();
        problem.floor.resize(flat_.triangles.rows());
        // Each face asks for its area on the surface, but for at most a bounded change of its present area.
        for (Eigen::Index f = 0; f < flat_.triangles.rows(); ++f) {
            const CornerPlaces at = corners(f);
            const double now = area(at);
            const double wanted = std::clamp(shapes_.areas[f], now / longest_approach, now * longest_approach);
            problem.reference[f] *= std::sqrt(wanted / shapes_.areas[f]);
            // Faces that are stretched beyond hope count less: they would hold all others.
            const FaceMap map = face_map(problem.reference[f], f);
            problem.weight[f] *= weight_of(f) * std::min(1.0, hopeless * map.determinant() / map.squared_norm());
            // Faces near the rounding of the grid have a floor that they do not sink below.
            const double least = 0.5 * area_rounding * extent_ * longest_edge(at);
            problem.floor[f] = std::min(now, wanted) > ample_face * least ? 0.0 : std::min(least, 0.5 * now) / wanted;
        }
        // Who moves, and along which track.
        problem.mobility = mobility_;
        problem.track_of = track_of_;
        for (const RoundLoop& loop : flat_.round) problem.tracks.push_back(loop.track);
        problem.lift = flat_.lift;
        problem.periods = periods();
        add_pull(problem);
        return problem;
    }

    void add_pull(FoldoverProblem& problem) const
    {
        const PlacePull& pull = flat_.pull;
        if (pull.vertices.empty()) return;
        problem.circles.resize(mobility_.size());
        problem.pull = VectorXd::Zero(flat_.points.rows());
        problem.pull_inside.assign(mobility_.size(), 1);
        for (std::size_t i = 0; i < pull.vertices.size(); ++i) {
            const auto row = static_cast<Eigen::Index>(i);
            problem.circles[pull.vertices[i]] = {Complex(pull.places(row, 0), pull.places(row, 1)), extent_};
            problem.pull[pull.vertices[i]] = pull.weight;
        }
    }

    void take_solution(const FoldoverProblem& problem, const FoldoverResult& done, EvenMap& result)
    {
        result.iterations += done.iterations;
        const PlanarPoints points = problem.points.topRows(flat_.points.rows());
        if (!one_to_one(points, problem.periods)) return;
        flat_.points = points;
        if (flat_.periods) *flat_.periods = problem.periods;
        for (std::size_t k = 0; k < flat_.round.size(); ++k) flat_.round[k].track = problem.tracks[k];
        result.moved = true;
    }

    /// E_t of the surface, per area.
    double energy() const
    {
        const VectorXd& weights = flat_.weights;
        const double area = weights.size() > 0 ? weights.dot(shapes_.areas) : shapes_.areas.sum();
        double sum = 0.0;
        for (Eigen::Index f = 0; f < flat_.triangles.rows(); ++f) {
            const FaceMap map = face_map(shapes_.references[f], f);
            const double d = map.determinant();
            sum += weight_of(f) * shapes_.areas[f] *
                   (std::min(map.squared_norm() / d, hopeless) + weight_ * (d + 1.0 / d));
        }
        return sum / area - 2.0 * (1.0 + weight_);
    }

    FlatSurface flat_;
    double weight_, extent_;
    EvenEffort effort_;
    double shortest_ = 0.0;  // edges that count, in the unit of the points
    int grid_ = 0;           // the coarsest on which loops are apart at first, and so after each step; 0: none
    ExecutionContext& context_;
    PatchShapes shapes_;
    std::vector<Mobility> mobility_;
    std::vector<int> track_of_;
    NewtonPattern& pattern_;           // of the surface without the void
    const std::vector<Complex> none_;  // for maps without periods
};

}  // namespace

void require_even(double even)
{
    if (!(even >= 0.0 && even <= 1.0)) throw InputError("even must be from 0 to 1");
}

double scale_to_size(const Vertices& vertices, const Triangles& triangles, double image_area)
{
    const EdgeLengths lengths = edge_lengths(vertices, triangles);
    double area = 0.0;
    for (Eigen::Index f = 0; f < triangles.rows(); ++f)
        area += triangle_area(lengths(f, 0), lengths(f, 1), lengths(f, 2));
    return std::sqrt(area / image_area);
}

double area_weight(double even) { return even / (1.1 - even); }

bool is_true_to_size(const Vertices& vertices, const Triangles& triangles, const PlanarPoints& points,
                     const VectorXd& sizes)
{
    for (Eigen::Index f = 0; f < triangles.rows(); ++f) {
        const double scale = sizes.size() > 0 ? std::sqrt(sizes[f]) : 1.0;
        double error = 0.0, longest = 0.0;
        for (int k = 0; k < 3; ++k) {
            const Index a = triangles(f, k), b = triangles(f, (k + 1) % 3);
            const double length = scale * (vertices.row(a) - vertices.row(b)).norm();
            error = std::max(error, std::abs((points.row(a) - points.row(b)).norm() - length));
            longest = std::max(longest, length);
        }
        if (!(error < exact_length * longest)) return false;
    }
    return true;
}

EvenMap make_even(const FlatSurface& surface, double even, double extent, ExecutionContext& context,
                  const EvenEffort& effort, NewtonPattern* pattern)
{
    EvenMap result;
    NewtonPattern own;
    EvenProblem problem(surface, even, extent, effort, context, pattern ? *pattern : own);
    if (!(even > 0.0) || !problem.one_to_one()) return result;
    result.moved = !surface.periods && surface.pull.vertices.empty() &&
                   is_true_to_size(surface.vertices, surface.triangles, surface.points, surface.sizes);
    if (result.moved) return result;
    if (problem.relax_alone(result) && !surface.periods) problem.relax_with_void(result);
    return result;
}

}  // namespace koebe
