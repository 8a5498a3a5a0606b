#include "embedding/embedded_map.h"

#include "circles/boundary_angles.h"
#include "circles/circle.h"
#include "circles/circle_fit.h"
#include "circles/crowded_circles.h"
#include "embedding/filled_map.h"
#include "planar/planar_predicates.h"
#include "planar/star_centre.h"
#include "surface/loop_edges.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace koebe {
namespace {

enum class HoleCircle {
    through,  ///< the loop, by least squares; smaller where it would meet another circle
    inside    ///< the hole, round its middle
};

constexpr double share_of_room = 0.9;

/// The largest radius of a circle round a point that stays in the hole; negative outside.
double free_radius(const VectorXcd& image, Complex centre)
{
    double least = 1.0;
    for (Eigen::Index i = 0; i < image.size(); ++i) {
        const Complex a = image[i], b = image[(i + 1) % image.size()];
        const double length = std::abs(b - a);
        if (length > 0.0) least = std::min(least, cross(centre - a, b - a) / length);
    }
    return least;
}

/// Chooses a circle for each of some loops, apart from the other circles and inside the unit circle. If no other choice
/// is left, the circle touches the loop from inside, and so meets no other circle.
/// @param images of the loops, the unit circle's first; the holes lie on their right
/// @param fan_centres (loops) points from which all of each hole is visible; the first is not read
/// @param refit (loops) 1 to choose a new circle; other circles stay @param circles (loops), changed in place
/// @return whether all circles are apart now
bool fit_hole_circles(const std::vector<VectorXcd>& images, const std::vector<Complex>& fan_centres,
                      const std::vector<char>& refit, HoleCircle kind, std::vector<Circle>& circles)
{
    // Through the loop by least squares. If the centre of that circle is not inside, round the middle of the hole.
    std::vector<double> inside(circles.size(), 0.0);
    for (std::size_t k = 1; k < circles.size(); ++k) {
        if (!refit[k]) continue;
        circles[k] = fit_circle_least_squares(images[k]);
        inside[k] = free_radius(images[k], circles[k].center);
        if (kind == HoleCircle::through && inside[k] > 0.0) continue;
        std::vector<Complex> hole(images[k].begin(), images[k].end());
        std::ranges::reverse(hole);
        const Complex middle =
            star_centre(hole, std::vector<double>(hole.size(), 1.0), fan_centres[k]).value_or(fan_centres[k]);
        inside[k] = free_radius(images[k], middle);
        circles[k] = {middle, kind == HoleCircle::inside ? share_of_room * inside[k]
                                                         : (images[k].array() - middle).abs().mean()};
    }
    // Two circles that would meet share the distance of their centres in proportion to their radii.
    const std::vector<Circle> before = circles;
    for (std::size_t k = 1; k < circles.size(); ++k) {
        if (!refit[k]) continue;
        double room = 1.0 - std::abs(before[k].center);
        for (std::size_t j = 1; j < circles.size(); ++j) {
            if (j == k) continue;
            const double distance = std::abs(before[k].center - before[j].center);
            room = std::min(room, refit[j] ? distance * before[k].radius / (before[k].radius + before[j].radius)
                                           : distance - before[j].radius);
        }
        if (before[k].radius > share_of_room * room)
            circles[k].radius = std::max(std::min(inside[k], share_of_room * room), 1e-12);
    }
    return circles_apart(circles);
}

constexpr int free_rounds = 3, path_steps = 4, snap_rounds = 4, refits = 2;
constexpr double open_holes = 0.3;  // weight of the holes' fans against faces, without circles to keep holes open
// Newton steps may be taken for so many faces, then vertices off their circles stay off: so many steps of the whole
// surface, plus a number for small surfaces.
constexpr std::size_t steps_of_all = 60, most_for_small = 200000;

class Embedding {
public:
    Embedding(const Vertices& vertices, const Surface& surface, const std::vector<VertexLoop>& loops,
              const std::vector<Ear>& ears, const VectorXcd& rim, FixedPlaces places, const ExecutionContext& context)
        : loops_(loops),
          map_(vertices, surface, loops, ears, rim, places, context),
          off_(loops.size(), 0),
          roundness_(loops.size()),
          most_work_(steps_of_all * static_cast<std::size_t>(surface.triangles.rows()) + most_for_small)
    {
    }

    Embedding(const Vertices& vertices, const Surface& surface, const std::vector<VertexLoop>& loops,
              const std::vector<Ear>& ears, const CircleMap& map, FixedPlaces places, const ExecutionContext& context)
        : loops_(loops),
          map_(vertices, surface, loops, ears, map, places, context),
          off_(loops.size(), 0),
          roundness_(loops.size())
    {
    }

    /// Pulls replaced vertices back to their circles. @param map the start
    std::optional<CircleMap> mend(CircleMap map, const ExecutionContext& context)
    {
        if (!map_.started()) return {};
        draw(context);
        map_.relax({}, 12, context);
        map_.snap();
        take_places(map);
        return map;
    }

    CircleMap run(const std::vector<Circle>& wanted, const ExecutionContext& context)
    {
        // A ring has many conformal maps to a ring: the rim tells which one is meant.
        map_.let_rim_slide(false);
        for (int round = 0; round < free_rounds; ++round) map_.relax({.regular = open_holes}, 12, context);
        CircleMap result;
        result.roundness = roundness_;
        if (loops_.size() == 1) {
            map_.let_rim_slide(true);
            map_.relax({}, 12, context);
        } else {
            const FilledMap::State free = map_.state();
            Attempt best;
            if (!wanted.empty()) {
                refit(std::vector<char>(loops_.size(), 1), HoleCircle::through);
                lead_to(wanted, context);
                draw_and_mend(best, context);
            }
            for (const HoleCircle kind : {HoleCircle::through, HoleCircle::inside}) {
                if (best.off == 0 || (best.off > 0 && map_.work() >= most_work_)) break;
                map_.return_to(free);
                if (!refit(std::vector<char>(loops_.size(), 1), kind) && best.off >= 0) continue;
                draw_and_mend(best, context);
            }
            map_.return_to(std::move(best.state));
            result.roundness = std::move(best.roundness);
            map_.relax({}, 12, context);
            map_.snap();
        }
        take_places(result);
        return result;
    }

private:
    void take_places(CircleMap& result)
    {
        result.circles = map_.circles();
        result.uv = map_.surface_points();
        result.off_circle.clear();
        for (std::size_t k = 1; k < loops_.size(); ++k) {
            const std::vector<Index> off = map_.off_circle(k, false);
            result.off_circle.insert(result.off_circle.end(), off.begin(), off.end());
        }
        std::sort(result.off_circle.begin(), result.off_circle.end());
    }

    struct Attempt {
        int off = -1;  // vertices that should be on their circles but are not
        FilledMap::State state;
        std::vector<Roundness> roundness;
    };

    /// Draws the loops to their circles, and gives loops that stay off other circles nearby.
    void draw_and_mend(Attempt& best, const ExecutionContext& context)
    {
        draw(context);
        keep_if_better(best);
        for (int round = 0; round < refits && best.off > 0 && note_off() > 0 && map_.work() < most_work_; ++round) {
            for (std::size_t k = 1; k < loops_.size(); ++k)
                if (off_[k]) map_.release(k);
            map_.relax({.regular = open_holes}, 12, context);
            if (!refit(off_, HoleCircle::inside)) break;
            draw(context);
            keep_if_better(best);
        }
    }

    /// Notes the map if fewer vertices are off their circles.
    void keep_if_better(Attempt& best)
    {
        const int off = note_off();
        if (best.off < 0 || off < best.off) best = {off, map_.state(), roundness_};
    }

    /// Fits circles to the loops' present images. @return whether they are apart
    bool refit(const std::vector<char>& which, HoleCircle kind)
    {
        std::vector<VectorXcd> images;
        std::vector<Complex> centres;
        for (std::size_t k = 0; k < loops_.size(); ++k) {
            images.push_back(map_.image_of(k));
            centres.push_back(k > 0 ? map_.at(map_.fan_centre(k)) : Complex());
            if (k > 0 && which[k]) map_.release(k);
        }
        return fit_hole_circles(images, centres, which, kind, map_.circles());
    }

    /// Makes loops and fans follow circles that move from the fitted to the wanted ones.
    void lead_to(const std::vector<Circle>& wanted, const ExecutionContext& context)
    {
        const std::vector<Circle> from = map_.circles();
        for (int step = 0; step <= path_steps; ++step) {
            const double t = static_cast<double>(step) / path_steps;
            for (std::size_t k = 1; k < loops_.size(); ++k)
                map_.circles()[k] = {(1.0 - t) * from[k].center + t * wanted[k].center,
                                     std::pow(from[k].radius, 1.0 - t) * std::pow(wanted[k].radius, t)};
            map_.relax({30.0, 30.0, 0.1}, 10, context);
        }
        map_.circles() = wanted;
    }

    /// Pulls the loops to their circles, harder and harder, and puts them there.
    void draw(const ExecutionContext& context)
    {
        map_.let_rim_slide(true);
        for (const double pull : {1.0, 30.0, 1e3, 1e5}) map_.relax({pull, std::max(pull, 30.0)}, 25, context);
        for (std::size_t k = 1; k < loops_.size(); ++k) roundness_[k] = map_.roundness_of(k);
        for (int round = 0; round < snap_rounds && map_.snap() > 0; ++round) map_.relax({1e5, 1e3}, 12, context);
    }

    /// Notes the loops with vertices that should be on their circles but are not.
    int note_off()
    {
        int count = 0;
        for (std::size_t k = 1; k < loops_.size(); ++k) {
            const std::size_t off = map_.off_circle(k, true).size();
            off_[k] = off > 0;
            count += static_cast<int>(off);
        }
        return count;
    }

    const std::vector<VertexLoop>& loops_;
    FilledMap map_;
    std::vector<char> off_;  // per loop
    std::vector<Roundness> roundness_;
    std::size_t most_work_ = 0;
};

}  // namespace

CircleMap embedded_map(const Vertices& vertices, const Surface& surface, const std::vector<VertexLoop>& loops,
                       const std::vector<Ear>& ears, const std::vector<Circle>& wanted, const VectorXcd& rim,
                       const ExecutionContext& context, FixedPlaces places)
{
    return Embedding(vertices, surface, loops, ears, rim, places, context).run(wanted, context);
}

std::optional<CircleMap> mended_map(const Vertices& vertices, const Surface& surface,
                                    const std::vector<VertexLoop>& loops, const std::vector<Ear>& ears,
                                    const CircleMap& map, const ExecutionContext& context, FixedPlaces places)
{
    return Embedding(vertices, surface, loops, ears, map, places, context).mend(map, context);
}

PlanarPoints freely_embedded(const Vertices& vertices, const Surface& surface, const std::vector<VertexLoop>& loops,
                             const ExecutionContext& context)
{
    const VectorXcd rim = unit_circle_points(arc_length_angles(loop_edges(vertices, loops[0])));
    FilledMap map(vertices, surface, loops, {}, rim, {}, context);
    for (int round = 0; round < free_rounds; ++round) {
        map.let_rim_slide(round > 0);
        map.relax({.regular = open_holes}, 12, context);
    }
    return map.surface_points();
}

}  // namespace koebe
