#include "transfer/sphere_registration.h"

#include "core/errors.h"
#include "foldover/face_energy.h"
#include "linear/sparse_cholesky.h"
#include "sphere/elastic_sphere.h"
#include "sphere/sphere_check.h"
#include "surface/laplacian.h"
#include "transfer/landmark_pins.h"
#include "transfer/sphere_places.h"

#include <Eigen/Geometry>
#include <Eigen/LU>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <string>
#include <utility>

namespace koebe {
namespace {

constexpr double equal_areas = 1.0;    // theta: areas count as much as angles
constexpr double elastic_slack = 0.5;  // of the square of a face's energy
constexpr double sharp_enough = 1e-3;  // a width that spreads known values to unknown ones, and changes no others

/// Fields are smoothed by so much, over the radius of a ball as large as the surface; the stiffness is at least so
/// much.
struct FieldLevel {
    double width, stiffness;
};
constexpr std::array<FieldLevel, 8> field_levels{
    {{0.4, 1.0}, {0.4, 0.3}, {0.2, 0.3}, {0.1, 0.3}, {0.1, 0.1}, {0.05, 0.1}, {0.05, 0.0}, {0.0, 0.0}}};
constexpr int steps_a_level = 40;
constexpr double level_settled = 1e-3;  // relative decrease of the energy at which a level ends,
constexpr double last_settled = 1e-4;   // and at which the last one does
constexpr int steps_on_the_way = 4;     // after each step of the landmarks
constexpr int landmark_trials = 60;     // steps of the landmarks, including those that fail
constexpr double shortest_share = 1.0 / 256;
constexpr double sharpest_cotangent = 20.0;
constexpr double smallest_share = 1e-3;  // of a face's or a vertex' area, over the mean
constexpr double same_place = 1e-12;

double mean_of(const VectorXd& values, const VectorXd& weights) { return values.dot(weights) / weights.sum(); }

/// A field over a surface: smoothed, known everywhere, and with mean 0 and standard deviation 1 where it was known.
class SurfaceField {
public:
    SurfaceField(const SphereSurface& surface, Eigen::Index column, const char* whose)
        : stiffness_(cotan_laplacian(surface.triangles,
                                     half_cotangents(edge_lengths(surface.vertices, surface.triangles)),
                                     static_cast<Index>(surface.points.rows()))),
          areas_(vertex_areas(surface.triangles, edge_lengths(surface.vertices, surface.triangles),
                              static_cast<Index>(surface.points.rows())))
    {
        known_ = areas_;
        values_ = surface.fields.col(column);
        for (Eigen::Index v = 0; v < values_.size(); ++v)
            if (!std::isfinite(values_[v])) known_[v] = values_[v] = 0.0;
        if (!(known_.sum() > 0.0)) throw InputError(std::string("the field of ") + whose + " has no values");
        values_ = standardized(values_);
        if (!(values_.cwiseAbs().maxCoeff() > 0.0))
            throw InputError(std::string("the field of ") + whose + " is the same everywhere");
        radius_ = std::sqrt(areas_.sum() / (4.0 * std::numbers::pi));
        for (Eigen::Index v = 0; v < areas_.size(); ++v)
            if (!(areas_[v] > 0.0)) stiffness_.coeffRef(v, v) += 1.0;  // without a face, or with degenerate faces only
    }

    const VectorXd& known() const { return known_; }

    /// One implicit step of heat flow, which also spreads known values to unknown ones.
    VectorXd smoothed(double width) const
    {
        const bool all = (known_.array() == areas_.array()).all();
        if (all && width == 0.0) return values_;
        const double time = std::pow(std::max(width, sharp_enough) * radius_, 2);
        SparseMatrix matrix = time * stiffness_;
        for (Eigen::Index v = 0; v < known_.size(); ++v) matrix.coeffRef(v, v) += known_[v];
        VectorXd result = SparseCholesky(matrix).solve(known_.cwiseProduct(values_));
        if (width == 0.0) result = (known_.array() > 0.0).select(values_, result);
        return standardized(result);
    }

private:
    VectorXd standardized(const VectorXd& values) const
    {
        const VectorXd centered = values.array() - mean_of(values, known_);
        const double deviation = std::sqrt(mean_of(centered.cwiseAbs2(), known_));
        return deviation > 0.0 ? VectorXd(centered / deviation) : VectorXd(VectorXd::Zero(values.size()));
    }

    SparseMatrix stiffness_;
    VectorXd areas_, known_, values_;  // known_: the areas where the field is known, else 0
    double radius_ = 1.0;
};

class SphereBending {
public:
    SphereBending(const SphereSurface& target, const SphereSurface& source,
                  const std::vector<SphereLandmark>& landmarks, double stiffness, ExecutionContext& context)
        : target_(target),
          source_(source),
          landmarks_(landmarks),
          stiffness_(stiffness),
          context_(context),
          elastic_{source.triangles, {}, {}}
    {
        const EdgeLengths lengths = edge_lengths(source.vertices, source.triangles);
        elastic_.weight.resize(source.triangles.rows());
        for (Eigen::Index f = 0; f < source.triangles.rows(); ++f) {
            elastic_.reference.push_back(flat_edges(source.points, source.triangles, f));
            elastic_.weight[f] = triangle_area(lengths(f, 0), lengths(f, 1), lengths(f, 2));
        }
        areas_ = elastic_.weight;
        elastic_.weight = elastic_.weight.cwiseMax(smallest_share * elastic_.weight.mean());
        elastic_.weight *= stiffness / elastic_.weight.sum();
        elastic_.area_weight = equal_areas;
        elastic_.slack = elastic_slack;
        elastic_.held.assign(static_cast<std::size_t>(source.points.rows()), 0);
        result_.points = source.points;
        used_.assign(elastic_.held.size(), 0);
        for (const Index v : source.triangles.reshaped()) used_[v] = 1;
        require_apart();
    }

    SphereRegistration run()
    {
        context_.begin_stage("landmarks", 0.0, landmarks_.empty() ? 0.0 : 0.3);
        if (!landmarks_.empty()) bring_landmarks();
        context_.begin_stage("bend", landmarks_.empty() ? 0.0 : 0.3, 1.0);
        if (target_.fields.cols() > 0)
            match_fields();
        else
            relax(steps_a_level, last_settled);
        if (find_sphere_faults(source_.triangles, {}, result_.points, {}).any())
            throw SolverError("the bent map does not cover the sphere once");
        measure();
        context_.advance(1.0);
        return std::move(result_);
    }

private:
    void require_apart() const
    {
        for (std::size_t i = 0; i < landmarks_.size(); ++i)
            for (std::size_t j = 0; j < i; ++j)
                if (landmarks_[i].vertex == landmarks_[j].vertex ||
                    (landmarks_[i].place - landmarks_[j].place).norm() < same_place)
                    throw InputError("landmarks " + std::to_string(j) + " and " + std::to_string(i) +
                                         " share a vertex or a place",
                                     ElementKind::landmarks, {static_cast<Index>(j), static_cast<Index>(i)});
    }

    void relax(int most_steps, double settled)
    {
        const ElasticRelaxation done =
            relax_on_sphere(elastic_, result_.points, most_steps, settled, factor_, context_);
        result_.steps += done.steps;
        result_.settled = done.settled;
    }

    /// u' B u is the integral of the squared Laplacian of u over the source's sphere.
    SparseMatrix bending() const
    {
        const Index count = static_cast<Index>(source_.points.rows());
        const EdgeLengths lengths = edge_lengths(source_.points, source_.triangles);
        const SparseMatrix laplacian = cotan_laplacian(
            source_.triangles,
            half_cotangents(lengths).cwiseMin(0.5 * sharpest_cotangent).cwiseMax(-0.5 * sharpest_cotangent), count);
        const VectorXd areas = vertex_areas(source_.triangles, lengths, count);
        const VectorXd weights = areas.cwiseMax(smallest_share * areas.mean()).cwiseInverse() * areas.mean();
        return laplacian * weights.asDiagonal() * laplacian;
    }

    /// The landmark's place after a share of its great circle.
    Eigen::RowVector3d on_way(const SphereLandmark& landmark, double share) const
    {
        if (share >= 1.0) return landmark.place.transpose();
        const Eigen::Vector3d begin = source_.points.row(landmark.vertex);
        const Eigen::Vector3d normal = begin.cross(landmark.place);
        const double angle = std::atan2(normal.norm(), begin.dot(landmark.place));
        const Eigen::Vector3d axis = normal.norm() > 0.0 ? normal.normalized() : begin.unitOrthogonal();
        return (Eigen::AngleAxisd(share * angle, axis) * begin).normalized().transpose();
    }

    void bring_landmarks()
    {
        // Landmarks move along great circles, and all others by a smooth extension of their moves.
        std::vector<char> fixed(elastic_.held.size());
        for (std::size_t v = 0; v < fixed.size(); ++v) fixed[v] = !used_[v];
        for (const SphereLandmark& landmark : landmarks_) fixed[landmark.vertex] = elastic_.held[landmark.vertex] = 1;
        const DirichletSolver extension(bending(), fixed);
        double reached = 0.0, share = 1.0;
        for (int trial = 0; trial < landmark_trials && reached < 1.0; ++trial) {
            context_.advance(reached);
            const double step = std::min(share, 1.0 - reached);
            // A step, back to the sphere. It counts if no face turns over.
            Vertices moves = Vertices::Zero(result_.points.rows(), 3);
            for (const SphereLandmark& landmark : landmarks_)
                moves.row(landmark.vertex) = on_way(landmark, reached + step) - result_.points.row(landmark.vertex);
            Vertices next = result_.points + Vertices(extension.solve(moves));
            next.rowwise().normalize();
            for (const SphereLandmark& landmark : landmarks_)
                next.row(landmark.vertex) = on_way(landmark, reached + step);
            if (next.allFinite() && all_upright(source_.triangles, next)) {
                result_.points = std::move(next);
                reached += step;
                share = 2.0 * step;
                if (reached < 1.0) relax(steps_on_the_way, last_settled);
            } else if ((share = 0.5 * step) < shortest_share) {
                break;
            }
        }
        if (reached < 1.0) refuse(reached + share);
    }

    /// @throws SolverError with the landmarks at faces that turn over in the next step, or all of them
    [[noreturn]] void refuse(double share) const
    {
        Vertices next = result_.points;
        for (const SphereLandmark& landmark : landmarks_) next.row(landmark.vertex) = on_way(landmark, share);
        std::vector<char> folded(elastic_.held.size(), 0);
        for (Index f = 0; f < static_cast<Index>(source_.triangles.rows()); ++f)
            if (!upright_on_sphere(source_.triangles, next, f))
                for (const Index v : source_.triangles.row(f)) folded[v] = 1;
        std::vector<Index> stuck;
        for (std::size_t i = 0; i < landmarks_.size(); ++i)
            if (folded[landmarks_[i].vertex]) stuck.push_back(static_cast<Index>(i));
        for (std::size_t i = 0; stuck.size() == i && i < landmarks_.size(); ++i) stuck.push_back(static_cast<Index>(i));
        throw SolverError("no one-to-one map was found: the landmarks block each other, or the mesh is too coarse for "
                          "them, worst at " +
                              landmark_numbers(stuck),
                          ElementKind::landmarks, stuck);
    }

    void match_fields()
    {
        std::vector<SurfaceField> on_target, on_source;
        std::vector<VectorXd> weights;  // per field: roots, of the squares of its residuals
        for (Eigen::Index k = 0; k < target_.fields.cols(); ++k) {
            on_target.emplace_back(target_, k, "a");
            on_source.emplace_back(source_, k, "b");
            const VectorXd& known = on_source.back().known();
            weights.push_back((known / (known.sum() * static_cast<double>(target_.fields.cols()))).cwiseSqrt());
        }
        const SpherePlaces places(target_.points, target_.triangles);
        std::vector<Index> face(elastic_.held.size(), -1);  // that held the vertex last
        const VectorXd per_stiffness = elastic_.weight / stiffness_;
        for (std::size_t i = 0; i < field_levels.size(); ++i) {
            const FieldLevel& level = field_levels[i];
            context_.advance(static_cast<double>(i) / field_levels.size());
            elastic_.weight = per_stiffness * std::max(stiffness_, level.stiffness);
            MatrixXd wanted(source_.fields.rows(), source_.fields.cols()), given(target_.fields.rows(), wanted.cols());
            for (Eigen::Index k = 0; k < wanted.cols(); ++k) {
                wanted.col(k) = on_source[k].smoothed(level.width);
                given.col(k) = on_target[k].smoothed(level.width);
            }
            elastic_.residuals = [&](const Vertices& points, std::vector<Vertices>* slopes) {
                MatrixXd residuals = MatrixXd::Zero(points.rows(), wanted.cols());
                if (slopes) slopes->assign(weights.size(), Vertices::Zero(points.rows(), 3));
                for (Eigen::Index v = 0; v < points.rows(); ++v) {
                    if (!used_[v]) continue;
                    const Eigen::Vector3d place = points.row(v);
                    const SurfacePoint at = places.at(place, face[v]);
                    face[v] = at.face;
                    const auto corners = target_.triangles.row(at.face);
                    Eigen::Matrix3d normal;  // the weights are these rows times the place, over the sum of all three
                    for (int c = 0; c < 3; ++c)
                        normal.row(c) =
                            target_.points.row(corners[(c + 1) % 3]).cross(target_.points.row(corners[(c + 2) % 3]));
                    const Eigen::RowVector3d whole = normal.colwise().sum();
                    for (Eigen::Index k = 0; k < wanted.cols(); ++k) {
                        const Eigen::RowVector3d values(given(corners[0], k), given(corners[1], k),
                                                        given(corners[2], k));
                        const double value = at.weights.dot(values), weight = weights[k][v];
                        residuals(v, k) = weight * (value - wanted(v, k));
                        if (slopes) (*slopes)[k].row(v) = weight * (values * normal - value * whole) / whole.dot(place);
                    }
                }
                return residuals;
            };
            relax(steps_a_level, level.width > 0.0 ? level_settled : last_settled);
        }
    }

    void measure()
    {
        VectorXd logs(areas_.size());
        double mu = 0.0;
        for (Eigen::Index f = 0; f < areas_.size(); ++f) {
            const Eigen::Matrix2d edges = flat_edges(result_.points, source_.triangles, f);
            const FaceMap map =
                WantedShape(elastic_.reference[f]).map_to({edges(0, 0), edges(1, 0)}, {edges(0, 1), edges(1, 1)});
            const double here = std::abs(map.unlike) / std::abs(map.like);
            mu += areas_[f] * here;
            result_.beltrami.max = std::max(result_.beltrami.max, here);
            logs[f] = std::log(map.determinant());
        }
        result_.beltrami.mean = mu / areas_.sum();
        const VectorXd centered = logs.array() - mean_of(logs, areas_);
        result_.log_area_sd = std::sqrt(mean_of(centered.cwiseAbs2(), areas_));
    }

    const SphereSurface& target_;
    const SphereSurface& source_;
    const std::vector<SphereLandmark>& landmarks_;
    double stiffness_;
    ExecutionContext& context_;
    ElasticSphere elastic_;
    KeptFactor factor_;       // of its Hessian
    VectorXd areas_;          // (F) on the source's surface
    std::vector<char> used_;  // (V) 1: has a face
    SphereRegistration result_;
};

}  // namespace

SphereRegistration register_spheres(const SphereSurface& target, const SphereSurface& source,
                                    const std::vector<SphereLandmark>& landmarks, double stiffness,
                                    ExecutionContext& context)
{
    return SphereBending(target, source, landmarks, stiffness, context).run();
}

}  // namespace koebe
