#include "planar_domain/planar_rim.h"

#include "core/errors.h"
#include "planar/boundary_crossings.h"
#include "planar/planar_predicates.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <set>
#include <string>

namespace koebe {
namespace {

constexpr double full_turn = 2.0 * std::numbers::pi;
constexpr std::size_t chords_of_cubic = 32, chords_of_sum = 512;
constexpr double least_area = 1e-12;          // of a rim, times its squared size
constexpr double bend_between_samples = 2.0;  // of a Fourier sum, of that at the samples

PlanarRim reversed(PlanarRim rim)
{
    std::ranges::reverse(rim.curve);
    if (rim.fourier.empty()) return rim;
    std::ranges::reverse(rim.fourier);
    rim.lowest = -(rim.lowest + static_cast<int>(rim.fourier.size()) - 1);
    return rim;
}

double edge_distance(Complex place, Complex a, Complex b)
{
    const double length = std::norm(b - a);
    const double t = length > 0.0 ? std::clamp(dot(place - a, b - a) / length, 0.0, 1.0) : 0.0;
    return std::abs(place - a - t * (b - a));
}

void require_whole(const PlanarRim& rim, Index number)
{
    const auto refuse = [&](const std::string& why) {
        throw InputError("rim " + std::to_string(number) + " " + why, ElementKind::loops, {number});
    };
    if (rim.curve.empty() == rim.fourier.empty()) refuse("has no curve");
    if (!rim.curve.empty() &&
        (rim.curve.size() < 7 || rim.curve.size() % 3 != 1 || rim.curve.front() != rim.curve.back()))
        refuse("is not closed, or has fewer than two pieces");
    for (const std::vector<Complex>* list : {&rim.curve, &rim.fourier})
        for (const Complex z : *list)
            if (!std::isfinite(z.real()) || !std::isfinite(z.imag())) refuse("has a number that is not finite");
}

/// @throws InputError rims that meet themselves or each other
void require_apart(const std::vector<RimPolygon>& polygons)
{
    std::vector<VertexLoop> loops;
    std::vector<Complex> all;
    std::vector<Index> rim_of;
    for (const RimPolygon& polygon : polygons) {
        VertexLoop& loop = loops.emplace_back();
        for (const Complex z : polygon.points) {
            loop.push_back(static_cast<Index>(all.size()));
            rim_of.push_back(static_cast<Index>(loops.size()) - 1);
            all.push_back(z);
        }
    }
    PlanarPoints points(static_cast<Eigen::Index>(all.size()), 2);
    for (std::size_t i = 0; i < all.size(); ++i)
        points.row(static_cast<Eigen::Index>(i)) << all[i].real(), all[i].imag();
    std::set<Index> meeting;
    for (const auto& [a, b] : crossing_boundary_edges(loops, points, 0.0)) {
        meeting.insert(rim_of[a]);
        meeting.insert(rim_of[b]);
    }
    // Neighbouring edges that fold back on each other share a vertex, which is no crossing.
    for (std::size_t k = 0; k < polygons.size(); ++k) {
        const std::vector<Complex>& p = polygons[k].points;
        for (std::size_t i = 0; i < p.size(); ++i) {
            const Complex a = p[i] - p[(i + 1) % p.size()], b = p[(i + 2) % p.size()] - p[(i + 1) % p.size()];
            if (std::abs(cross(a, b)) <= 1e-9 * std::abs(a) * std::abs(b) && dot(a, b) >= 0.0)
                meeting.insert(static_cast<Index>(k));
        }
    }
    if (!meeting.empty())
        throw InputError("rims meet themselves or each other (rims listed)", ElementKind::loops,
                         {meeting.begin(), meeting.end()});
}

}  // namespace

PlanarRim polygon_rim(const std::vector<Complex>& points)
{
    PlanarRim rim;
    for (std::size_t i = 0; i < points.size(); ++i) {
        const Complex a = points[i], b = points[(i + 1) % points.size()];
        rim.curve.insert(rim.curve.end(), {a, a + (b - a) / 3.0, b + (a - b) / 3.0});
    }
    if (!points.empty()) rim.curve.push_back(points.front());
    return rim;
}

PlanarRim ellipse_rim(Complex center, double first_half_axis, double second_half_axis, double turn)
{
    const Complex direction = std::polar(1.0, turn);
    return {.fourier = {0.5 * (first_half_axis - second_half_axis) * direction, center,
                        0.5 * (first_half_axis + second_half_axis) * direction},
            .lowest = -1};
}

RimPiece::RimPiece(const PlanarRim& rim, std::size_t piece)
    : is_cubic_(rim.fourier.empty()), fourier_(rim.fourier), lowest_(rim.lowest)
{
    if (!is_cubic_) return;
    const Complex* p = rim.curve.data() + 3 * piece;
    begin_ = p[0];
    arms_ = {p[1] - p[0], p[2] - p[0], p[3] - p[0]};
    back_ = {p[2] - p[3], p[1] - p[3], p[0] - p[3]};
}

Complex RimPiece::offset(const Arms& arms, Complex s)
{
    const Complex r = 1.0 - s;
    return s * (3.0 * r * r * arms[0] + s * (3.0 * r * arms[1] + s * arms[2]));
}

Complex RimPiece::direction(const Arms& arms)
{
    const double size = std::abs(arms[0]) + std::abs(arms[1]) + std::abs(arms[2]);
    for (const Complex arm : arms)
        if (std::abs(arm) > 1e-12 * size) return arm / std::abs(arm);
    return 1.0;
}

Complex RimPiece::sum(Complex s, int derivative) const
{
    Complex all = 0.0;
    for (std::size_t k = 0; k < fourier_.size(); ++k) {
        const Complex rate(0.0, full_turn * (lowest_ + static_cast<int>(k)));
        all += fourier_[k] * std::exp(rate * s) * std::pow(rate, derivative);
    }
    return all;
}

Complex RimPiece::derivative(Complex s) const
{
    if (!is_cubic_) return sum(s, 1);
    const Complex r = 1.0 - s;
    return 3.0 * (r * r * arms_[0] + 2.0 * s * r * (arms_[1] - arms_[0]) + s * s * (arms_[2] - arms_[1]));
}

Complex RimPiece::second_derivative(Complex s) const
{
    if (!is_cubic_) return sum(s, 2);
    return 6.0 * ((1.0 - s) * (arms_[1] - 2.0 * arms_[0]) + s * (arms_[2] - 2.0 * arms_[1] + arms_[0]));
}

bool RimPiece::is_straight() const
{
    if (!is_cubic_) return false;
    const double rest = std::abs(arms_[0] - arms_[2] / 3.0) + std::abs(arms_[1] - 2.0 * arms_[2] / 3.0);
    return rest <= 1e-14 * (std::abs(begin_) + std::abs(arms_[2]));
}

double RimPolygon::area() const
{
    double twice = 0.0;
    for (std::size_t i = 0; i < points.size(); ++i)
        twice += cross(points[i] - points[0], points[(i + 1) % points.size()] - points[0]);
    return 0.5 * twice;
}

int RimPolygon::winding(Complex place) const
{
    int times = 0;
    for (std::size_t i = 0; i < points.size(); ++i) {
        const Complex a = points[i] - place, b = points[(i + 1) % points.size()] - place;
        if (a.imag() <= 0.0 && b.imag() > 0.0 && cross(a, b) > 0.0) ++times;
        if (a.imag() > 0.0 && b.imag() <= 0.0 && cross(a, b) < 0.0) --times;
    }
    return times;
}

double RimPolygon::distance(Complex place) const
{
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < points.size(); ++i)
        least = std::min(least, edge_distance(place, points[i], points[(i + 1) % points.size()]));
    return least;
}

double RimPolygon::hit(Complex place, Complex direction, std::size_t first, std::size_t last) const
{
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < points.size(); ++i) {
        if (first <= last ? (i >= first && i <= last) : (i >= first || i <= last)) continue;
        const Complex to = points[i] - place, edge = points[(i + 1) % points.size()] - points[i];
        const double sine = cross(direction, edge);
        if (std::abs(sine) <= 1e-14 * std::abs(edge)) continue;
        const double t = cross(to, edge) / sine, u = cross(to, direction) / sine;
        if (t > 0.0 && u >= -1e-9 && u <= 1.0 + 1e-9) least = std::min(least, t);
    }
    return least;
}

Complex RimPolygon::deepest() const
{
    Complex low = points[0], high = points[0];
    for (const Complex z : points) {
        low = {std::min(low.real(), z.real()), std::min(low.imag(), z.imag())};
        high = {std::max(high.real(), z.real()), std::max(high.imag(), z.imag())};
    }
    constexpr int cells = 32, rounds = 4;
    Complex best = points[0];
    double depth = 0.0;
    Complex corner = low, size = high - low;
    for (int round = 0; round < rounds; ++round) {
        for (int i = 0; i < cells; ++i)
            for (int j = 0; j < cells; ++j) {
                const Complex z = corner + Complex((i + 0.5) / cells * size.real(), (j + 0.5) / cells * size.imag());
                if (winding(z) == 0) continue;
                if (const double d = distance(z); d > depth) depth = d, best = z;
            }
        size *= depth > 0.0 ? 4.0 / cells : 1.0;
        corner = depth > 0.0 ? best - 0.5 * size : low + Complex(1e-3, 1e-3) * static_cast<double>(round + 1);
    }
    return best;
}

RimPolygon rim_polygon(const PlanarRim& rim)
{
    RimPolygon polygon;
    for (std::size_t k = 0; k < rim.pieces(); ++k) {
        const RimPiece piece(rim, k);
        const std::size_t chords = !piece.is_cubic() ? chords_of_sum : piece.is_straight() ? 1 : chords_of_cubic;
        for (std::size_t i = 0; i < chords; ++i) {
            const double s = static_cast<double>(i) / static_cast<double>(chords);
            polygon.points.push_back(piece.at(s));
            polygon.piece.push_back(k);
        }
        if (chords == 1) continue;
        // The second derivative of a cubic is largest at an end. That of a sum may be larger between the samples.
        const double room = piece.is_cubic() ? 1.0 : bend_between_samples;
        for (std::size_t i = 0; i <= chords; ++i) {
            const double bend = std::abs(piece.second_derivative(static_cast<double>(i) / static_cast<double>(chords)));
            polygon.chord_error = std::max(polygon.chord_error, room * bend / (8.0 * std::pow(chords, 2)));
        }
    }
    return polygon;
}

OrderedRims ordered_rims(const std::vector<PlanarRim>& rims)
{
    if (rims.empty()) throw InputError("a planar domain has one rim at least");
    OrderedRims all;
    for (std::size_t k = 0; k < rims.size(); ++k) {
        require_whole(rims[k], static_cast<Index>(k));
        PlanarRim rim = rims[k];
        RimPolygon polygon = rim_polygon(rim);
        double size = 0.0;
        for (const Complex z : polygon.points) size = std::max(size, std::abs(z - polygon.points[0]));
        if (!(std::abs(polygon.area()) > least_area * size * size))
            throw InputError("rim " + std::to_string(k) + " encloses no area", ElementKind::loops,
                             {static_cast<Index>(k)});
        if (polygon.area() < 0.0) polygon = rim_polygon(rim = reversed(std::move(rim)));
        all.rims.push_back(std::move(rim));
        all.polygons.push_back(std::move(polygon));
        all.order.push_back(static_cast<int>(k));
    }
    require_apart(all.polygons);

    for (RimPolygon& polygon : all.polygons) polygon.center = polygon.deepest();

    // The outer rim encloses the largest area; every other one lies inside it and outside the rest.
    std::size_t outer = 0;
    for (std::size_t k = 1; k < rims.size(); ++k)
        if (all.polygons[k].area() > all.polygons[outer].area()) outer = k;
    for (std::size_t k = outer; k > 0; --k) {
        std::swap(all.rims[k], all.rims[k - 1]);
        std::swap(all.polygons[k], all.polygons[k - 1]);
        std::swap(all.order[k], all.order[k - 1]);
    }
    std::set<Index> misplaced;
    for (std::size_t k = 1; k < rims.size(); ++k)
        for (std::size_t j = 0; j < rims.size(); ++j)
            if (j != k && (all.polygons[j].winding(all.polygons[k].points[0]) != 0) != (j == 0))
                misplaced.insert(all.order[k]);
    if (!misplaced.empty())
        throw InputError("rims lie outside the outer one, or inside another hole (rims listed)", ElementKind::loops,
                         {misplaced.begin(), misplaced.end()});
    return all;
}

}  // namespace koebe
