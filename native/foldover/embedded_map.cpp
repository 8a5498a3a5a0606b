#include "foldover/embedded_map.h"

#include "conformal/circle_fit.h"
#include "conformal/stored_uv.h"
#include "foldover/convex_embedding.h"
#include "foldover/foldover_free.h"
#include "foldover/patch_shapes.h"
#include "geometry/planar_predicates.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace koebe {
namespace {

using Mobility = FoldoverProblem::Mobility;

constexpr double fan_weight = 1e-3;  // of the holes' triangles in the energy: there to keep them upright
constexpr double rounding = 3e-7;    // twice the area a face can lose by rounding, over its longest edge, disk units
constexpr double on_circle = 5e-7;   // disk units: half of what counts as on the circle
constexpr double pulls[] = {1.0, 30.0, 1e3, 1e5};
constexpr int free_rounds = 3, snap_rounds = 4;
constexpr double share_of_room = 0.9;

class Embedding {
public:
    Embedding(const Vertices& vertices, const Surface& surface, const std::vector<VertexLoop>& loops,
              const std::vector<Flap>& flaps, const VectorXcd& rim)
        : vertices_(vertices),
          surface_(surface),
          loops_(loops),
          filled_(fill_with_fans(surface, loops)),
          loop_of_(filled_.vertex_count, -1),
          mobility_(filled_.vertex_count, Mobility::free),
          pull_(VectorXd::Zero(filled_.vertex_count)),
          points_(convex_embedding(filled_, loops[0], rim))
    {
        for (std::size_t k = 0; k < loops.size(); ++k)
            for (const Index v : loops[k]) {
                loop_of_[v] = static_cast<int>(k);
                pull_[v] = k > 0 ? 1.0 : 0.0;
                if (k == 0) mobility_[v] = Mobility::sliding;
            }
        for (const Flap& flap : flaps)
            for (const Index v : flap.rim) pull_[v] = 0.0;
        faces_.resize(surface.triangles.rows());
        std::iota(faces_.begin(), faces_.end(), 0);
    }

    EmbeddedMap run(const std::vector<Circle>& wanted, const ExecutionContext& context)
    {
        circles_.assign(loops_.size(), Circle{});
        for (int round = 0; round < free_rounds; ++round) relax(0.0, 12, context);
        circles_ = wanted.empty() ? fitted_circles() : wanted;
        EmbeddedMap map;
        if (loops_.size() > 1) {
            for (const double pull : pulls) relax(pull, 20, context);
            for (std::size_t k = 0; k < loops_.size(); ++k) map.roundness.push_back(roundness_of(k));
            for (int round = 0; round < snap_rounds; ++round) {
                if (snap()) break;
                relax(pulls[2], 12, context);
            }
            relax(0.0, 12, context);
            snap();
        } else {
            map.roundness.push_back(0.0);
        }
        map.circles = circles_;
        map.uv = points_.topRows(surface_.vertex_count);
        for (std::size_t k = 1; k < loops_.size(); ++k)
            for (const Index v : loops_[k])
                if (std::abs(std::abs(at(v) - circles_[k].center) - circles_[k].radius) > on_circle)
                    map.off_circle.push_back(v);
        std::sort(map.off_circle.begin(), map.off_circle.end());
        return map;
    }

private:
    Complex at(Index v) const { return {points_(v, 0), points_(v, 1)}; }
    Index center_of(std::size_t k) const { return filled_.surface_vertices + static_cast<Index>(k) - 1; }

    double area(Eigen::Index f, const PlanarPoints& points) const
    {
        const auto corner = [&](int k) { return Complex(points(filled_.triangles(f, k), 0), points(filled_.triangles(f, k), 1)); };
        return 0.5 * cross(corner(1) - corner(0), corner(2) - corner(0));
    }

    /// Upright, and a face of the surface also as it is stored.
    bool right(Eigen::Index f) const
    {
        if (!(area(f, points_) > 0.0)) return false;
        if (f >= surface_.triangles.rows()) return true;
        const StoredFace face(filled_.triangles, points_, f);
        return !face.flipped() || face.below_resolution();
    }

    /// Some Newton steps from where the map is; faces that are wrong already do not take part.
    void relax(double pull, int iterations, const ExecutionContext& context)
    {
        FoldoverProblem problem;
        problem.points = points_;
        problem.mobility = mobility_;
        const PatchShapes shapes = patch_shapes(vertices_, surface_.triangles, points_, faces_, PatchShape::surface);
        std::vector<Index> taken;
        std::vector<double> floors, weights;
        for (Eigen::Index f = 0; f < filled_.triangles.rows(); ++f) {
            const double now = area(f, points_);
            const bool fan = f >= surface_.triangles.rows();
            Eigen::Matrix2d reference;
            for (int k = 0; k < 2; ++k)
                reference.col(k) = (points_.row(filled_.triangles(f, k + 1)) - points_.row(filled_.triangles(f, 0))).transpose();
            double longest = std::max({reference.col(0).norm(), reference.col(1).norm(),
                                       (reference.col(0) - reference.col(1)).norm()});
            if (!(now > 1e-15 * longest * longest) || !(now > 1e-200)) {
                for (int k = 0; k < 3; ++k) problem.mobility[filled_.triangles(f, k)] = Mobility::held;
                continue;
            }
            if (!fan) reference = shapes.references[f];
            const double wanted = fan ? now : shapes.areas[f];
            taken.push_back(static_cast<Index>(f));
            problem.reference.push_back(reference);
            floors.push_back(std::min(fan ? 0.0 : rounding * longest / (2.0 * wanted), 0.5 * now / wanted));
            weights.push_back(fan ? fan_weight : 1.0);
        }
        problem.triangles = filled_.triangles(taken, Eigen::all);
        problem.floor = Eigen::Map<const VectorXd>(floors.data(), static_cast<Eigen::Index>(floors.size()));
        problem.weight = Eigen::Map<const VectorXd>(weights.data(), static_cast<Eigen::Index>(weights.size()));
        problem.circles.resize(filled_.vertex_count);
        for (Index v = 0; v < filled_.surface_vertices; ++v)
            if (loop_of_[v] >= 0) problem.circles[v] = circles_[loop_of_[v]];
        if (pull > 0.0) problem.pull = pull * pull_;
        minimize_foldover_free(problem, context, {.max_iterations = iterations, .settled = 1e-3, .strict = true});
        if (problem.points.allFinite()) points_ = problem.points;
    }

    VectorXcd image_of(std::size_t k) const
    {
        VectorXcd image(static_cast<Eigen::Index>(loops_[k].size()));
        for (std::size_t i = 0; i < loops_[k].size(); ++i) image[static_cast<Eigen::Index>(i)] = at(loops_[k][i]);
        return image;
    }

    double roundness_of(std::size_t k) const
    {
        VectorXcd image = image_of(k);
        Eigen::Index count = 0;
        for (std::size_t i = 0; i < loops_[k].size(); ++i)
            if (k == 0 || pull_[loops_[k][i]] > 0.0) image[count++] = image[static_cast<Eigen::Index>(i)];
        return roundness(image.head(count), circles_[k]);
    }

    /// Least-squares circles, made smaller where they meet: the circle round the fan's centre that touches the loop is
    /// always free.
    std::vector<Circle> fitted_circles() const
    {
        std::vector<Circle> circles{Circle{}};
        std::vector<double> inscribed{1.0};
        for (std::size_t k = 1; k < loops_.size(); ++k) {
            const VectorXcd image = image_of(k);
            Circle circle = fit_circle_least_squares(image);
            const auto free_radius = [&](Complex center) {
                double least = 1.0;
                for (Eigen::Index i = 0; i < image.size(); ++i) {
                    const Complex a = image[i], b = image[(i + 1) % image.size()];
                    // The hole lies on the right of its loop.
                    least = std::min(least, cross(center - a, b - a) / std::max(std::abs(b - a), 1e-300));
                }
                return least;
            };
            double room = free_radius(circle.center);
            if (!(room > 0.0)) {
                circle.center = at(center_of(k));
                circle.radius = (image.array() - circle.center).abs().mean();
                room = free_radius(circle.center);
            }
            circles.push_back(circle);
            inscribed.push_back(room);
        }
        const std::vector<Circle> before = circles;
        for (std::size_t k = 1; k < circles.size(); ++k) {
            double room = 1.0 - std::abs(before[k].center);
            for (std::size_t j = 1; j < circles.size(); ++j)
                if (j != k)
                    room = std::min(room, std::abs(before[k].center - before[j].center) * before[k].radius /
                                              (before[k].radius + before[j].radius));
            if (before[k].radius > share_of_room * room)
                circles[k].radius = std::max(std::min(inscribed[k], share_of_room * room), 1e-12);
        }
        return circles;
    }

    /// Puts pulled vertices onto their circles, but for those whose faces would turn over.
    /// @return whether all are there
    bool snap()
    {
        std::vector<char> was_right(filled_.triangles.rows());
        for (Eigen::Index f = 0; f < filled_.triangles.rows(); ++f) was_right[f] = right(f);
        const PlanarPoints before = points_;
        std::vector<char> moved(filled_.vertex_count, 0);
        for (Index v = 0; v < filled_.surface_vertices; ++v) {
            if (!(pull_[v] > 0.0) || mobility_[v] == Mobility::sliding) continue;
            const Circle& circle = circles_[loop_of_[v]];
            const Complex arm = at(v) - circle.center;
            if (!(std::abs(arm) > 0.0)) continue;
            const Complex image = circle.center + circle.radius / std::abs(arm) * arm;
            points_.row(v) << image.real(), image.imag();
            moved[v] = 1;
        }
        for (bool again = true; again;) {
            again = false;
            for (Eigen::Index f = 0; f < filled_.triangles.rows(); ++f) {
                if (!was_right[f] || right(f)) continue;
                for (const Index v : filled_.triangles.row(f))
                    if (moved[v]) {
                        points_.row(v) = before.row(v);
                        moved[v] = 0;
                        again = true;
                    }
            }
        }
        bool all = true;
        for (Index v = 0; v < filled_.surface_vertices; ++v) {
            if (moved[v]) mobility_[v] = Mobility::sliding;
            all = all && (!(pull_[v] > 0.0) || mobility_[v] == Mobility::sliding);
        }
        return all;
    }

    const Vertices& vertices_;
    const Surface& surface_;
    const std::vector<VertexLoop>& loops_;
    FilledSurface filled_;
    std::vector<int> loop_of_;
    std::vector<Mobility> mobility_;
    VectorXd pull_;  // 1 for vertices that should be on the circles of inner loops
    PlanarPoints points_;
    std::vector<Circle> circles_;
    std::vector<Index> faces_;  // of the surface
};

}  // namespace

EmbeddedMap embedded_map(const Vertices& vertices, const Surface& surface, const std::vector<VertexLoop>& loops,
                         const std::vector<Flap>& flaps, const std::vector<Circle>& wanted, const VectorXcd& rim,
                         const ExecutionContext& context)
{
    return Embedding(vertices, surface, loops, flaps, rim).run(wanted, context);
}

}  // namespace koebe
