#include "foldover/angle_polish.h"

#include "core/numbering.h"
#include "core/uv_resolution.h"
#include "foldover/angle_map.h"
#include "foldover/angle_newton.h"
#include "foldover/angle_relaxation.h"
#include "foldover/tangled_map.h"
#include "planar/boundary_crossings.h"

#include <algorithm>

namespace koebe {
namespace {

constexpr int most_passes = 6;             // Newton steps
constexpr double large = 0.1;              // relative fall of the angle error that is worth another Newton step
constexpr double least_step_share = 0.25;  // least share of a Newton step
constexpr int first_sweeps = 2;            // before the Newton step; its weights come from the errors then
constexpr int most_sweeps = 8;             // after the Newton step
constexpr double worthwhile = 1e-3;        // relative fall of the angle error that is worth another sweep
constexpr double least_error = 0.3;        // least error in a weight, over the mean error
constexpr double noticeable = 1e-6;        // relative fall for a result to be kept: above the error of angle_of
constexpr int most_restorations = 16;      // rounds that put vertices around bad faces back

class AnglePolish {
public:
    AnglePolish(const Vertices& vertices, const Surface& surface, const std::vector<VertexLoop>& loops,
                const std::vector<Circle>& circles, const std::vector<Index>& off_circle, PlanarPoints& uv,
                const std::vector<Index>& held)
        : uv_(uv),
          triangles_(surface.triangles),
          tangled_(vertices, surface, loops, circles, off_circle, uv),
          map_(vertices, surface.triangles, uv)
    {
        for (const Index v : held) tangled_.hold(v);
        for (std::size_t k = 0; k < loops.size(); ++k) let_slide(loops[k], circles[k], k == 0 ? 1.0 : -1.0);
        pin(loops, held);
        for (Index v = 0; v < map_.vertex_count(); ++v)
            if (!tangled_.mobile(v, PatchBoundary::sliding)) map_.mobility[v] = AngleMap::Mobility::held;
        for (Index v = 0; v < map_.vertex_count(); ++v)
            for (const AngleMap::Corner& corner : map_.star(v))
                if (!(area(corner, v, map_.points) > 0.0)) map_.mobility[v] = AngleMap::Mobility::held;
    }

    bool run(ExecutionContext& context)
    {
        const double before = map_.measure();
        double error = sweeps(before, first_sweeps, context, 0.0);
        error = newton(error, context);
        sweeps(error, most_sweeps, context, 0.5);
        return write() && map_.measure() < (1.0 - noticeable) * before;
    }

private:
    double least(double error) const { return least_error * error / std::max<Index>(map_.corner_count(), 1); }

    static double area(const AngleMap::Corner& corner, Index v, const std::vector<Complex>& places)
    {
        return cross(places[corner.next] - places[v], places[corner.previous] - places[v]);
    }

    /// Lets the vertices on a loop's circle slide, if they run once round it.
    void let_slide(const VertexLoop& loop, const Circle& circle, double sense)
    {
        std::vector<Index> on;
        for (const Index v : loop) {
            map_.mobility[v] = AngleMap::Mobility::held;
            if (tangled_.place(v) == TangledMap::Place::on_circle) on.push_back(v);
        }
        const std::size_t n = on.size();
        for (std::size_t i = 0; i < n; ++i) {
            const AngleMap::Slide slide{circle, on[(i + 1) % n], on[(i + n - 1) % n], sense};
            if (in_order(on[i], slide, map_.points)) map_.let_slide(on[i], slide);
        }
    }

    static bool in_order(Index v, const AngleMap::Slide& slide, const std::vector<Complex>& places)
    {
        const auto arm = [&](Index w) { return places[w] - slide.circle.center; };
        return slide.sense * cross(arm(v), arm(slide.next)) > 0.0 &&
               slide.sense * cross(arm(slide.previous), arm(v)) > 0.0;
    }

    /// Holds one outer vertex; or three if there is no other loop and no inner vertex is held, to fix the position.
    void pin(const std::vector<VertexLoop>& loops, const std::vector<Index>& held)
    {
        const VertexLoop& outer = loops[0];
        std::size_t first = 0, pins = loops.size() == 1 ? 3 : 1;
        for (const Index v : held)
            if (tangled_.loop_of(v) == 0)
                first = static_cast<std::size_t>(std::ranges::find(outer, v) - outer.begin());
            else
                pins = 1;
        for (std::size_t i = 0; i < pins; ++i)
            map_.mobility[outer[(first + i * outer.size() / 3) % outer.size()]] = AngleMap::Mobility::held;
    }

    /// Sweeps up to `most` times, as long as it is worthwhile. @return the error
    double sweeps(double error, int most, ExecutionContext& context, double begin)
    {
        for (int sweep = 0; sweep < most; ++sweep) {
            context.advance(begin + 0.5 * sweep / most_sweeps);
            const double fall = relax_angles(map_, least(error), sweep % 2 == 0);
            error -= fall;
            if (!(fall > worthwhile * error)) break;
        }
        return error;
    }

    /// Takes Newton steps as long as the error falls by much. @return the error
    double newton(double error, ExecutionContext& context)
    {
        AngleNewton newton(map_);
        for (int pass = 0; pass < most_passes; ++pass) {
            context.advance(0.15 + 0.35 * pass / most_passes);
            if (!newton.solve(least(error))) break;
            const double before = error;
            for (double share = 1.0; share >= least_step_share && error == before; share *= 0.5)
                error = with_step(newton.places(share), error);
            if (!(error < (1.0 - large) * before)) break;
        }
        return error;
    }

    /// Moves the vertices to these places if that lowers the error. @return the error
    double with_step(std::vector<Complex> places, double error)
    {
        if (!restore(places)) return error;
        std::swap(map_.points, places);
        if (const double now = map_.measure(); now < error) return now;
        std::swap(map_.points, places);
        map_.measure();
        return error;
    }

    /// Puts vertices back that are on faces that got too small, or out of order on a loop.
    /// @return whether no such vertex is left
    bool restore(std::vector<Complex>& places) const
    {
        std::vector<Index> moved = numbers_below(map_.vertex_count()), wrong;
        for (int i = 0; i < most_restorations; ++i) {
            wrong.clear();
            for (const Index v : moved) collect_wrong(v, places, wrong);
            if (wrong.empty()) return true;
            moved.clear();  // vertices whose faces change in this round
            for (const Index v : wrong) {
                if (places[v] == map_.points[v]) continue;
                places[v] = map_.points[v];
                moved.push_back(v);
            }
        }
        return false;
    }

    void collect_wrong(Index v, const std::vector<Complex>& places, std::vector<Index>& wrong) const
    {
        if (map_.mobility[v] == AngleMap::Mobility::sliding && !in_order(v, map_.slide(v), places))
            wrong.insert(wrong.end(), {v, map_.slide(v).next, map_.slide(v).previous});
        for (const AngleMap::Corner& corner : map_.star(v)) {
            const double now = area(corner, v, places);
            if (!(now > 0.0) || now < map_.least_area(corner))
                wrong.insert(wrong.end(), {v, corner.next, corner.previous});
        }
    }

    /// Writes the map. Vertices of newly flipped faces (as stored), and of loops that cross, keep their old places.
    /// @return whether the written map is right
    bool write()
    {
        const PlanarPoints before = uv_;
        const std::vector<Index> allowed = tangled_.tangled();
        for (Index v = 0; v < map_.vertex_count(); ++v)
            if (map_.mobility[v] != AngleMap::Mobility::held)
                uv_.row(v) << map_.points[v].real(), map_.points[v].imag();
        // Rounding to the grid can flip a face, and a face put back can flip its neighbour: hence some rounds.
        for (int i = 0; i < most_restorations; ++i) {
            std::vector<Index> wrong;
            for (const Index f : tangled_.tangled())
                if (!std::ranges::binary_search(allowed, f))
                    wrong.insert(wrong.end(), triangles_.row(f).begin(), triangles_.row(f).end());
            // Loops that cross go back as a whole.
            if (wrong.empty())
                for (const auto& [a, b] : crossing_boundary_edges(tangled_.loops(), uv_, 2.0 * uv_resolution))
                    for (const Index v : {a, b}) {
                        const VertexLoop& loop = tangled_.loops()[tangled_.loop_of(v)];
                        wrong.insert(wrong.end(), loop.begin(), loop.end());
                    }
            if (std::ranges::all_of(wrong, [&](Index v) { return uv_.row(v) == before.row(v); })) return true;
            for (const Index v : wrong) {
                uv_.row(v) = before.row(v);
                map_.points[v] = {before(v, 0), before(v, 1)};
            }
        }
        return false;
    }

    PlanarPoints& uv_;
    const Triangles& triangles_;
    TangledMap tangled_;
    AngleMap map_;
};

}  // namespace

bool polish_angles(const Vertices& vertices, const Surface& surface, const std::vector<VertexLoop>& loops,
                   const std::vector<Circle>& circles, const std::vector<Index>& off_circle, PlanarPoints& uv,
                   ExecutionContext& context, const std::vector<Index>& held)
{
    PlanarPoints before = uv;
    const bool better = AnglePolish(vertices, surface, loops, circles, off_circle, uv, held).run(context);
    if (!better) uv = std::move(before);
    return better;
}

}  // namespace koebe
