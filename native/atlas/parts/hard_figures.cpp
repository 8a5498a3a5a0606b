#include "parts/hard_figures.h"

#include "cost/tolerances.h"
#include "cost/tuning.h"
#include "cut/disjoint_sets.h"
#include "part_maps/part_mesh.h"
#include "surface/face_vectors.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <map>
#include <tuple>
#include <utility>
#include <vector>

namespace koebe {
namespace {

constexpr double flat = 1e-4;               // of the region's size: distance from its plane,
constexpr double most_noise_bend = 0.5;     // radians: the most that noise bends an edge of a region
constexpr double sliver = 1e-6;             // of the region's area: its own normal is only rounding
constexpr double same_shape = 2e-3;         // and of its image from a similar one
constexpr double long_outer_edge = 0.05;    // in roots of the area: such an edge is straight by itself,
constexpr double goes_on_straight = 0.996;  // cosine of 5 degrees: others if the border goes on like that
constexpr double same_uv = 1e-6;            // UV units: faces meet at an edge up to this

/// A side of a face, as an edge of the mesh.
struct FaceSide {
    Index low, high;                   ///< its vertices
    Eigen::Index face, first, second;  ///< the corners at the low and at the high vertex
};

class HardMeasure {
public:
    HardMeasure(const PartsLayout& layout, const PlanarPoints& uv)
        : layout_(layout), uv_(uv), areas_(face_areas(layout.vertices, layout.triangles))
    {
        for (Eigen::Index f = 0; f < layout.triangles.rows(); ++f) {
            if (layout.part[f] < 0) continue;
            for (int k = 0; k < 3; ++k) {
                Eigen::Index a = 3 * f + k, b = 3 * f + (k + 1) % 3;
                if (vertex(a) > vertex(b)) std::swap(a, b);
                sides_.push_back({vertex(a), vertex(b), f, a, b});
            }
        }
        std::ranges::sort(sides_, {}, [](const FaceSide& s) { return std::tuple(s.low, s.high, s.face); });
    }

    HardFigures run()
    {
        HardFigures figures;
        measure_regions(figures);
        measure_edges(figures);
        return figures;
    }

private:
    Index vertex(Eigen::Index corner) const { return layout_.triangles.data()[corner]; }
    Eigen::RowVector3d point(Index v) const { return layout_.vertices.row(v); }

    Eigen::RowVector3d normal(Eigen::Index f) const
    {
        return twice_area_vector(layout_.vertices, layout_.triangles, f).normalized();
    }

    /// Calls visit(begin, end) for the sides of each edge.
    template <class Visit>
    void each_edge(const Visit& visit) const
    {
        for (auto begin = sides_.begin(); begin != sides_.end();) {
            auto end = begin;
            while (end != sides_.end() && end->low == begin->low && end->high == begin->high) ++end;
            visit(begin, end);
            begin = end;
        }
    }

    /// Whether faces that meet are bent by less than half a degree, or than noise bends them.
    bool in_one_plane(Eigen::Index f, Eigen::Index g) const
    {
        double angle = tolerance::coplanar;
        for (const Eigen::Index face : {f, g}) {
            double longest = 0.0;
            for (int k = 0; k < 3; ++k)
                longest = std::max(
                    longest, (point(layout_.triangles(face, k)) - point(layout_.triangles(face, (k + 1) % 3))).norm());
            if (layout_.noise > 0.0) angle += layout_.noise * longest / std::max(2.0 * areas_[face], 1e-300);
        }
        return normal(f).dot(normal(g)) > std::cos(std::min(angle, most_noise_bend));
    }

    void measure_regions(HardFigures& figures) const
    {
        // Regions: faces joined across edges that do not bend.
        DisjointSets sets(layout_.part.size());
        each_edge([&](auto begin, auto end) {
            for (auto side = begin + 1; side < end; ++side)
                if (in_one_plane(begin->face, side->face))
                    sets.join(static_cast<Index>(begin->face), static_cast<Index>(side->face));
        });
        std::map<Index, std::vector<Eigen::Index>> regions;
        double whole = 0.0, all = 0.0, total = 0.0;
        for (Eigen::Index f = 0; f < areas_.size(); ++f) {
            if (layout_.part[f] < 0) continue;
            regions[sets.find(static_cast<Index>(f))].push_back(f);
            total += areas_[f];
        }
        // Of the planar ones that are large enough, the area that lies whole in one island. Slivers do not decide.
        for (auto& [root, faces] : regions) {
            double area = 0.0;
            for (const Eigen::Index f : faces) area += areas_[f];
            std::erase_if(faces, [&](Eigen::Index f) { return areas_[f] < sliver * area; });
            bool is_whole = false;
            if (!(area > tuning::small_area * total) || !is_planar(faces, is_whole)) continue;
            ++figures.regions;
            all += area;
            if (is_whole) whole += area;
        }
        if (all > 0.0) figures.whole = whole / all;
    }

    /// Whether the faces lie in one plane. Sets whether their image is one similar to them.
    bool is_planar(const std::vector<Eigen::Index>& faces, bool& is_whole) const
    {
        // The mean plane, the middle of the corners, and that of their images.
        Eigen::RowVector3d up = Eigen::RowVector3d::Zero(), centre = up;
        Complex middle = 0.0;
        for (const Eigen::Index f : faces) {
            up += areas_[f] * normal(f);
            for (int k = 0; k < 3; ++k) {
                centre += point(layout_.triangles(f, k));
                middle += Complex(uv_(3 * f + k, 0), uv_(3 * f + k, 1));
            }
        }
        const double corners = 3.0 * static_cast<double>(faces.size());
        up.normalize();
        const Eigen::RowVector3d right = up.unitOrthogonal(), ahead = up.cross(right);
        // Places x in the plane and their images z. The similar map z = s x of least squares has s = sum conj(x) z /
        // sum |x|^2, and its mirror image s = sum x z / sum |x|^2.
        std::vector<Complex> place, image;
        double size = 0.0, off = 0.0, image_size = 0.0, square = 0.0;
        Complex factor[2] = {0.0, 0.0};  // of the region, and of its mirror image
        for (const Eigen::Index f : faces)
            for (int k = 0; k < 3; ++k) {
                const Eigen::RowVector3d arm = point(layout_.triangles(f, k)) - centre / corners;
                const Complex x(arm.dot(right), arm.dot(ahead));
                const Complex z = Complex(uv_(3 * f + k, 0), uv_(3 * f + k, 1)) - middle / corners;
                place.push_back(x);
                image.push_back(z);
                off = std::max(off, std::abs(arm.dot(up)));
                size = std::max(size, std::abs(x));
                image_size = std::max(image_size, std::abs(z));
                square += std::norm(x);
                factor[0] += std::conj(x) * z;
                factor[1] += x * z;
            }
        // How far the images are from the better one.
        double miss[2] = {0.0, 0.0};
        for (std::size_t i = 0; i < place.size(); ++i)
            for (int k = 0; k < 2; ++k)
                miss[k] = std::max(miss[k],
                                   std::abs(image[i] - factor[k] / square * (k == 0 ? place[i] : std::conj(place[i]))));
        const auto part_of = [&](Eigen::Index f) { return layout_.part[f]; };
        const double same = std::max(same_shape, size > 0.0 ? 2.0 * layout_.noise / size : 0.0) *
                            image_size;  // the planes beside it are off, too
        is_whole = std::min(miss[0], miss[1]) < same &&
                   std::ranges::all_of(faces, [&](Eigen::Index f) { return part_of(f) == part_of(faces.front()); });
        return off < std::max(flat * size, layout_.noise);
    }

    bool meet(const FaceSide& one, const FaceSide& other) const
    {
        return layout_.part[one.face] == layout_.part[other.face] &&
               (uv_.row(one.first) - uv_.row(other.first)).cwiseAbs().maxCoeff() < same_uv &&
               (uv_.row(one.second) - uv_.row(other.second)).cwiseAbs().maxCoeff() < same_uv;
    }

    void measure_edges(HardFigures& figures) const
    {
        // Edges of the outlines, and the directions in which outlines leave each vertex.
        std::vector<FaceSide> outer;
        each_edge([&](auto begin, auto end) {
            if (end - begin != 2 || !meet(*begin, *(begin + 1))) outer.insert(outer.end(), begin, end);
        });
        std::map<Index, std::vector<Eigen::RowVector3d>> leaving;
        const auto direction = [&](Index a, Index b) { return (point(b) - point(a)).normalized().eval(); };
        for (const FaceSide& side : outer) {
            leaving[side.low].push_back(direction(side.low, side.high));
            leaving[side.high].push_back(direction(side.high, side.low));
        }
        const auto goes_on = [&](Index v, const Eigen::RowVector3d& along) {
            return std::ranges::any_of(leaving.at(v), [&](const auto& d) { return d.dot(along) > goes_on_straight; });
        };
        // Long edges, and short ones that continue straight: how much of their length lies along an axis.
        const double least = long_outer_edge * std::sqrt(areas_.sum());
        double all = 0.0, along_axes = 0.0;
        for (const FaceSide& side : outer) {
            const Eigen::RowVector3d along = direction(side.low, side.high);
            if (!((point(side.high) - point(side.low)).norm() > least) && !goes_on(side.high, along) &&
                !goes_on(side.low, -along))
                continue;
            const Eigen::RowVector2d edge = uv_.row(side.second) - uv_.row(side.first);
            all += edge.norm();
            if (edge.cwiseAbs().minCoeff() < std::sin(tolerance::off_axis) * edge.norm()) along_axes += edge.norm();
        }
        if (all > 0.0) figures.aligned = along_axes / all;
    }

    const PartsLayout& layout_;
    const PlanarPoints& uv_;
    const VectorXd areas_;
    std::vector<FaceSide> sides_;  // by edges
};

}  // namespace

HardFigures hard_figures(const PartsLayout& layout, const PlanarPoints& uv) { return HardMeasure(layout, uv).run(); }

}  // namespace koebe
