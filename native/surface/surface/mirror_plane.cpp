#include "surface/mirror_plane.h"

#include "surface/nearest_triangles.h"

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace koebe {
namespace {

constexpr Eigen::Index most_samples = 800;
constexpr Eigen::Index first_samples = 200;  // for planes that are not fitted yet
constexpr int turns = 5;                     // of fitting the plane
constexpr double most_off = 0.01;            // of the diagonal: mean distance of images from the surface
constexpr double clearly = 0.002;            // the same, for a plane beside which no other one is looked for
constexpr double worth_fitting = 0.06;       // the same, for a plane that is fitted
constexpr double still_better = 0.95;        // of the distance before: the least gain for which fitting goes on
constexpr double far_image = 0.02;           // of the diagonal: images as far count half
constexpr double near_plane = 0.01;          // of the diagonal: samples nearer to the plane lie in it
constexpr double most_flat = 0.5;            // share of the area

/// Middles of faces that are samples of the surface, and their areas.
struct Samples {
    Vertices points;
    VectorXd areas;
};

Samples samples_of(const Vertices& vertices, const Triangles& triangles, Eigen::Index most)
{
    const Eigen::Index count = triangles.rows(), step = std::max<Eigen::Index>(1, count / most);
    Samples all{Vertices((count + step - 1) / step, 3), VectorXd((count + step - 1) / step)};
    for (Eigen::Index f = 0, i = 0; f < count; f += step, ++i) {
        const Eigen::RowVector3d a = vertices.row(triangles(f, 0)), b = vertices.row(triangles(f, 1)),
                                 c = vertices.row(triangles(f, 2));
        all.points.row(i) = (a + b + c) / 3.0;
        all.areas[i] = (b - a).cross(c - a).norm();
    }
    return all;
}

/// Where on the surface the images of samples nearly are.
struct Images {
    Vertices places, normals;  // of the surface there
    VectorXd distance;
    double off = 0.0;  // mean distance
};

/// For some planes at once.
std::vector<Images> images_in(const std::vector<MirrorPlane>& planes, const Samples& samples, const Vertices& vertices,
                              const Triangles& triangles)
{
    const Eigen::Index count = samples.points.rows();
    // The images under all planes, in one search for nearest faces.
    Vertices images(count * static_cast<Eigen::Index>(planes.size()), 3);
    for (Eigen::Index i = 0; i < images.rows(); ++i)
        images.row(i) = planes[static_cast<std::size_t>(i / count)].image(samples.points.row(i % count));
    const PlacesInTriangles nearest = nearest_triangles(vertices, triangles, images);
    std::vector<Images> all(planes.size());
    // For each plane the nearest places, the normals there, and the mean distance by area.
    for (std::size_t k = 0; k < planes.size(); ++k) {
        const Eigen::Index first = static_cast<Eigen::Index>(k) * count;
        Images& own = all[k];
        own.places.resize(count, 3);
        own.normals.resize(count, 3);
        own.distance = nearest.distance.segment(first, count);
        own.off = own.distance.dot(samples.areas) / samples.areas.sum();
        for (Eigen::Index i = 0; i < count; ++i) {
            const auto face = triangles.row(nearest.face[first + i]);
            const Eigen::RowVector3d a = vertices.row(face[0]), b = vertices.row(face[1]), c = vertices.row(face[2]);
            const Eigen::RowVector3d weights = nearest.weights.row(first + i);
            own.places.row(i) = weights[0] * a + weights[1] * b + weights[2] * c;
            own.normals.row(i) = (b - a).cross(c - a).normalized();
        }
    }
    return all;
}

/// A plane in which images lie nearer to the surface: one step of Gauss and Newton for their distances along the
/// surface's normals (Chen and Medioni 1992). Far images count less.
MirrorPlane fitted(const MirrorPlane& plane, const Samples& samples, const Images& images, double diagonal)
{
    const Eigen::RowVector3d u = plane.normal.unitOrthogonal(), v = plane.normal.cross(u);
    Eigen::Matrix3d matrix = 1e-12 * diagonal * diagonal * samples.areas.sum() * Eigen::Matrix3d::Identity();
    Eigen::Vector3d load = Eigen::Vector3d::Zero();
    for (Eigen::Index i = 0; i < samples.points.rows(); ++i) {
        const Eigen::RowVector3d point = samples.points.row(i), normal = images.normals.row(i);
        const double d = plane.distance(point);
        const auto moved = [&](const Eigen::RowVector3d& turn) {  // by a turn of the plane's normal
            return -2.0 * normal.dot((point - plane.center).dot(turn) * plane.normal + d * turn);
        };
        const Eigen::Vector3d slope(moved(u), moved(v), 2.0 * normal.dot(plane.normal) * diagonal);
        const double off = normal.dot(plane.image(point) - images.places.row(i));
        const double weight = samples.areas[i] / (1.0 + std::pow(images.distance[i] / (far_image * diagonal), 2));
        matrix += weight * slope * slope.transpose();
        load -= weight * off * slope;
    }
    const Eigen::Vector3d step = matrix.ldlt().solve(load);
    if (!step.allFinite()) return plane;
    return {(plane.normal + step[0] * u + step[1] * v).normalized(), plane.center + step[2] * diagonal * plane.normal};
}

/// Whether most of the surface lies in a plane: that is not its mirror.
bool lies_in(const MirrorPlane& plane, const Samples& samples, double diagonal)
{
    double area = 0.0;
    for (Eigen::Index i = 0; i < samples.points.rows(); ++i)
        if (std::abs(plane.distance(samples.points.row(i))) < near_plane * diagonal) area += samples.areas[i];
    return area > most_flat * samples.areas.sum();
}

}  // namespace

std::vector<MirrorPlane> possible_mirrors(const Vertices& points, const VectorXd& weights)
{
    const Eigen::RowVector3d center = weights.transpose() * points / weights.sum();
    const Vertices arms = points.rowwise() - center;
    const Eigen::Matrix3d spread = arms.transpose() * weights.asDiagonal() * arms;
    std::vector<MirrorPlane> planes;
    for (int k = 0; k < 3; ++k) planes.push_back({Eigen::RowVector3d::Unit(k), center});
    if (!spread.allFinite()) return planes;
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> axes(spread);
    for (int k = 0; k < 3; ++k) planes.push_back({axes.eigenvectors().col(k).transpose(), center});
    return planes;
}

MirrorPlane plane_between(const Vertices& vertices, const std::vector<Index>& image)
{
    MirrorPlane plane{Eigen::RowVector3d::Zero(), Eigen::RowVector3d::Zero()};
    double count = 0.0;
    for (std::size_t v = 0; v < image.size(); ++v) {
        if (image[v] < 0) continue;
        const Eigen::RowVector3d here = vertices.row(static_cast<Eigen::Index>(v)), there = vertices.row(image[v]);
        if ((here - there).norm() > plane.normal.norm()) plane.normal = here - there;
        plane.center += 0.5 * (here + there);
        count += 1.0;
    }
    plane.normal.normalize();
    plane.center /= count;
    return plane;
}

std::optional<MirrorPlane> nearly_mirror(const Vertices& vertices, const Triangles& triangles)
{
    const Samples samples = samples_of(vertices, triangles, most_samples);
    const double diagonal = (vertices.colwise().maxCoeff() - vertices.colwise().minCoeff()).norm();
    if (!(samples.areas.sum() > 0.0)) return {};
    const Samples few = samples_of(vertices, triangles, first_samples);
    std::vector<MirrorPlane> planes = possible_mirrors(samples.points, samples.areas);
    std::vector<double> before(planes.size(), std::numeric_limits<double>::infinity());  // mean distances
    std::optional<MirrorPlane> best;
    double least = most_off * diagonal;
    for (int turn = 0; turn <= turns && !planes.empty(); ++turn) {
        const Samples& at = turn == 0 ? few : samples;
        const std::vector<Images> images = images_in(planes, at, vertices, triangles);
        std::vector<MirrorPlane> next;
        std::vector<double> now;
        for (std::size_t k = 0; k < planes.size(); ++k) {
            const double off = images[k].off;
            if (!(off < worth_fitting * diagonal) || lies_in(planes[k], samples, diagonal)) continue;
            if (turn > 0 && off < least) {
                least = off;
                best = planes[k];
            }
            if (!(off < still_better * before[k])) {
                if (off < clearly * diagonal) return best;
                continue;
            }
            next.push_back(fitted(planes[k], at, images[k], diagonal));
            now.push_back(off);
        }
        planes = std::move(next);
        before = std::move(now);
    }
    return best;
}

}  // namespace koebe
