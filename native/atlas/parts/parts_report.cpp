#include "parts/parts_report.h"

#include "core/counted.h"
#include "part_maps/part_mesh.h"
#include "parts/hard_figures.h"
#include "planar/planar_predicates.h"
#include "quality/shared_warnings.h"
#include "quality/stored_uv.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>

namespace koebe {
namespace {

/// Texel densities: the ratio of the quantiles, and the area within the best factor 3. Faces without area in the UVs
/// count as the least dense.
/// @param pixels_per_unit pixels along the square, over the length of the layout's unit in the mesh's
void report_density(const PartsLayout& layout, const PlanarPoints& uv, const std::vector<Index>& faces,
                    double pixels_per_unit, PartsResult& result)
{
    constexpr double none = -1000.0;
    const VectorXd areas = face_areas(layout.vertices, layout.triangles);
    std::vector<std::pair<double, double>> density;
    double total = 0.0;
    for (const Index f : faces) {
        if (!(areas[f] > 0.0)) continue;
        const double area = signed_corner_area(uv, f);
        density.emplace_back(area > 0.0 ? 0.5 * std::log(area / areas[f]) : none, areas[f]);
        total += areas[f];
    }
    std::ranges::sort(density);
    if (density.empty()) return;
    result.density_ratio_5_95 = std::exp(std::min(quantile(density, 0.95) - quantile(density, 0.05), 700.0));
    result.density = std::exp(quantile(density, 0.5)) * pixels_per_unit;
    double inside = 0.0;
    std::size_t end = 0;
    for (const auto& [u, area] : density) {
        while (end < density.size() && density[end].first <= u + factor_three) inside += density[end++].second;
        result.even_area = std::max(result.even_area, inside / total);
        inside -= area;
    }
}

/// The length of edges whose faces do not meet in the UVs. An edge of more than two faces counts for each further face.
double seam_length(const PartsLayout& layout, const std::vector<Index>& faces)
{
    using Side = std::array<double, 7>;  // the edge's vertices, their UVs, and the part: twins may meet in their fold
    std::vector<Side> sides;
    sides.reserve(3 * faces.size());
    for (const Index f : faces)
        for (int k = 0; k < 3; ++k) {
            Eigen::Index a = 3 * static_cast<Eigen::Index>(f) + k, b = 3 * static_cast<Eigen::Index>(f) + (k + 1) % 3;
            if (layout.triangles.data()[a] > layout.triangles.data()[b]) std::swap(a, b);
            sides.push_back({static_cast<double>(layout.triangles.data()[a]),
                             static_cast<double>(layout.triangles.data()[b]), layout.uv(a, 0), layout.uv(a, 1),
                             layout.uv(b, 0), layout.uv(b, 1), static_cast<double>(layout.part[f])});
        }
    std::sort(sides.begin(), sides.end());
    double length = 0.0;
    for (std::size_t i = 1; i < sides.size(); ++i) {
        if (sides[i][0] != sides[i - 1][0] || sides[i][1] != sides[i - 1][1] || sides[i] == sides[i - 1]) continue;
        const auto end = [&](int k) { return layout.vertices.row(static_cast<Eigen::Index>(sides[i][k])); };
        length += (end(0) - end(1)).norm();
    }
    return length;
}

std::vector<Warning> warnings_of(const PartsLayout& layout, const std::vector<Index>& left_out,
                                 const Distortion& distortion)
{
    std::vector<Warning> warnings;
    // Of the mesh.
    if (!left_out.empty())
        warnings.push_back(
            {WarningKind::collapsed_faces,
             counted(left_out.size(), "face") + " in no part: without area, or with the same vertices as another face",
             left_out});
    warn_reoriented(layout.reoriented, warnings);
    // Of the UVs as stored. A face too small for them may lie either way.
    if (!distortion.below_resolution.empty())
        warnings.push_back({WarningKind::below_resolution,
                            counted(distortion.below_resolution.size(), "face") + " below the resolution of 32-bit UVs",
                            distortion.below_resolution, lower_price});
    if (distortion.flipped.size() > distortion.below_resolution.size()) {
        std::vector<Index> flipped;
        std::ranges::set_difference(distortion.flipped, distortion.below_resolution, std::back_inserter(flipped));
        warnings.push_back({WarningKind::flipped, counted(flipped.size(), "face") + " flipped in 32-bit UVs", flipped});
    }
    if (!layout.crossing.empty())
        warnings.push_back({WarningKind::not_one_to_one,
                            "parts whose boundary crosses itself, with " + counted(layout.crossing.size(), "face"),
                            layout.crossing});
    if (!layout.not_even.empty()) warn_not_even(layout.not_even, warnings);
    return warnings;
}

}  // namespace

double quantile(const std::vector<std::pair<double, double>>& values, double share)
{
    double total = 0.0, below = 0.0;
    for (const auto& [value, weight] : values) total += weight;
    for (const auto& [value, weight] : values)
        if ((below += weight) >= share * total) return value;
    return values.back().first;
}

void describe(PartsLayout& layout, const Vertices& vertices, const Triangles& triangles, const PackedParts& packed,
              const PartsOptions& options, double pixels_per_unit, PartsResult& result)
{
    // Distortion, and the density of the faces that have a part.
    const PlanarPoints uv = layout.uv.unaryExpr(&as_stored);
    result.vertex_count = static_cast<Index>(vertices.rows());
    result.face_count = static_cast<Index>(triangles.rows());
    std::vector<Index> mapped, left_out;
    for (std::size_t f = 0; f < layout.part.size(); ++f)
        (layout.part[f] >= 0 ? mapped : left_out).push_back(static_cast<Index>(f));
    result.uv = uv_of_input(layout, triangles);
    result.distortion = {distortion_of_parts(layout, uv, mapped),
                         judge_corners(vertices, triangles, result.uv, layout.turned, left_out)};
    result.turned = layout.turned;
    result.parts = std::move(layout.parts);
    for (PartReport& part : result.parts)
        part.angle_error_deg = distortion_of_parts(layout, uv, part.faces).angle_error_deg.mean;
    report_density(layout, uv, mapped, pixels_per_unit, result);

    // The square: twins cover no further area.
    for (const Index f : mapped)
        if (!packed.twins[static_cast<std::size_t>(layout.part[f])]) result.coverage += signed_corner_area(uv, f);
    result.tiles = packed.tiles;
    result.coverage /= packed.tiles;
    result.margin = packed.margin * options.pixels;
    const HardFigures hard = hard_figures(layout, uv);
    result.regions = hard.regions;
    result.whole = hard.whole;
    result.aligned = hard.aligned;

    // Cuts and effort.
    result.cut_length = seam_length(layout, mapped);
    result.slit_length = layout.slit_length;
    result.dart_length = layout.dart_length;
    result.darts = layout.darts;
    result.handles_cut = layout.handles_cut;
    result.maps = layout.maps;
    result.even = layout.even;
    result.overlaps = layout.overlaps;
    result.converged =
        layout.crossing.empty() && result.distortion.flipped.size() == result.distortion.below_resolution.size();
    result.warnings = warnings_of(layout, left_out, result.distortion);
}

}  // namespace koebe
