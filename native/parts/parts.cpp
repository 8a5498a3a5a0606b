#include "parts/parts.h"

#include "core/connectivity.h"
#include "core/counted.h"
#include "core/detachable_run.h"
#include "core/memory_limit.h"
#include "linear/dense_spd.h"
#include "parts/flat_part.h"
#include "parts/packing.h"
#include "parts/splitting.h"
#include "quality/stored_uv.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <numeric>
#include <utility>

namespace koebe {
namespace {

constexpr double cut_share = 2.0 / 3.0;  // of a part's price, for a cut as long as the root of the area
constexpr double margin = 0.004;         // between parts, in the unit square

/// Into the unit square; tubes upright.
std::vector<PlanarPoints> packed(const std::vector<FlatPart>& flats)
{
    std::vector<PlanarPoints> placed;
    std::vector<Box> boxes;
    for (const FlatPart& flat : flats) {
        PlanarPoints points = flat.points;
        Eigen::RowVector2d low = points.colwise().minCoeff(), high = points.colwise().maxCoeff();
        if (high[0] - low[0] > high[1] - low[1]) {
            points.col(0) = -flat.points.col(1);
            points.col(1) = flat.points.col(0);
            low = points.colwise().minCoeff();
            high = points.colwise().maxCoeff();
        }
        points.rowwise() -= low;
        boxes.push_back({high[0] - low[0], high[1] - low[1]});
        placed.push_back(std::move(points));
    }
    const PackedBoxes pack = pack_boxes(boxes, margin);
    for (std::size_t k = 0; k < placed.size(); ++k) {
        placed[k].rowwise() += Eigen::RowVector2d(pack.corners[k][0], pack.corners[k][1]);
        placed[k] /= pack.side;
    }
    return placed;
}

/// The corner of a face of the surface for each corner of the input's face, which may have been turned.
int turned_corner(const Triangles& input, const Triangles& oriented, Eigen::Index f, int k)
{
    for (int c = 0; c < 3; ++c)
        if (oriented(f, c) == input(f, k)) return c;
    return k;
}

struct Corners {
    Vertices vertices;    // (3F, 3) in the surface's orientation
    Triangles triangles;  // each corner a vertex of its own
    PlanarPoints points;  // (3F, 2) in the unit disk's coordinates
};

Distortion distortion_of(const CutSurface& whole, const PlanarPoints& corner_uv, const std::vector<Index>& faces)
{
    Corners corners;
    const Eigen::Index count = static_cast<Eigen::Index>(faces.size());
    corners.vertices.resize(3 * count, 3);
    corners.points.resize(3 * count, 2);
    corners.triangles.resize(count, 3);
    for (Eigen::Index i = 0; i < count; ++i)
        for (int k = 0; k < 3; ++k) {
            const Eigen::Index c = 3 * i + k;
            corners.triangles(i, k) = static_cast<Index>(c);
            corners.vertices.row(c) = whole.vertices.row(whole.surface.triangles(faces[i], k));
            // What is stored, so that the report is true of it.
            const Eigen::RowVector2f stored = corner_uv.row(3 * static_cast<Eigen::Index>(faces[i]) + k).cast<float>();
            corners.points.row(c) = 2.0 * stored.cast<double>().array() - 1.0;
        }
    return measure_distortion(corners.vertices, corners.triangles, corners.points);
}

/// Texel densities of the stored UVs: the ratio of the quantiles, and the area within a factor 3.
void report_density(const CutSurface& whole, const PlanarPoints& uv, PartsResult& result)
{
    std::vector<std::pair<double, double>> density;
    double lost = 0.0;
    for (Eigen::Index f = 0; f < whole.areas.size(); ++f) {
        const Eigen::Matrix<double, 3, 2> p = uv.middleRows(3 * f, 3).cast<float>().cast<double>();
        const double area =
            0.5 * ((p(1, 0) - p(0, 0)) * (p(2, 1) - p(0, 1)) - (p(2, 0) - p(0, 0)) * (p(1, 1) - p(0, 1)));
        if (!(whole.areas[f] > 0.0)) continue;
        density.emplace_back(area > 0.0 ? 0.5 * std::log(area / whole.areas[f]) : -50.0, whole.areas[f]);
        if (!(area > 0.0)) lost += whole.areas[f];
    }
    std::ranges::sort(density);
    double total = 0.0, below = 0.0, low = 0.0, high = 0.0;
    for (const auto& [u, area] : density) total += area;
    bool has_low = false, has_high = false;
    for (const auto& [u, area] : density) {
        below += area;
        if (!has_low && below >= 0.05 * total) low = u, has_low = true;
        if (!has_high && below >= 0.95 * total) high = u, has_high = true;
    }
    result.density_ratio_5_95 = std::exp(high - low);
    double inside = 0.0;
    std::size_t end = 0;
    for (std::size_t i = 0; i < density.size(); ++i) {
        while (end < density.size() && density[end].first <= density[i].first + even_range)
            inside += density[end++].second;
        result.even_area = std::max(result.even_area, inside / total);
        inside -= density[i].second;
    }
    (void)lost;
}

double border_of(const CutSurface& whole, const std::vector<Index>& part)
{
    double length = 0.0;
    for (Index h = 0; h < static_cast<Index>(whole.surface.twin.size()); ++h)
        if (const Index t = whole.surface.twin[h]; t > h && part[face_of(h)] != part[face_of(t)])
            length += whole.lengths[h];
    return length;
}

void report(const CutSurface& whole, const Triangles& triangles, const PlanarPoints& uv, PartsResult& result)
{
    std::vector<Index> faces(static_cast<std::size_t>(triangles.rows()));
    std::iota(faces.begin(), faces.end(), 0);
    Distortion distortion = distortion_of(whole, uv, faces);
    result.flipped = std::move(distortion.flipped);
    result.below_resolution = std::move(distortion.below_resolution);
    result.angle_error_deg = distortion.angle_error_deg;
    for (PartReport& part : result.parts)
        part.angle_error_deg = distortion_of(whole, uv, part.faces).angle_error_deg.mean;
    report_density(whole, uv, result);
    result.cut_length = border_of(whole, result.part) + result.slit_length;
    result.uv.resize(uv.rows(), 2);
    for (Eigen::Index f = 0; f < triangles.rows(); ++f)
        for (int k = 0; k < 3; ++k)
            result.uv.row(3 * f + k) = uv.row(3 * f + turned_corner(triangles, whole.surface.triangles, f, k));
}

PartsResult compute(const Vertices& vertices, const Triangles& triangles, const PartsOptions& options,
                    ExecutionContext& context)
{
    const auto begin = std::chrono::steady_clock::now();
    if (!(options.price > 0.0) || !std::isfinite(options.price))
        throw InputError("the price of a part must be positive");
    require_memory_for_faces(triangles.rows());
    const SerialDenseKernels serial;
    context.begin_stage("topology", 0.0, 0.05);
    const CutSurface whole = cut_surface(vertices, triangles);
    context.begin_stage("split", 0.05, 0.6);
    SplitEffort effort;
    const SplitOptions prices{options.price, cut_share * options.price};
    std::vector<PartPointer> parts = split_surface(whole, prices, context, effort);
    context.begin_stage("merge", 0.6, 0.85);
    merge_parts(whole, prices, parts, context, effort);
    std::ranges::sort(parts, [](const PartPointer& a, const PartPointer& b) { return a->mesh.faces < b->mesh.faces; });

    context.begin_stage("pack", 0.85, 1.0);
    PartsResult result;
    result.maps = effort.maps;
    std::vector<FlatPart> flats;
    for (const PartPointer& part : parts) flats.push_back(flat_part(whole, *part));
    std::vector<PlanarPoints> placed = packed(flats);
    PlanarPoints uv(triangles.size(), 2);
    result.part.assign(static_cast<std::size_t>(triangles.rows()), -1);
    for (std::size_t k = 0; k < flats.size(); ++k) {
        FlatPart& flat = flats[k];
        repair_flips(flat, placed[k], context);
        for (std::size_t f = 0; f < flat.faces.size(); ++f) {
            result.part[flat.faces[f]] = static_cast<Index>(k);
            for (int c = 0; c < 3; ++c)
                uv.row(3 * static_cast<Eigen::Index>(flat.faces[f]) + c) =
                    placed[k].row(flat.surface.triangles(static_cast<Eigen::Index>(f), c));
        }
        result.slit_length += flat.slit;
        result.parts.push_back({flat.kind, std::move(flat.faces), std::move(flat.loops), 0.0});
    }
    if (!uv.allFinite()) throw SolverError("the map of a part is not finite");
    report(whole, triangles, uv, result);
    result.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
    return result;
}

}  // namespace

PartsResult parts_of(const Vertices& vertices, const Triangles& triangles, const PartsOptions& options,
                     ExecutionContext& context)
{
    return run_detachable<PartsResult>(context, [vertices, triangles, options](ExecutionContext& own) {
        return compute(vertices, triangles, options, own);
    });
}

}  // namespace koebe
