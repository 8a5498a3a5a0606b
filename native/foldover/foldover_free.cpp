#include "foldover/foldover_free.h"

#include "foldover/face_energy.h"
#include "linear/sparse_cholesky.h"

#include <Eigen/Dense>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

namespace koebe {
namespace {

using Mobility = FoldoverProblem::Mobility;

constexpr double least_epsilon = 1e-6;  // Garanzha et al. 2021, section 3.2
constexpr double shift = 1e-9;          // of the Hessian's diagonal, over itself
constexpr double armijo = 1e-4;
constexpr double rounded = 1e-14;  // of a sum whose least value is known: what rounding may add to it
constexpr int halvings = 24;
constexpr int patience = 30;  // iterations without a better worst determinant, while folded

class FoldoverMinimizer {
public:
    FoldoverMinimizer(FoldoverProblem& problem, const FoldoverOptions& options)
        : problem_(problem),
          options_(options),
          energy_{options.area_weight, options.power, options.slack},
          first_unknown_(problem.points.rows(), -1)
    {
        for (Eigen::Index v = 0; v < problem.points.rows(); ++v)
            if (problem.mobility[v] != Mobility::held) {
                first_unknown_[v] = unknowns_;
                unknowns_ += unknowns_of(v);
            }
        for (const Track& track : problem.tracks) {
            first_of_track_.push_back(unknowns_);
            unknowns_ += track.straight ? 1 : 3;
        }
        for (std::size_t j = 0; j < problem.periods.size(); ++j) {
            first_of_period_.push_back(unknowns_);
            unknowns_ += j == 0 ? 1 : 2;
        }
        for (const Eigen::Matrix2d& reference : problem.reference) shapes_.emplace_back(reference);
        if (unknowns_ > 0) set_pattern();
    }

    FoldoverResult run(const ExecutionContext& context)
    {
        FoldoverResult result;
        Worth now = worth(problem_.points, problem_.periods);
        if (unknowns_ == 0) return {now.worst > 0.0, 0};
        double best_worst = -std::numeric_limits<double>::infinity();
        int waited = 0;
        for (int iteration = 0; iteration < options_.max_iterations; ++iteration) {
            context.checkpoint();
            energy_.epsilon = std::sqrt(least_epsilon * least_epsilon + 0.04 * std::pow(std::min(now.worst, 0.0), 2));
            if (now.worst > best_worst + 1e-3 * std::abs(best_worst) || now.worst > 0.0) {
                best_worst = now.worst;
                waited = 0;
            } else if (++waited > patience) {
                break;
            }
            ++result.iterations;
            const double before = take_derivatives();
            const bool was_right = now.worst > 0.0;
            const bool has_moved = newton_step(before, now);
            result.hindered = hindered_;
            if (!has_moved || hindered_) break;
            if (before - now.energy < (was_right ? options_.settled : options_.stalled) * (before - options_.least))
                break;
        }
        result.foldover_free = now.worst > 0.0;
        return result;
    }

private:
    /// The sum that is minimized, and the least determinant above its floor.
    struct Worth {
        double energy = 0.0, worst = std::numeric_limits<double>::infinity();
    };

    Index unknowns_of(Index v) const
    {
        return problem_.mobility[v] == Mobility::free ? 2 : problem_.mobility[v] == Mobility::held ? 0 : 1;
    }

    bool rides(Index v) const { return problem_.mobility[v] == Mobility::riding; }

    bool is_lifted(Eigen::Index f) const
    {
        return !problem_.lift.empty() && problem_.lift[f] != std::array<std::array<int, 2>, 3>{};
    }

    /// Whether unknowns that many faces share move its corners.
    bool is_shared(Eigen::Index f) const
    {
        const auto row = problem_.triangles.row(f);
        return is_lifted(f) || (!problem_.tracks.empty() && (rides(row[0]) || rides(row[1]) || rides(row[2])));
    }

    /// An unknown, and where it moves a corner of a face.
    struct Column {
        Index unknown;
        int corner;
        Eigen::Vector2d way;
    };

    /// All unknowns that move the corners of a face.
    std::vector<Column> columns(Eigen::Index f) const
    {
        std::vector<Column> result;
        for (int k = 0; k < 3; ++k) {
            for (std::size_t j = 0; j < problem_.periods.size(); ++j) {
                const int times = problem_.lift[f][k][j];
                const Complex along = problem_.periods[0] / std::abs(problem_.periods[0]);
                if (times == 0) continue;
                if (j == 0) {
                    result.push_back({first_of_period_[0], k, times * Eigen::Vector2d(along.real(), along.imag())});
                    continue;
                }
                result.push_back({first_of_period_[j], k, times * Eigen::Vector2d::UnitX()});
                result.push_back({first_of_period_[j] + 1, k, times * Eigen::Vector2d::UnitY()});
            }
            const Index v = problem_.triangles(f, k), first = first_unknown_[v];
            if (first < 0) continue;
            if (problem_.mobility[v] == Mobility::free) {
                result.push_back({first, k, Eigen::Vector2d::UnitX()});
                result.push_back({first + 1, k, Eigen::Vector2d::UnitY()});
                continue;
            }
            const Eigen::Vector2d along = tangent(v), normal(along[1], -along[0]);
            result.push_back({first, k, along});
            if (!rides(v)) continue;
            const Index shared = first_of_track_[problem_.track_of[v]];
            const bool straight = problem_.tracks[problem_.track_of[v]].straight;
            result.push_back({shared, k, straight ? normal : Eigen::Vector2d::UnitX()});
            if (straight) continue;
            result.push_back({shared + 1, k, Eigen::Vector2d::UnitY()});
            result.push_back({shared + 2, k, normal});
        }
        return result;
    }

    FaceMap face_map(const PlanarPoints& points, const std::vector<Complex>& periods, Eigen::Index f) const
    {
        const bool lifted = is_lifted(f);
        const auto corner = [&](int k) {
            const Index v = problem_.triangles(f, k);
            Complex place(points(v, 0), points(v, 1));
            for (std::size_t j = 0; lifted && j < periods.size(); ++j)
                place += static_cast<double>(problem_.lift[f][k][j]) * periods[j];
            return place;
        };
        const Complex first = corner(0);
        return shapes_[f].map_to(corner(1) - first, corner(2) - first);
    }

    double weight(Eigen::Index f) const { return problem_.weight.size() > 0 ? problem_.weight[f] : 1.0; }

    Worth worth(const PlanarPoints& points, const std::vector<Complex>& periods) const
    {
        Worth result;
        for (Eigen::Index f = 0; f < problem_.triangles.rows(); ++f) {
            const FaceMap map = face_map(points, periods, f);
            result.energy += weight(f) * energy_(map, problem_.floor[f]);
            result.worst = std::min(result.worst, map.determinant() - problem_.floor[f]);
        }
        result.energy += pulls(points);
        return result;
    }

    double pulls(const PlanarPoints& points) const
    {
        double sum = 0.0;
        for (Eigen::Index v = 0; v < problem_.pull.size(); ++v)
            if (pulled(v)) sum += problem_.pull[v] * std::pow(offset(points, v).second, 2);
        return sum;
    }

    bool pulled(Eigen::Index v) const { return problem_.pull[v] > 0.0 && problem_.mobility[v] == Mobility::free; }

    bool to_centre(Eigen::Index v) const { return !problem_.pull_inside.empty() && problem_.pull_inside[v]; }

    /// The outward direction of a pulled vertex and its distance from the circle, or the centre, over the radius.
    std::pair<Eigen::Vector2d, double> offset(const PlanarPoints& points, Eigen::Index v) const
    {
        const Circle& circle = problem_.circles[v];
        const Eigen::Vector2d arm =
            points.row(v).transpose() - Eigen::Vector2d(circle.center.real(), circle.center.imag());
        const double distance = arm.norm();
        const double target = to_centre(v) ? 0.0 : 1.0;
        if (!(distance > 0.0)) return {Eigen::Vector2d::Zero(), -target};
        return {arm / distance, distance / circle.radius - target};
    }

    /// The lower triangle of the Hessian, its columns and rows of one vertex side by side; for each two corners of a
    /// face, where the rows of the later one begin in the first column of the other.
    void set_pattern()
    {
        std::vector<std::pair<Index, Index>> pairs;  // (column's vertex or track, row's), by first unknowns
        std::vector<Index> width_of(unknowns_, 0);
        for (Eigen::Index v = 0; v < problem_.points.rows(); ++v)
            if (first_unknown_[v] >= 0) width_of[first_unknown_[v]] = unknowns_of(v);
        for (std::size_t i = 0; i < problem_.tracks.size(); ++i)
            width_of[first_of_track_[i]] = problem_.tracks[i].straight ? 1 : 3;
        for (std::size_t j = 0; j < problem_.periods.size(); ++j) width_of[first_of_period_[j]] = j == 0 ? 1 : 2;
        for (Index i = 0; i < unknowns_; ++i)
            if (width_of[i] > 0) pairs.emplace_back(i, i);
        for (Eigen::Index f = 0; f < problem_.triangles.rows(); ++f) {
            for (int k = 0; k < 3; ++k)
                if (const auto [a, b] = ends(f, k); a >= 0) pairs.emplace_back(a, b);
            if (is_shared(f)) add_shared_pairs(f, pairs);
        }
        std::ranges::sort(pairs);
        pairs.erase(std::unique(pairs.begin(), pairs.end()), pairs.end());
        std::vector<Index> begin(pairs.size());  // of each pair in the first column of its own
        std::vector<Index> rows, outer{0};
        for (std::size_t i = 0; i < pairs.size();) {
            const Index column = pairs[i].first, width = width_of[column];
            std::vector<Index> below;
            for (; i < pairs.size() && pairs[i].first == column; ++i) {
                begin[i] = static_cast<Index>(below.size());
                for (Index r = 0; r < width_of[pairs[i].second]; ++r) below.push_back(pairs[i].second + r);
            }
            for (Index c = 0; c < width; ++c) {
                rows.insert(rows.end(), below.begin() + c, below.end());
                outer.push_back(static_cast<Index>(rows.size()));
            }
        }
        hessian_.resize(unknowns_, unknowns_);
        hessian_.resizeNonZeros(static_cast<Eigen::Index>(rows.size()));
        std::ranges::copy(outer, hessian_.outerIndexPtr());
        std::ranges::copy(rows, hessian_.innerIndexPtr());
        for (Eigen::Index f = 0; f < problem_.triangles.rows(); ++f) {
            std::array<Index, 3> places{-1, -1, -1};
            for (int k = 0; k < 3; ++k)
                if (const std::pair<Index, Index> pair = ends(f, k); pair.first >= 0)
                    places[k] = begin[std::ranges::lower_bound(pairs, pair) - pairs.begin()];
            places_.push_back(places);
        }
    }

    /// The tracks and periods of a face with its vertices, and with each other.
    void add_shared_pairs(Eigen::Index f, std::vector<std::pair<Index, Index>>& pairs) const
    {
        std::vector<Index> shared;
        for (int k = 0; k < 3; ++k) {
            if (const Index v = problem_.triangles(f, k); rides(v))
                shared.push_back(first_of_track_[problem_.track_of[v]]);
            for (std::size_t j = 0; j < problem_.periods.size(); ++j)
                if (problem_.lift[f][k][j] != 0) shared.push_back(first_of_period_[j]);
        }
        for (const Index own : shared) {
            for (const Index other : problem_.triangles.row(f))
                if (first_unknown_[other] >= 0) pairs.emplace_back(first_unknown_[other], own);
            for (const Index other : shared) pairs.emplace_back(std::minmax(own, other));
        }
    }

    /// The first unknowns of the corners k and k + 1 of a face, the lower one first; -1 if one of them is held.
    std::pair<Index, Index> ends(Eigen::Index f, int k) const
    {
        const Index a = first_unknown_[problem_.triangles(f, k)];
        const Index b = first_unknown_[problem_.triangles(f, (k + 1) % 3)];
        if (a < 0 || b < 0) return {-1, -1};
        return std::minmax(a, b);
    }

    /// The direction in which a sliding or riding vertex moves.
    Eigen::Vector2d tangent(Index v) const
    {
        if (rides(v)) {
            const Track& track = problem_.tracks[problem_.track_of[v]];
            if (track.straight) return {track.direction.real(), track.direction.imag()};
        }
        const Circle& circle = rides(v) ? problem_.tracks[problem_.track_of[v]].circle : problem_.circles[v];
        const Eigen::Vector2d arm(problem_.points(v, 0) - circle.center.real(),
                                  problem_.points(v, 1) - circle.center.imag());
        return Eigen::Vector2d(-arm[1], arm[0]) / arm.norm();
    }

    /// Adds a block to the Hessian. @param place of its rows in the first column
    void add(Index column_vertex, Index row_vertex, Index place, const Eigen::Matrix2d& block)
    {
        const Index first = first_unknown_[column_vertex];
        double* const values = hessian_.valuePtr();
        const Index* const outer = hessian_.outerIndexPtr();
        const bool wide = problem_.mobility[column_vertex] == Mobility::free;
        const bool high = problem_.mobility[row_vertex] == Mobility::free;
        const bool own = column_vertex == row_vertex;
        if (wide && high) {
            values[outer[first] + place] += block(0, 0);
            values[outer[first] + place + 1] += block(1, 0);
            if (!own) values[outer[first + 1] + place - 1] += block(0, 1);
            values[outer[first + 1] + place] += block(1, 1);
        } else if (wide) {
            const Eigen::RowVector2d row = tangent(row_vertex).transpose() * block;
            values[outer[first] + place] += row[0];
            values[outer[first + 1] + place - 1] += row[1];
        } else if (high) {
            const Eigen::Vector2d column = block * tangent(column_vertex);
            values[outer[first] + place] += column[0];
            values[outer[first] + place + 1] += column[1];
        } else {
            values[outer[first] + place] += tangent(row_vertex).dot(block * tangent(column_vertex));
        }
    }

    /// Adds a face that is_shared, whose entries are searched for.
    void add_by_columns(Eigen::Index f, const FaceDerivatives& face)
    {
        const std::vector<Column> all = columns(f);
        for (int k = 0; k < 3; ++k)
            if (const Index v = problem_.triangles(f, k); rides(v)) {
                const Eigen::Vector2d along = tangent(v);
                outward_force_[v] -= face.gradient[k].real() * along[1] - face.gradient[k].imag() * along[0];
            }
        double* const values = hessian_.valuePtr();
        const Index* const outer = hessian_.outerIndexPtr();
        const Index* const inner = hessian_.innerIndexPtr();
        for (const Column& column : all) {
            const Complex g = face.gradient[column.corner];
            gradient_[column.unknown] += column.way.dot(Eigen::Vector2d(g.real(), g.imag()));
            for (const Column& row : all) {
                if (row.unknown < column.unknown) continue;
                const Index* const end = inner + outer[column.unknown + 1];
                const Index* const at = std::lower_bound(inner + outer[column.unknown], end, row.unknown);
                values[at - inner] += row.way.dot(face.block(row.corner, column.corner, shapes_[f]) * column.way);
            }
        }
    }

    /// Fills gradient and Hessian. @return the sum that is minimized
    double take_derivatives()
    {
        gradient_ = VectorXd::Zero(unknowns_);
        std::fill_n(hessian_.valuePtr(), hessian_.nonZeros(), 0.0);
        outward_force_.assign(problem_.track_of.size(), 0.0);
        double energy = 0.0;
        for (Eigen::Index f = 0; f < problem_.triangles.rows(); ++f) {
            const WantedShape& shape = shapes_[f];
            const FaceDerivatives face = energy_.derivatives(face_map(problem_.points, problem_.periods, f),
                                                             problem_.floor[f], weight(f), shape);
            energy += face.term;
            if (is_shared(f)) {
                add_by_columns(f, face);
                continue;
            }
            for (int k = 0; k < 3; ++k) {
                const Index v = problem_.triangles(f, k), first = first_unknown_[v];
                if (first < 0) continue;
                const Eigen::Vector2d g(face.gradient[k].real(), face.gradient[k].imag());
                if (problem_.mobility[v] == Mobility::free)
                    gradient_.segment<2>(first) += g;
                else
                    gradient_[first] += g.dot(tangent(v));
                add(v, v, 0, face.block(k, k, shape));
                if (places_[f][k] < 0) continue;
                const int l = (k + 1) % 3, column = first < first_unknown_[problem_.triangles(f, l)] ? k : l;
                const int row = k + l - column;
                add(problem_.triangles(f, column), problem_.triangles(f, row), places_[f][k],
                    face.block(row, column, shape));
            }
        }
        for (std::size_t v = 0; v < outward_force_.size(); ++v) {
            const Index own = static_cast<Index>(v);
            if (!rides(own)) continue;
            const Track& track = problem_.tracks[problem_.track_of[v]];
            if (!track.straight)
                hessian_.valuePtr()[hessian_.outerIndexPtr()[first_unknown_[v]]] +=
                    std::max(outward_force_[v], 0.0) / track.circle.radius;
        }
        for (Eigen::Index v = 0; v < problem_.pull.size(); ++v) {
            if (!pulled(v)) continue;
            const auto [outward, distance] = offset(problem_.points, v);
            const double weight = 2.0 * problem_.pull[v] / problem_.circles[v].radius;
            gradient_.segment<2>(first_unknown_[v]) += weight * distance * outward;
            Eigen::Matrix2d block = outward * outward.transpose();
            if (to_centre(v)) block.setIdentity();
            add(static_cast<Index>(v), static_cast<Index>(v), 0, weight / problem_.circles[v].radius * block);
        }
        for (Index i = 0; i < unknowns_; ++i) {
            double& diagonal = hessian_.valuePtr()[hessian_.outerIndexPtr()[i]];
            diagonal = diagonal > 0.0 ? (1.0 + shift) * diagonal : 1.0;  // a track that nothing rides on
        }
        return energy + pulls(problem_.points);
    }

    std::vector<Track> moved_tracks(const VectorXd& step, double share) const
    {
        std::vector<Track> tracks = problem_.tracks;
        for (std::size_t i = 0; i < tracks.size(); ++i) {
            const Index first = first_of_track_[i];
            if (tracks[i].straight) {
                tracks[i].point += Complex(0.0, -share * step[first]) * tracks[i].direction;
            } else {
                tracks[i].circle.center += share * Complex(step[first], step[first + 1]);
                tracks[i].circle.radius += share * step[first + 2];
            }
        }
        return tracks;
    }

    std::vector<Complex> moved_periods(const VectorXd& step, double share) const
    {
        std::vector<Complex> periods = problem_.periods;
        for (std::size_t j = 0; j < periods.size(); ++j) {
            const Index first = first_of_period_[j];
            periods[j] += share * (j == 0 ? step[first] * periods[0] / std::abs(periods[0])
                                          : Complex(step[first], step[first + 1]));
        }
        return periods;
    }

    PlanarPoints moved(const VectorXd& step, double share, const std::vector<Track>& tracks) const
    {
        PlanarPoints result = problem_.points;
        for (Eigen::Index v = 0; v < result.rows(); ++v) {
            if (first_unknown_[v] < 0) continue;
            if (problem_.mobility[v] == Mobility::free) {
                result.row(v) += share * step.segment<2>(first_unknown_[v]).transpose();
            } else if (rides(static_cast<Index>(v))) {
                const Complex image = ridden(static_cast<Index>(v), share * step[first_unknown_[v]], tracks);
                result.row(v) << image.real(), image.imag();
            } else {
                const Circle& circle = problem_.circles[v];
                const Complex arm = Complex(result(v, 0), result(v, 1)) - circle.center;
                const double turn = share * step[first_unknown_[v]] / circle.radius;
                const Complex image = circle.center + std::polar(circle.radius, std::arg(arm) + turn);
                result.row(v) << image.real(), image.imag();
            }
        }
        return result;
    }

    /// Where a riding vertex comes by some way along its track, which has moved to one of these.
    Complex ridden(Index v, double way, const std::vector<Track>& tracks) const
    {
        const Track& before = problem_.tracks[problem_.track_of[v]];
        const Track& after = tracks[problem_.track_of[v]];
        const Complex place(problem_.points(v, 0), problem_.points(v, 1));
        if (after.straight) return after.point + (dot(place - before.point, before.direction) + way) * after.direction;
        const double angle = std::arg(place - before.circle.center) + way / before.circle.radius;
        return after.circle.center + std::polar(after.circle.radius, angle);
    }

    /// A damped Newton step for the present epsilon; false if no step decreases the energy.
    /// @param now what the points are worth, taken anew after the step
    bool newton_step(double before, Worth& now)
    {
        VectorXd step = newton_direction();
        double slope = gradient_.dot(step);
        if (!(slope < 0.0) || !step.allFinite()) {
            step = -gradient_.cwiseQuotient(hessian_.diagonal().cwiseMax(1e-300));
            slope = gradient_.dot(step);
            if (!(slope < 0.0)) return false;
        }
        double share = 1.0;
        hindered_ = false;
        for (int i = 0; i < halvings; ++i, share *= 0.5) {
            std::vector<Track> tracks = moved_tracks(step, share);
            std::vector<Complex> periods = moved_periods(step, share);
            PlanarPoints trial = moved(step, share, tracks);
            const Worth there = worth(trial, periods);
            if (options_.strict && !(there.worst > 0.0)) continue;
            if (there.energy <= before + armijo * share * slope + (options_.least > 0.0 ? rounded * before : 0.0)) {
                if (options_.refuses && options_.refuses(trial)) {
                    hindered_ = true;
                    continue;
                }
                problem_.points = std::move(trial);
                problem_.tracks = std::move(tracks);
                problem_.periods = std::move(periods);
                now = there;
                return true;
            }
        }
        return false;
    }

    /// -H^-1 gradient, or 0 if H is singular.
    VectorXd newton_direction()
    {
        try {
            if (solver_)
                solver_->refactorize(hessian_);
            else
                solver_.emplace(hessian_);
            return -solver_->solve(gradient_);
        } catch (const SolverError&) {
            solver_.reset();
            return VectorXd::Zero(unknowns_);
        }
    }

    FoldoverProblem& problem_;
    FoldoverOptions options_;
    FaceEnergy energy_;
    std::vector<Index> first_unknown_;  // per vertex, -1 if held
    std::vector<Index> first_of_track_, first_of_period_;
    Index unknowns_ = 0;
    std::vector<WantedShape> shapes_;           // per face
    std::vector<std::array<Index, 3>> places_;  // per face and corner: see set_pattern
    VectorXd gradient_;
    std::vector<double> outward_force_;  // (V) on riding vertices: less the gradient, along the radius
    SparseMatrix hessian_;
    bool hindered_ = false;  // by what refuses points, in the last step
    std::optional<SparseCholesky> solver_;
};

}  // namespace

FoldoverResult minimize_foldover_free(FoldoverProblem& problem, const ExecutionContext& context,
                                      const FoldoverOptions& options)
{
    return FoldoverMinimizer(problem, options).run(context);
}

}  // namespace koebe
