#include "lift/image_relief.h"

#include "core/connectivity.h"
#include "core/errors.h"
#include "lift/sphere_sheets.h"
#include "planar/planar_predicates.h"
#include "quality/stored_uv.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <utility>

namespace koebe {
namespace {

constexpr double most_fine_faces = 4e6;
constexpr double about_faces = 1e6;  // without a size

/// Halves the longest edges first, so that no angle becomes small: a face is cut from the middle of its longest edge.
class Refinement {
public:
    Refinement(const FlatSheet& sheet, double longest_uv, std::optional<double> longest)
        : sheet_(sheet), longest_uv_(longest_uv), longest_(longest)
    {
        for (Eigen::Index v = 0; v < sheet.vertices.rows(); ++v) {
            points_.push_back(sheet.vertices.row(v));
            normals_.push_back(sheet.normals.row(v));
        }
        corners_.assign(sheet.triangles.data(), sheet.triangles.data() + sheet.triangles.size());
        uv_ = sheet.uv;
        for (Index f = 0; f < static_cast<Index>(sheet.triangles.rows()); ++f) face_.push_back(f);
    }

    FineSheet run()
    {
        require_few_faces(least_faces());
        while (halve_once()) require_few_faces(static_cast<double>(face_.size()));
        require_stored();
        FineSheet fine;
        fine.vertices.resize(static_cast<Eigen::Index>(points_.size()), 3);
        fine.normals.resize(static_cast<Eigen::Index>(points_.size()), 3);
        for (std::size_t v = 0; v < points_.size(); ++v) {
            fine.vertices.row(static_cast<Eigen::Index>(v)) = points_[v];
            fine.normals.row(static_cast<Eigen::Index>(v)) = normals_[v];
        }
        fine.triangles = as_triangles();
        fine.uv = std::move(uv_);
        fine.face = std::move(face_);
        return fine;
    }

private:
    static void require_few_faces(double count)
    {
        if (count > most_fine_faces)
            throw InputError("the relief would have over four million faces: give a larger size");
    }

    /// No face with edges up to l has more area than l^2 sqrt(3) / 4, and halving keeps the area.
    double least_faces() const
    {
        return longest_ ? 4.0 * sheet_.area / (std::numbers::sqrt3 * *longest_ * *longest_) : 0.0;
    }

    Triangles as_triangles() const
    {
        return Eigen::Map<const Triangles>(corners_.data(), static_cast<Eigen::Index>(corners_.size() / 3), 3);
    }

    double length(Index h) const
    {
        const Index n = next_halfedge(h);
        return longest_ ? (points_[corners_[h]] - points_[corners_[n]]).norm() : distance(uv_[h], uv_[n]);
    }

    Index longest_edge(Index face) const
    {
        Index best = 3 * face;
        for (Index h = best + 1; h < 3 * face + 3; ++h)
            if (length(h) > length(best)) best = h;
        return best;
    }

    /// Marks edges that are too long, and the longest edge of each face that has a marked one [Rivara 1984].
    std::vector<char> marked_edges(const std::vector<Index>& twin) const
    {
        const Index count = static_cast<Index>(corners_.size());
        const double most = longest_ ? *longest_ : longest_uv_;
        std::vector<char> marked(count, 0);
        std::vector<Index> faces;
        const auto mark = [&](Index h) {
            if (marked[h]) return;
            for (const Index side : {h, twin[h]})
                if (side != no_twin) {
                    marked[side] = 1;
                    faces.push_back(face_of(side));
                }
        };
        for (Index h = 0; h < count; ++h)
            if (length(h) > most) mark(h);
        while (!faces.empty()) {
            const Index face = faces.back();
            faces.pop_back();
            mark(longest_edge(face));
        }
        return marked;
    }

    Complex middle_in_uv(Index h) const
    {
        const Complex z = 0.5 * (uv_[h] + uv_[next_halfedge(h)]);
        if (sheet_.grid == 0.0) return z;
        return {std::round(z.real() / sheet_.grid) * sheet_.grid, std::round(z.imag() / sheet_.grid) * sheet_.grid};
    }

    bool halve_once()
    {
        const std::vector<Index> twin = pair_halfedges(as_triangles(), static_cast<Index>(points_.size()));
        const std::vector<char> marked = marked_edges(twin);
        std::vector<Index> middle(corners_.size(), -1);
        bool any = false;
        for (Index h = 0; h < static_cast<Index>(middle.size()); ++h) {
            if (!marked[h] || middle[h] >= 0) continue;
            any = true;
            middle[h] = static_cast<Index>(points_.size());
            if (twin[h] != no_twin) middle[twin[h]] = middle[h];
            const Index a = corners_[h], b = corners_[next_halfedge(h)];
            points_.push_back(0.5 * (points_[a] + points_[b]));
            const Eigen::RowVector3d normal = normals_[a] + normals_[b];
            normals_.push_back(normal.norm() > 0.0 ? normal.normalized() : normals_[a]);
        }
        if (any) divide(middle);
        return any;
    }

    void divide(const std::vector<Index>& middle)
    {
        std::vector<Index> corners;
        std::vector<Complex> uv;
        std::vector<Index> face;
        using Corner = std::pair<Index, Complex>;
        const auto add = [&](const Corner& a, const Corner& b, const Corner& c) {
            for (const Corner& corner : {a, b, c}) {
                corners.push_back(corner.first);
                uv.push_back(corner.second);
            }
        };
        for (Index f = 0; f < static_cast<Index>(corners_.size() / 3); ++f) {
            const std::size_t before = corners.size();
            const auto note = [&] { face.resize(face.size() + (corners.size() - before) / 3, face_[f]); };
            const Index first = longest_edge(f), second = next_halfedge(first), third = next_halfedge(second);
            const auto at = [&](Index h) { return Corner{corners_[h], uv_[h]}; };
            const auto half = [&](Index h) { return Corner{middle[h], middle_in_uv(h)}; };
            // A face is cut from the middle of its longest edge, and its halves at their marked edges.
            if (middle[first] < 0) {
                add(at(first), at(second), at(third));
                note();
                continue;
            }
            const Corner m = half(first);
            if (middle[second] >= 0) {
                add(m, at(second), half(second));
                add(m, half(second), at(third));
            } else {
                add(m, at(second), at(third));
            }
            if (middle[third] >= 0) {
                add(m, at(third), half(third));
                add(m, half(third), at(first));
            } else {
                add(m, at(third), at(first));
            }
            note();
        }
        corners_ = std::move(corners);
        uv_ = std::move(uv);
        face_ = std::move(face);
    }

    void require_stored() const
    {
        std::vector<Index> small;
        for (Index f = 0; f < static_cast<Index>(corners_.size() / 3); ++f) {
            std::array<StoredPoint, 3> stored{};
            bool own = true;
            for (int k = 0; k < 3; ++k) {
                stored[k] = {as_stored(uv_[3 * f + k].real()), as_stored(uv_[3 * f + k].imag())};
                own = own && corners_[3 * f + k] < sheet_.vertices.rows();
            }
            if (!own && StoredFace(stored[0], stored[1], stored[2]).doubtful()) small.push_back(f);
        }
        if (!small.empty())
            throw InputError(std::to_string(small.size()) +
                             " faces of the relief would be too small for 32-bit UVs: give a larger size");
    }

    const FlatSheet& sheet_;
    double longest_uv_;
    std::optional<double> longest_;
    std::vector<Eigen::RowVector3d> points_, normals_;
    std::vector<Index> corners_, face_;
    std::vector<Complex> uv_;
};

/// Where the image's columns and rows lie: shares of its width and height for a place in the UVs.
class ImageFrame {
public:
    ImageFrame(const FlatSheet& sheet, const ImagePlace& place)
        : periods_(sheet.periods), repeats_(place.repeats), home_scale_(place.home_scale)
    {
        if (periods_.size() != 1) return;
        low_ = high_ = sheet.uv.front().imag();
        for (const Complex z : sheet.uv) {
            low_ = std::min(low_, z.imag());
            high_ = std::max(high_, z.imag());
        }
    }

    Complex operator()(Complex z) const
    {
        if (home_scale_ > 0.0) {
            const SpherePoint p = point_at_home(home_scale_, z);
            const double longitude = std::atan2(p[1], p[0]), latitude = std::atan2(p[2], std::hypot(p[0], p[1]));
            return {repeats_ * (0.5 + 0.5 * longitude / std::numbers::pi), 0.5 + latitude / std::numbers::pi};
        }
        if (periods_.empty()) return z;
        if (periods_.size() == 1) return {repeats_ * z.real() / periods_[0].real(), (z.imag() - low_) / (high_ - low_)};
        const double whole = cross(periods_[0], periods_[1]);
        return {repeats_ * cross(z, periods_[1]) / whole, cross(periods_[0], z) / whole};
    }

    /// Lengths in the UVs of the image's width and height.
    Complex size() const
    {
        if (home_scale_ > 0.0)  // a radian is half of it at a pole, and all of it at the equator
            return 0.7 * std::numbers::pi * home_scale_ * Complex(2.0 / repeats_, 1.0);
        if (periods_.empty()) return {1.0, 1.0};
        if (periods_.size() == 1) return {periods_[0].real() / repeats_, high_ - low_};
        return {std::abs(periods_[0]) / repeats_, std::abs(periods_[1])};
    }

private:
    std::vector<Complex> periods_;
    double repeats_, home_scale_, low_ = 0.0, high_ = 1.0;
};

/// The pixel, or the nearest one: beyond the ends it goes on, or stays.
int pixel_at(double index, int count, bool goes_on)
{
    if (!goes_on) return static_cast<int>(std::clamp(index, 0.0, count - 1.0));
    const double rest = std::fmod(index, count);
    return static_cast<int>(rest < 0.0 ? rest + count : rest) % count;
}

double bilinear(const GreyImage& image, Complex place, bool round, bool up)
{
    const double x = place.real() * image.width - 0.5, y = (1.0 - place.imag()) * image.height - 0.5;
    const double left = std::floor(x), top = std::floor(y);
    const auto value = [&](double column, double row) {
        return image.at(pixel_at(column, image.width, round), pixel_at(row, image.height, up));
    };
    const double above = std::lerp(value(left, top), value(left + 1.0, top), x - left);
    const double below = std::lerp(value(left, top + 1.0), value(left + 1.0, top + 1.0), x - left);
    return std::lerp(above, below, y - top);
}

double mean_of_row(const GreyImage& image, int row)
{
    double sum = 0.0;
    for (int column = 0; column < image.width; ++column) sum += image.at(column, row);
    return sum / image.width;
}

}  // namespace

FineSheet refined_sheet(const FlatSheet& sheet, double longest_uv, std::optional<double> longest)
{
    return Refinement(sheet, longest_uv, longest).run();
}

double pixel_edge(const FlatSheet& sheet, const GreyImage& image, const ImagePlace& place)
{
    const Complex size = ImageFrame(sheet, place).size();
    const double flat = sheet.area / (sheet.mean_scale * sheet.mean_scale);
    return std::max({size.real() / image.width, size.imag() / image.height, std::sqrt(4.0 * flat / about_faces)});
}

VectorXd image_values(const FlatSheet& sheet, const FineSheet& fine, const GreyImage& image, const ImagePlace& place)
{
    const ImageFrame frame(sheet, place);
    VectorXd values = VectorXd::Zero(fine.vertices.rows());
    const auto at_pole = [&](Complex spot) {
        return place.home_scale > 0.0 && std::abs(spot.imag() - 0.5) > 0.5 - 1e-9;
    };
    for (std::size_t c = 0; c < fine.uv.size(); ++c) {
        const Complex spot = frame(fine.uv[c]);
        if (at_pole(spot)) {
            values[fine.triangles.data()[c]] = mean_of_row(image, spot.imag() > 0.5 ? 0 : image.height - 1);
            continue;
        }
        values[fine.triangles.data()[c]] =
            bilinear(image, spot, !sheet.periods.empty() || place.home_scale > 0.0, sheet.periods.size() == 2);
    }
    return values;
}

}  // namespace koebe
