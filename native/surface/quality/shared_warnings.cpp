#include "quality/shared_warnings.h"

#include "core/counted.h"
#include "core/sort_unique.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <utility>

namespace koebe {

void warn_reoriented(const std::vector<Index>& faces, std::vector<Warning>& warnings, const std::string& advice)
{
    if (!faces.empty())
        warnings.push_back({WarningKind::reoriented_faces,
                            counted(faces.size(), "face") + " turned to the orientation of the others", faces, advice});
}

void warn_inside_out(const Vertices& vertices, const Surface& surface, std::vector<Warning>& warnings)
{
    if (!surface.loops.empty() || surface.triangles.rows() == 0) return;
    constexpr double least_share = 1e-6;  // of the volume, over that of all tetrahedra: less is rounding
    const Eigen::RowVector3d middle = vertices.row(surface.triangles(0, 0));
    double volume = 0.0, whole = 0.0;
    for (Eigen::Index f = 0; f < surface.triangles.rows(); ++f) {
        const Eigen::RowVector3d a = vertices.row(surface.triangles(f, 0)) - middle;
        const Eigen::RowVector3d b = vertices.row(surface.triangles(f, 1)) - middle;
        const Eigen::RowVector3d c = vertices.row(surface.triangles(f, 2)) - middle;
        const double own = a.dot(b.cross(c));
        volume += own;
        whole += std::abs(own);
    }
    if (!(volume < -least_share * whole)) return;
    warnings.push_back(
        {WarningKind::reoriented_faces,
         "the surface is inside out: its faces are clockwise seen from outside, so this is the map of its "
         "mirror image",
         {},
         "Reverse all faces"});
}

void warn_not_even(const std::vector<Index>& faces, std::vector<Warning>& warnings)
{
    const std::string what = faces.empty() ? "the map stays" : "parts stay";
    warnings.push_back(
        {WarningKind::not_even, what + " conformal: no one-to-one map that is more even was found", faces});
}

void warn_not_one_to_one(const std::vector<Index>& flipped, const std::vector<Index>& below_resolution,
                         const std::vector<std::string>& others, std::vector<Warning>& warnings)
{
    Warning warning{WarningKind::not_one_to_one, "no one-to-one map was found: "};
    std::ranges::set_difference(flipped, below_resolution, std::back_inserter(warning.elements));
    std::string wrong = warning.elements.empty() ? "" : counted(warning.elements.size(), "face") + " flipped";
    for (const std::string& other : others)
        if (!other.empty()) wrong += (wrong.empty() ? "" : "; ") + other;
    warning.sentence += wrong;
    warnings.push_back(std::move(warning));
}

void warn_off_circle(std::vector<Index> vertices, std::vector<Warning>& warnings)
{
    sort_unique(vertices);
    if (vertices.empty()) return;
    std::string sentence =
        counted(vertices.size(), "vertex") + " taken off the circle, where straight triangles cannot follow it";
    warnings.push_back({WarningKind::off_circle, std::move(sentence), std::move(vertices)});
}

}  // namespace koebe
