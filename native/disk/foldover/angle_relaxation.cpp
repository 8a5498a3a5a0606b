#include "foldover/angle_relaxation.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace koebe {
namespace {

constexpr double over_relaxation = 1.6;
constexpr int trials = 3;          // steps tried, each half as long as the one before
constexpr double regular = 1e-14;  // determinant of a Hessian over the product of its diagonal

class Relaxation {
public:
    Relaxation(AngleMap& map, double least) : map_(map), least_(least) {}

    double relax(Index v)
    {
        const Complex step = map_.mobility[v] == AngleMap::Mobility::free ? free_step(v) : sliding_step(v);
        if (!std::isfinite(step.real()) || !std::isfinite(step.imag()) || step == 0.0) return 0.0;
        double share = over_relaxation;
        for (int i = 0; i < trials; ++i, share *= 0.5) {
            const Complex place = map_.mobility[v] == AngleMap::Mobility::free ? map_.points[v] + share * step
                                                                               : slid(v, share * step.real());
            if (const double fall = before_ - error_at(v, place); fall > 0.0) {
                move_vertex(v, place);
                return fall;
            }
        }
        return 0.0;
    }

private:
    /// Sums the star's gradient, Hessian and errors.
    void sum_star(Index v)
    {
        before_ = gx_ = gy_ = hxx_ = hxy_ = hyy_ = 0.0;
        const Complex z = map_.points[v];
        for (const AngleMap::Corner& corner : map_.star(v)) {
            if (!map_.counts(corner)) continue;
            const Complex a = map_.points[corner.next] - z, b = map_.points[corner.previous] - z;
            const double an = 1.0 / std::norm(a), bn = 1.0 / std::norm(b);
            // d arg = Im(c dz) = x dx + y dy, c = 1/a - 1/b for this angle, -1/a for the next, 1/b for the previous.
            const double ax = -a.imag() * an, ay = a.real() * an, bx = -b.imag() * bn, by = b.real() * bn;
            add(map_.error[corner.own], ax - bx, ay - by);
            add(map_.error[corner.after], -ax, -ay);
            add(map_.error[corner.before], bx, by);
        }
    }

    void add(double error, double x, double y)
    {
        const double size = std::abs(error), weight = 1.0 / std::max(size, least_);
        const double wx = weight * x, wy = weight * y;
        before_ += size;
        gx_ += wx * error;
        gy_ += wy * error;
        hxx_ += wx * x;
        hxy_ += wx * y;
        hyy_ += wy * y;
    }

    Complex free_step(Index v)
    {
        sum_star(v);
        const double determinant = hxx_ * hyy_ - hxy_ * hxy_;
        if (!(determinant > regular * hxx_ * hyy_)) return 0.0;
        return Complex(hxy_ * gy_ - hyy_ * gx_, hxy_ * gx_ - hxx_ * gy_) / determinant;
    }

    /// The step along the circle, counter-clockwise.
    Complex sliding_step(Index v)
    {
        sum_star(v);
        const Complex arm = map_.points[v] - map_.slide(v).circle.center;
        const Complex t = Complex(-arm.imag(), arm.real()) / std::abs(arm);
        return -(t.real() * gx_ + t.imag() * gy_) /
               (t.real() * t.real() * hxx_ + 2.0 * t.real() * t.imag() * hxy_ + t.imag() * t.imag() * hyy_);
    }

    /// The place after a slide of at most half the way to the next vertex of the loop.
    Complex slid(Index v, double length) const
    {
        const AngleMap::Slide& slide = map_.slide(v);
        const Complex center = slide.circle.center, arm = map_.points[v] - center;
        const Index ahead = (length > 0.0) == (slide.sense > 0.0) ? slide.next : slide.previous;
        const double gap = std::arg((map_.points[ahead] - center) / arm) * (length > 0.0 ? 1.0 : -1.0);
        const double turn = std::min(std::abs(length), 0.5 * std::max(gap, 0.0) * slide.circle.radius);
        return map_.slid(v, std::copysign(turn, length));
    }

    /// The sum of errors with the vertex at a place; infinite where a face gets too small.
    double error_at(Index v, Complex place)
    {
        trial_.clear();
        double sum = 0.0;
        for (const AngleMap::Corner& corner : map_.star(v)) {
            const Complex a = map_.points[corner.next] - place, b = map_.points[corner.previous] - place;
            const double area = cross(a, b);
            if (!(area > 0.0) || area < map_.least_area(corner)) return std::numeric_limits<double>::infinity();
            if (!map_.counts(corner)) {
                trial_.push_back({});
                continue;
            }
            trial_.push_back(map_.face_errors(corner, a, b));
            sum += trial_.back().sum();
        }
        return sum;
    }

    void move_vertex(Index v, Complex place)
    {
        map_.points[v] = place;
        std::size_t i = 0;
        for (const AngleMap::Corner& corner : map_.star(v)) {
            map_.error[corner.own] = trial_[i].own;
            map_.error[corner.after] = trial_[i].after;
            map_.error[corner.before] = trial_[i++].before;
        }
    }

    AngleMap& map_;
    const double least_;
    double before_ = 0.0, gx_ = 0.0, gy_ = 0.0, hxx_ = 0.0, hxy_ = 0.0, hyy_ = 0.0;
    std::vector<AngleMap::FaceErrors> trial_;
};

}  // namespace

double relax_angles(AngleMap& map, double least, bool forward)
{
    Relaxation relaxation(map, least);
    double fall = 0.0;
    const Index count = map.vertex_count();
    for (Index i = 0; i < count; ++i) {
        const Index v = forward ? i : count - 1 - i;
        if (map.mobility[v] != AngleMap::Mobility::held) fall += relaxation.relax(v);
    }
    return fall;
}

}  // namespace koebe
