#include "pipeline/map_warnings.h"

#include "core/connectivity.h"
#include "core/counted.h"
#include "core/numbering.h"
#include "quality/shared_warnings.h"
#include "quality/stored_uv.h"

#include <algorithm>

namespace koebe {
namespace {

constexpr std::size_t limb = 12;  // faces; a smaller region is a corner with hardly any flux, not a limb
constexpr double delicate = 1e4;  // least height of a face, in steps of the grid, for the grid not to show
constexpr double coarse = 0.25;   // inner vertices over loop vertices: with fewer, faces reach from loop to loop

std::string figure(double value) { return formatted("%.2g", value); }

/// The faces in the input's numbering, ascending.
std::vector<Index> input_faces(const MapInput& whole, const std::vector<Index>& faces)
{
    std::vector<Index> result = values_at(whole.original_faces, faces);
    std::sort(result.begin(), result.end());
    return result;
}

Warning ear_warning(const MapInput& whole, const std::vector<Ear>& ears)
{
    std::vector<Index> faces;
    std::size_t rim = 0, inner = 0;
    const Ear* first = nullptr;
    for (const Ear& ear : ears) {
        faces.insert(faces.end(), ear.faces.begin(), ear.faces.end());
        if (ear.loop == 0) continue;
        rim += ear.rim.size();
        ++inner;
        if (!first) first = &ear;
    }
    std::string text = "joined to a loop by one edge: " + counted(ears.size(), "part") + " with " +
                       counted(faces.size(), "face") + ", the first by the edge " +
                       std::to_string(whole.original[ears[0].first]) + "-" +
                       std::to_string(whole.original[ears[0].last]) + "; ";
    text += inner == 0 ? "drawn along the unit circle"
                       : counted(inner, "part") + " drawn inside their hole, with " + counted(rim, "vertex") +
                             " off the circle, the first " + std::to_string(whole.original[first->rim[0]]);
    return {WarningKind::ears, text, input_faces(whole, faces)};
}

/// Connected faces that are too small to be stored, at least one of them flipped.
struct LostRegion {
    std::vector<Index> faces;
    std::size_t flipped = 0;
    Index tip = -1;         // corner of the face that is smallest in UV
    int loop = 0;           // the loop with the vertex nearest to the tip on the surface
    double extent = 0.0;    // longest stored edge
    double shortest = 0.0;  // longest edge of the smallest face, in UV units and 64 bits
};

std::vector<LostRegion> lost_regions(const MapInput& whole, const PlanarPoints& uv)
{
    const Triangles& triangles = whole.surface.triangles;
    std::vector<char> met(triangles.rows(), 0), flipped(triangles.rows(), 0);
    std::vector<Index> below_resolution;
    for (Eigen::Index f = 0; f < triangles.rows(); ++f)
        if (const StoredFace face(triangles, uv, f); face.flipped() && face.below_resolution()) {
            below_resolution.push_back(static_cast<Index>(f));
            flipped[f] = 1;
        }
    // Lengths in UV units and 64 bits: what is stored of these faces is rounding.
    const auto longest_edge = [&](Index f) {
        double longest = 0.0;
        for (int k = 0; k < 3; ++k)
            longest = std::max(longest, 0.5 * (uv.row(triangles(f, k)) - uv.row(triangles(f, (k + 1) % 3))).norm());
        return longest;
    };
    std::vector<LostRegion> regions;
    for (const Index seed : below_resolution) {
        if (std::exchange(met[seed], 1)) continue;
        LostRegion region;
        region.faces.push_back(seed);
        Index smallest = seed;
        region.shortest = longest_edge(seed);
        // Grow over neighbours that are too small, flipped or not.
        for (std::size_t head = 0; head < region.faces.size(); ++head) {
            const Index f = region.faces[head];
            region.flipped += flipped[f];
            region.extent = std::max(region.extent, StoredFace(triangles, uv, f).longest_edge());
            if (const double size = longest_edge(f); size < region.shortest) {
                region.shortest = size;
                smallest = f;
            }
            for (Index h = 3 * f; h < 3 * f + 3; ++h) {
                if (whole.surface.twin[h] == no_twin) continue;
                const Index g = face_of(whole.surface.twin[h]);
                if (!met[g] && StoredFace(triangles, uv, g).below_resolution()) {
                    met[g] = 1;
                    region.faces.push_back(g);
                }
            }
        }
        // The loop with the vertex nearest to the tip in space.
        region.tip = triangles(smallest, 0);
        double nearest = std::numeric_limits<double>::infinity();
        for (std::size_t k = 0; k < whole.loops.size(); ++k)
            for (const Index v : whole.loops[k])
                if (const double d = (whole.vertices.row(v) - whole.vertices.row(region.tip)).norm(); d < nearest) {
                    nearest = d;
                    region.loop = static_cast<int>(k);
                }
        regions.push_back(std::move(region));
    }
    return regions;
}

}  // namespace

std::vector<Warning> circle_warnings(const CircleMap& map)
{
    std::vector<Warning> warnings;
    const auto add = [&](WarningKind kind, const char* sentence, const std::vector<Index>& loops) {
        if (!loops.empty()) warnings.push_back({kind, sentence + std::to_string(loops.size()), loops});
    };
    add(WarningKind::shrunk_circles,
        "circles made smaller because they met another circle, where the mesh is too coarse: ", map.shrunk);
    add(WarningKind::lost_circles,
        "circles without meaning, because the loop is too deep for rounding or the mesh around it too coarse: ",
        map.lost);
    add(WarningKind::replaced_circles,
        "loops put on other circles, because faces would turn over on the circles of the iteration: ", map.replaced);
    return warnings;
}

std::vector<Warning> input_warnings(const MapInput& whole)
{
    std::vector<Warning> warnings;
    if (const auto& unused = whole.surface.unused; !unused.empty())
        warnings.push_back({WarningKind::unused_vertices,
                            "vertices that belong to no face, put at the centre: " + std::to_string(unused.size()),
                            unused});
    const auto& turned = whole.surface.reoriented;
    warn_reoriented(turned, warnings,
                    2 * turned.size() == static_cast<std::size_t>(whole.surface.triangles.rows())
                        ? "These are half of the faces: only the numbers of the faces decide which side is the front"
                        : "");
    if (whole.thinnest < delicate)
        warnings.push_back(
            {WarningKind::thin_faces,
             "faces so thin that the last digits of their coordinates show in the map: the surface may get "
             "another map if it is turned or scaled"});
    return warnings;
}

std::vector<Warning> iteration_warnings(const KoebeOutcome& outcome, bool no_circles)
{
    std::vector<Warning> warnings;
    if (outcome.raised_angles > 0)
        warnings.push_back(
            {WarningKind::no_flux, counted(static_cast<std::size_t>(outcome.raised_angles), "boundary vertex step") +
                                       " without flux: the vertices are kept apart by a least distance"});
    if (no_circles)
        warnings.push_back({WarningKind::no_circles,
                            "the iteration led to no circles: these circles were fitted to a map of low angle error"});
    if (!outcome.converged)
        warnings.push_back({WarningKind::not_converged,
                            "not converged in " + counted(static_cast<std::size_t>(outcome.sweeps), "sweep")});
    return warnings;
}

std::vector<Warning> flip_warnings(const MapInput& whole, const PlanarPoints& uv, const std::vector<Ear>& ears,
                                   const UntangleReport& untangled, const Distortion& distortion)
{
    std::vector<Warning> warnings;
    std::size_t rim = 0;
    for (const VertexLoop& loop : whole.loops) rim += loop.size();
    const std::size_t inside = whole.original.size() - rim;
    if (whole.loops.size() > 1 && static_cast<double>(inside) < coarse * static_cast<double>(rim))
        warnings.push_back(
            {WarningKind::coarse_mesh,
             "too coarse: " + counted(inside, "vertex") + " inside and " + std::to_string(rim) +
                 " on loops. Faces reach from loop to loop, and the map is far from conformal (mean angle "
                 "error " +
                 figure(distortion.angle_error_deg.mean) + " degrees). Subdivide the mesh"});
    if (!ears.empty()) warnings.push_back(ear_warning(whole, ears));
    // What the repair did, and what it could not.
    warn_off_circle(values_at(whole.original, untangled.freed), warnings);
    for (const LostRegion& region : lost_regions(whole, uv))
        warnings.push_back(
            {WarningKind::below_resolution,
             counted(region.faces.size(), "face") + " around vertex " + std::to_string(whole.original[region.tip]) +
                 ", nearest to loop " + std::to_string(region.loop) +
                 ", shrank below the resolution of 32-bit UVs (edges from " + figure(region.shortest) + " to " +
                 figure(region.extent) + "), " + counted(region.flipped, "face") + " of them flipped",
             input_faces(whole, region.faces),
             region.faces.size() < limb ? "" : "A long limb does this: a seam or a hole near its end helps"});
    if (!untangled.tangled.empty())
        warnings.push_back({WarningKind::flipped, counted(untangled.tangled.size(), "face") + " flipped",
                            input_faces(whole, untangled.tangled)});
    return warnings;
}

}  // namespace koebe
