#include "flatten/notches.h"

#include "flatten/edge_distance.h"
#include "planar/planar_predicates.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <string>

namespace koebe {
namespace {

constexpr double between_notches = 120.0;  // mm
constexpr int most_notches = 12, fewest_of_closed = 3;
constexpr double notch = 4.0, seam_text = 3.0, piece_text = 10.0;  // mm at most,
constexpr double least_text = 0.5;                                 // and at least
constexpr double share_of_seam = 0.2, share_of_piece = 0.06;       // of its length, and of the root of its area
constexpr double share_of_room = 0.5;                              // of the distance to the outline
constexpr Eigen::Index most_places = 400;                          // that are tried for a piece's number

PatternSheet& sheet_of(PlacedPieces& placed, std::size_t k)
{
    return placed.pattern.sheets[static_cast<std::size_t>(placed.sheet[k])];
}

double root_of_image(const FlatPart& part, const PlanarPoints& at)
{
    double area = 0.0;
    for (Eigen::Index f = 0; f < part.surface.triangles.rows(); ++f) area += signed_area(at, part.surface.triangles, f);
    return std::sqrt(std::max(area, 0.0));
}

/// A point of a seam's side, and the direction into its piece.
struct SidePoint {
    Eigen::RowVector2d at, along, inwards;
};

class MarkedSide {
public:
    MarkedSide(const SeamSide& side, const FlatPart& part, const PlanarPoints& at) : side_(side), at_(at)
    {
        sums_.push_back(0.0);
        for (std::size_t i = 1; i < side.path.size(); ++i) {
            const double edge = (part.vertices.row(side.path[i]) - part.vertices.row(side.path[i - 1])).norm();
            sums_.push_back(sums_.back() + edge);
            length_ += (at.row(side.path[i]) - at.row(side.path[i - 1])).norm();
        }
    }

    double length() const { return length_; }

    /// @param share of the length on the surface
    SidePoint point(double share) const
    {
        const double wanted = share * sums_.back();
        const auto after = std::ranges::lower_bound(sums_, wanted);
        const auto i = std::clamp<std::ptrdiff_t>(after - sums_.begin(), 1, std::ssize(sums_) - 1);
        const double edge = sums_[i] - sums_[i - 1];
        const double t = edge > 0.0 ? (wanted - sums_[i - 1]) / edge : 0.0;
        const Eigen::RowVector2d a = at_.row(side_.path[i - 1]), b = at_.row(side_.path[i]);
        Eigen::RowVector2d along = b - a;
        if (along.norm() > 0.0) along /= along.norm();
        if (!side_.inside_left) along = -along;
        return {a + t * (b - a), along, {-along[1], along[0]}};
    }

private:
    const SeamSide& side_;
    const PlanarPoints& at_;
    std::vector<double> sums_;  // on the surface
    double length_ = 0.0;       // flat
};

/// Where the notches are, in shares of the seam's length. The middle one has the number beside it.
std::vector<double> notches(double length, bool closed)
{
    int count = std::clamp(static_cast<int>(length / between_notches) + 1, 1, most_notches);
    if (closed) count = std::max(count, fewest_of_closed);
    std::vector<double> shares;
    for (int i = 0; i < count; ++i) shares.push_back(closed ? i / double(count) : (i + 1) / (count + 1.0));
    return shares;
}

}  // namespace

void mark_seams(const std::vector<Seam>& seams, const std::vector<FlatPart>& parts, PlacedPieces& placed)
{
    std::vector<double> roots;
    for (std::size_t k = 0; k < parts.size(); ++k) roots.push_back(root_of_image(parts[k], placed.points[k]));
    for (std::size_t s = 0; s < seams.size(); ++s) {
        std::vector<MarkedSide> sides;
        double least = std::numeric_limits<double>::infinity();
        for (const SeamSide& side : seams[s].sides) {
            sides.emplace_back(side, parts[side.part], placed.points[side.part]);
            least = std::min({least, share_of_seam * sides.back().length(), share_of_piece * roots[side.part]});
        }
        // Notches at the same shares of both sides, and the seam's number beside the middle one.
        const std::vector<double> shares = notches(sides.front().length(), seams[s].closed);
        const double tick = std::min(notch, least), text = std::max(std::min(seam_text, least), least_text);
        for (std::size_t i = 0; i < sides.size(); ++i) {
            const std::size_t part = seams[s].sides[i].part;
            const int piece = static_cast<int>(part) + 1;
            PatternSheet& sheet = sheet_of(placed, part);
            for (const double share : shares) {
                const SidePoint p = sides[i].point(share);
                PlanarPoints line(2, 2);
                line << p.at, p.at + tick * p.inwards;
                sheet.lines.push_back({LineKind::mark, piece, false, line});
            }
            const SidePoint p = sides[i].point(shares[shares.size() / 2]);
            sheet.labels.push_back({std::to_string(s + 1), piece, p.at + (tick + 0.8 * text) * p.inwards, text,
                                    std::atan2(p.along[1], p.along[0]) * 180.0 / std::numbers::pi});
        }
    }
}

void number_pieces(const std::vector<FlatPart>& parts, PlacedPieces& placed)
{
    for (std::size_t k = 0; k < parts.size(); ++k) {
        const PlanarPoints& at = placed.points[k];
        const Triangles& faces = parts[k].surface.triangles;
        Eigen::RowVector2d best = at.row(faces(0, 0));
        double room = -1.0;
        for (Eigen::Index f = 0; f < faces.rows(); f += faces.rows() / most_places + 1) {
            const Eigen::RowVector2d middle = (at.row(faces(f, 0)) + at.row(faces(f, 1)) + at.row(faces(f, 2))) / 3.0;
            double least = std::numeric_limits<double>::infinity();
            for (const VertexLoop& loop : parts[k].surface.loops)
                for (std::size_t i = 0; i < loop.size() && least > room; ++i)
                    least =
                        std::min(least, distance_to_edge(middle, at.row(loop[i]), at.row(loop[(i + 1) % loop.size()])));
            if (!(least > room)) continue;
            room = least;
            best = middle;
        }
        const int number = static_cast<int>(k) + 1;
        const double height = std::max(std::min(piece_text, share_of_room * room), least_text);
        sheet_of(placed, k).labels.push_back({'P' + std::to_string(number), number, best, height, 0.0});
    }
}

}  // namespace koebe
