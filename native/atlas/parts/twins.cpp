#include "parts/twins.h"

#include "core/connectivity.h"
#include "planar/planar_predicates.h"
#include "quality/distortion.h"
#include "quality/stored_uv.h"

#include <cmath>

namespace koebe {
namespace {

constexpr double size_tolerance = 0.05;  // of the wanted sizes at a vertex
constexpr double worse_angles = 0.1;     // degrees,
constexpr double worse_share = 1.05;     // and times the error

/// (V) the mean wanted size of the faces at each vertex; empty: 1.
VectorXd sizes_at_vertices(const FlatPart& part)
{
    if (part.sizes.empty()) return {};
    VectorXd sum = VectorXd::Zero(part.vertices.rows()), count = sum;
    for (Index c = 0; c < static_cast<Index>(part.surface.triangles.size()); ++c) {
        sum[part.surface.triangles.data()[c]] += part.sizes[face_of(c)];
        count[part.surface.triangles.data()[c]] += 1.0;
    }
    return sum.array() / count.array().max(1.0);
}

bool have_same_sizes(const FlatPart& part, const FlatPart& other, const std::vector<Index>& vertex)
{
    const VectorXd own = sizes_at_vertices(part), others = sizes_at_vertices(other);
    if (own.size() == 0 || others.size() == 0) return own.size() == others.size();
    return ((others(vertex).array() / own.array()).log().abs() <= size_tolerance).all();
}

/// The points as they lie on the twin's front.
PlanarPoints seen_from_front(PlanarPoints points, bool mirrored)
{
    if (mirrored) points.col(0) *= -1.0;
    return points;
}

bool keeps_angles(const FlatPart& part, const PlanarPoints& points)
{
    const auto error = [&](const PlanarPoints& at) {
        return measure_distortion(part.vertices, part.surface.triangles, at).angle_error_deg.mean;
    };
    for (Eigen::Index f = 0; f < part.surface.triangles.rows(); ++f)
        if (!(signed_area(points, part.surface.triangles, f) > 0.0)) return false;
    return error(points) <= worse_share * error(part.points) + worse_angles;
}

/// @param mirrored false: a mirror image is no twin
std::vector<std::optional<Twin>> twins_of(std::vector<FlatPart>& parts, bool mirrored)
{
    std::vector<const FlatPart*> all;
    for (const FlatPart& part : parts) all.push_back(&part);
    const auto accepts = [&](std::size_t k, std::size_t other, const Twin& twin) {
        const PlanarPoints there = parts[other].points(twin.vertex, Eigen::all);
        return have_same_sizes(parts[k], parts[other], twin.vertex) &&
               keeps_angles(parts[k], seen_from_front(there, twin.mirrored));
    };
    std::vector<std::optional<Twin>> twins = congruent_parts(
        all, mirrored, [&](std::size_t k) { return parts[k].one_to_one; }, accepts);
    for (std::size_t k = 0; k < parts.size(); ++k) {
        if (!twins[k]) continue;
        FlatPart& other = parts[twins[k]->of];
        if (!twins[k]->mirrored) parts[k].has_copy = other.has_copy = true;
        parts[k].points = seen_from_front(other.points(twins[k]->vertex, Eigen::all), twins[k]->mirrored);
        parts[k].along_axes = other.along_axes;
        parts[k].up = twins[k]->mirrored ? -std::conj(other.up) : other.up;
    }
    return twins;
}

}  // namespace

Twins find_twins(std::vector<FlatPart>& parts)
{
    Twins twins;
    twins.copies = twins_of(parts, false);
    twins.all = twins_of(parts, true);
    return twins;
}

bool lies_as_twin(const FlatPart& part, const Twin& twin, const PlanarPoints& uv)
{
    const auto at = [&](Index v) { return StoredPoint{as_stored(uv(v, 0)), as_stored(uv(v, 1))}; };
    for (const auto& face : part.surface.triangles.rowwise()) {
        const Index second = face[twin.mirrored ? 2 : 1], third = face[twin.mirrored ? 1 : 2];
        if (StoredFace(at(face[0]), at(second), at(third)).doubtful()) return false;
    }
    return true;
}

}  // namespace koebe
