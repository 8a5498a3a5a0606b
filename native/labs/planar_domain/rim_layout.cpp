#include "planar_domain/rim_layout.h"

#include "core/errors.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

namespace koebe {
namespace {

constexpr double pi = std::numbers::pi;
constexpr int samples_for_pole = 3;       // least squares: rows for each unknown
constexpr double farthest_pole = 2.0;     // w: the pole at the corner's end of the cluster has the smallest one
constexpr double sample_reach = 1e-2;     // the nearest sample's distance from the corner, of the nearest pole's
constexpr double pole_offset = 1.0 / 3;   // of a panel's length
constexpr double share_of_gap = 0.45;     // of the way across the hole, for a pole at most
constexpr double shortest_panel = 1e-6;   // of a piece
constexpr std::size_t most_panels = 400;  // of a rim
constexpr double least_angle = 1e-3;      // of pi: sharper corners have no place for poles

/// The layout of one rim while it is made.
class Layout {
public:
    Layout(const PlanarRim& rim, const RimPolygon& polygon, bool is_outer, const RimResolution& resolution)
        : polygon_(polygon), resolution_(resolution)
    {
        layout_.is_outer = is_outer;
        layout_.center = polygon.center;
        for (std::size_t k = 0; k < rim.pieces(); ++k) pieces_.emplace_back(rim, k);
        for (std::size_t i = 0; i < polygon.points.size(); ++i)
            if (i == 0 || polygon.piece[i] != polygon.piece[i - 1]) first_chord_.push_back(i);
        first_chord_.push_back(polygon.points.size());
        if (pieces_[0].is_cubic()) add_corners();
        for (std::size_t k = 0; k < pieces_.size(); ++k) add_piece(k);
    }

    RimLayout take() { return std::move(layout_); }

private:
    struct Panel {
        double begin, end;  // s
        double gap;         // across the hole, a length
    };

    std::size_t next(std::size_t piece) const { return (piece + 1) % pieces_.size(); }
    double size_at(std::size_t corner) const
    {
        return std::abs(layout_.corners[corner].cut_end - layout_.corners[corner].vertex);
    }

    void add_corners()
    {
        for (std::size_t k = 0; k < pieces_.size(); ++k) {
            const RimPiece& before = pieces_[(k + pieces_.size() - 1) % pieces_.size()];
            const Complex vertex = pieces_[k].at(0.0), out = pieces_[k].begin_direction();
            double inside = std::arg(before.end_direction() / out) / pi;  // the rim's angle, in (0, 2)
            if (inside <= 0.0) inside += 2.0;
            const double domain = layout_.is_outer ? inside : 2.0 - inside;
            if (!(inside > least_angle && inside < 2.0 - least_angle))
                throw InputError("a corner of a rim is too sharp");
            // The middle of the side that is off the domain.
            const Complex off = out * std::polar(layout_.is_outer ? -1.0 : 1.0, 0.5 * inside * pi);
            double size = std::min(std::abs(before.from_end(1.0)), std::abs(pieces_[k].from_begin(1.0)));
            const std::size_t at = first_chord_[k], last = polygon_.points.size() - 1;
            size = std::min(size, 0.5 * polygon_.hit(vertex, off, at == 0 ? last : at - 1, at));
            RimCorner corner{vertex, vertex + size * off, {}};
            const double half = 0.5 * domain;  // the angle that the domain has in w
            const double spacing = pi * std::sqrt(2.0 * (2.0 - half) * half);
            for (int j = 1; j <= resolution_.corner_poles; ++j)
                corner.poles.push_back(-farthest_pole *
                                       std::exp(-spacing * (std::sqrt(resolution_.corner_poles) - std::sqrt(j))));
            layout_.corners.push_back(std::move(corner));
        }
    }

    /// The least distance from a stretch of a piece to the rest of the rim along its normals. @param side +1: left
    double gap_of(std::size_t k, double begin, double end, double side) const
    {
        constexpr int tried = 5, near = 3;
        double least = std::numeric_limits<double>::infinity();
        const std::size_t first = first_chord_[k], count = first_chord_[k + 1] - first;
        for (int i = 1; i <= tried; ++i) {
            const double s = begin + (end - begin) * i / (tried + 1);
            const Complex tangent = pieces_[k].derivative(s);
            const Complex normal = Complex(0.0, side) * tangent / std::abs(tangent);
            // Chords next to the place are no neighbours of it.
            const auto chord = static_cast<std::ptrdiff_t>(s * static_cast<double>(count));
            std::size_t low = first, high = first + count - 1;
            if (count > 2 * near + 1) {
                const auto n = static_cast<std::ptrdiff_t>(count);
                if (pieces_.size() == 1) {
                    low = static_cast<std::size_t>((chord - near + n) % n);
                    high = static_cast<std::size_t>((chord + near) % n);
                } else {
                    low = first + static_cast<std::size_t>(std::max<std::ptrdiff_t>(chord - near, 0));
                    high = first + static_cast<std::size_t>(std::min<std::ptrdiff_t>(chord + near, n - 1));
                }
            }
            least = std::min(least, polygon_.hit(pieces_[k].at(s), normal, low, high));
        }
        return least;
    }

    bool is_too_long(std::size_t k, const Panel& panel) const
    {
        const RimPiece& piece = pieces_[k];
        const double span = panel.end - panel.begin;
        double speed = std::numeric_limits<double>::infinity(), length = 0.0, bend = 0.0, depth = speed;
        for (const double x : {0.0, 0.25, 0.5, 0.75, 1.0}) {
            const double s = panel.begin + span * x;
            const double here = std::abs(piece.derivative(s));
            speed = std::min(speed, here);
            length = std::max(length, here * span);
            bend = std::max(bend, std::abs(piece.second_derivative(s)));
            depth = std::min(depth, std::abs(piece.at(s) - layout_.center));
        }
        const bool cubic = piece.is_cubic();
        // Next to a corner the corner's own poles resolve what is nearer than its size.
        const double from_begin = cubic ? std::abs(piece.from_begin(panel.begin)) + size_at(k) : depth;
        const double from_end = cubic ? std::abs(piece.from_end(1.0 - panel.end)) + size_at(next(k)) : depth;
        const double ends = std::min(from_begin, from_end);
        const double side = layout_.is_outer ? -1.0 : 1.0;
        const double across = std::min({panel.gap, 2.0 * gap_of(k, panel.begin, panel.end, -side), 2.0 * depth});
        return (length > across && length > 0.25 * ends) || length > 1.5 * ends || bend * span > 1.5 * speed;
    }

    std::vector<Panel> panels_of(std::size_t k) const
    {
        std::vector<Panel> waiting{{0.0, 1.0, 0.0}}, panels;
        while (!waiting.empty()) {
            Panel panel = waiting.back();
            waiting.pop_back();
            panel.gap = gap_of(k, panel.begin, panel.end, layout_.is_outer ? -1.0 : 1.0);
            if (panel.end - panel.begin > shortest_panel && is_too_long(k, panel)) {
                const double middle = 0.5 * (panel.begin + panel.end);
                waiting.push_back({middle, panel.end, 0.0});
                waiting.push_back({panel.begin, middle, 0.0});
                if (waiting.size() + panels.size() > most_panels)
                    throw InputError("a rim has more detail than can be resolved");
            } else {
                panels.push_back(panel);
            }
        }
        return panels;
    }

    void add_poles(std::size_t k, const Panel& panel)
    {
        const RimPiece& piece = pieces_[k];
        const double span = panel.end - panel.begin, side = layout_.is_outer ? -1.0 : 1.0;
        for (int j = 0; j < resolution_.panel_poles; ++j) {
            const double s = panel.begin + span * (j + 0.5) / resolution_.panel_poles;
            const double off = std::min(pole_offset * span, share_of_gap * panel.gap / std::abs(piece.derivative(s)));
            const Complex pole = piece.at({s, side * off});
            if ((polygon_.winding(pole) != 0) != layout_.is_outer) layout_.poles.push_back(pole);
        }
    }

    void add_piece(std::size_t k)
    {
        const RimPiece& piece = pieces_[k];
        std::vector<double> from_begin, from_end;  // s, and 1 - s
        for (const Panel& panel : panels_of(k)) {
            add_poles(k, panel);
            const int count = samples_for_pole * resolution_.panel_poles;
            for (int j = 0; j < count; ++j) {
                const double x = 0.5 - 0.5 * std::cos(pi * (j + 0.5) / count);
                const double s = panel.begin + (panel.end - panel.begin) * x;
                if (s < 0.5 || !piece.is_cubic())
                    from_begin.push_back(s);
                else
                    from_end.push_back((1.0 - panel.end) + (panel.end - panel.begin) * (1.0 - x));
            }
        }
        if (piece.is_cubic()) {
            add_corner_samples(k, std::abs(piece.from_begin(1.0)), from_begin);
            add_corner_samples(next(k), std::abs(piece.from_begin(1.0)), from_end);
        }
        std::ranges::sort(from_begin);
        std::ranges::sort(from_end, std::greater<>());
        for (const double s : from_begin) {
            if (piece.is_cubic())
                layout_.samples.push_back({piece.at(s), static_cast<int>(k), piece.from_begin(s)});
            else
                layout_.samples.push_back({piece.at(s)});
        }
        for (const double r : from_end)
            layout_.samples.push_back(
                {layout_.corners[next(k)].vertex + piece.from_end(r), static_cast<int>(next(k)), piece.from_end(r)});
    }

    /// Parameters from the nearest pole's distance to half of the piece, dense as the poles are.
    void add_corner_samples(std::size_t corner, double length, std::vector<double>& parameters) const
    {
        const double nearest = layout_.corners[corner].poles[0];
        const double least = std::min(0.1, sample_reach * nearest * nearest * size_at(corner) / length);
        const int count = samples_for_pole * resolution_.corner_poles;
        for (int j = 1; j <= count; ++j)
            parameters.push_back(0.5 * std::pow(2.0 * least, 1.0 - std::sqrt(static_cast<double>(j) / count)));
    }

    const RimPolygon& polygon_;
    const RimResolution& resolution_;
    std::vector<RimPiece> pieces_;
    std::vector<std::size_t> first_chord_;
    RimLayout layout_;
};

}  // namespace

RimLayout rim_layout(const PlanarRim& rim, const RimPolygon& polygon, bool is_outer, const RimResolution& resolution)
{
    return Layout(rim, polygon, is_outer, resolution).take();
}

RimLayout circle_layout(const Circle& circle, bool is_outer, int points)
{
    RimLayout layout{is_outer, circle.center, {}, {}, {}};
    for (int i = 0; i < points; ++i)
        layout.samples.push_back({circle.center + std::polar(circle.radius, 2.0 * pi * i / points)});
    return layout;
}

}  // namespace koebe
