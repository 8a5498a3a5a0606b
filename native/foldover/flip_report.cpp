#include "foldover/flip_report.h"

#include "conformal/stored_uv.h"
#include "core/connectivity.h"

#include <algorithm>
#include <cstdio>
#include <numeric>

namespace koebe {
namespace {

constexpr std::size_t limb = 12;  // faces: fewer are a corner where hardly any flux runs, not a limb
constexpr double coarse = 0.25;   // inner vertices over loop vertices: with fewer, faces reach from loop to loop

/// The surface with its map.
struct MappedSurface : NamedSurface {
    const PlanarPoints& uv;
};

std::string plural(std::size_t n, const std::string& noun)
{
    if (n == 1) return "1 " + noun;
    return std::to_string(n) + " " + (noun == "vertex" ? "vertices" : noun + "s");
}

std::string figure(double value)
{
    char text[32];
    std::snprintf(text, sizeof text, "%.2g", value);
    return text;
}

/// Some faces in the input's numbering, rising.
std::vector<Index> input_faces(const MappedSurface& map, const std::vector<Index>& faces)
{
    std::vector<Index> result;
    for (const Index f : faces) result.push_back(map.original_faces[f]);
    std::sort(result.begin(), result.end());
    return result;
}

Warning flap_warning(const MappedSurface& map, const std::vector<Flap>& flaps)
{
    std::vector<Index> faces;
    std::size_t rim = 0, inner = 0;
    const Flap* first = nullptr;
    for (const Flap& flap : flaps) {
        faces.insert(faces.end(), flap.faces.begin(), flap.faces.end());
        if (flap.loop == 0) continue;
        rim += flap.rim.size();
        ++inner;
        if (!first) first = &flap;
    }
    std::string text = plural(flaps.size(), "part") + " of " + plural(faces.size(), "face") +
                       " in all, the first behind the edge " + std::to_string(map.original[flaps[0].first]) + "-" +
                       std::to_string(map.original[flaps[0].last]) + ", hang on their loop by that edge alone: ";
    text += inner == 0 ? "drawn along the unit circle"
                       : plural(inner, "part") + " drawn inside their hole, with " + plural(rim, "vertex") +
                             " off the circle, the first " + std::to_string(map.original[first->rim[0]]);
    return {WarningKind::flaps, text, input_faces(map, faces)};
}

/// Connected faces that are too small to be stored, with a flipped one among them.
struct LostRegion {
    std::vector<Index> faces;
    std::size_t flipped = 0;
    Index tip = -1;         // corner of the face that is smallest in UV
    int loop = 0;           // the one with a vertex nearest to the tip on the surface
    double extent = 0.0;    // longest stored edge
    double shortest = 0.0;  // longest edge of the smallest face, in UV units and 64 bits
};

std::vector<LostRegion> lost_regions(const MappedSurface& map)
{
    const Triangles& triangles = map.surface.triangles;
    std::vector<char> met(triangles.rows(), 0), flipped(triangles.rows(), 0);
    std::vector<Index> below_resolution;
    for (Eigen::Index f = 0; f < triangles.rows(); ++f)
        if (const StoredFace face(triangles, map.uv, f); face.flipped() && face.below_resolution()) {
            below_resolution.push_back(static_cast<Index>(f));
            flipped[f] = 1;
        }
    const auto longest_edge = [&](Index f) {
        double longest = 0.0;
        for (int k = 0; k < 3; ++k)
            longest =
                std::max(longest, 0.5 * (map.uv.row(triangles(f, k)) - map.uv.row(triangles(f, (k + 1) % 3))).norm());
        return longest;
    };
    std::vector<LostRegion> regions;
    for (const Index seed : below_resolution) {
        if (std::exchange(met[seed], 1)) continue;
        LostRegion region;
        region.faces.push_back(seed);
        Index smallest = seed;
        region.shortest = longest_edge(seed);
        for (std::size_t head = 0; head < region.faces.size(); ++head) {
            const Index f = region.faces[head];
            region.flipped += flipped[f];
            region.extent = std::max(region.extent, StoredFace(triangles, map.uv, f).longest_edge());
            if (const double size = longest_edge(f); size < region.shortest) {
                region.shortest = size;
                smallest = f;
            }
            for (Index h = 3 * f; h < 3 * f + 3; ++h) {
                if (map.surface.twin[h] == no_twin) continue;
                const Index g = face_of(map.surface.twin[h]);
                if (!met[g] && StoredFace(triangles, map.uv, g).below_resolution()) {
                    met[g] = 1;
                    region.faces.push_back(g);
                }
            }
        }
        region.tip = triangles(smallest, 0);
        double nearest = std::numeric_limits<double>::infinity();
        for (std::size_t k = 0; k < map.loops.size(); ++k)
            for (const Index v : map.loops[k])
                if (const double d = (map.vertices.row(v) - map.vertices.row(region.tip)).norm(); d < nearest) {
                    nearest = d;
                    region.loop = static_cast<int>(k);
                }
        regions.push_back(std::move(region));
    }
    return regions;
}

}  // namespace

std::vector<Warning> flip_warnings(const NamedSurface& whole, const PlanarPoints& uv, const std::vector<Flap>& flaps,
                                   const UntangleReport& untangled, const Distortion& distortion)
{
    const MappedSurface map{whole, uv};
    std::vector<Warning> warnings;
    std::size_t rim = 0;
    for (const VertexLoop& loop : map.loops) rim += loop.size();
    const std::size_t inside = map.original.size() - rim;
    if (map.loops.size() > 1 && static_cast<double>(inside) < coarse * static_cast<double>(rim))
        warnings.push_back({WarningKind::coarse_mesh,
                            "too coarse: " + plural(inside, "vertex") + " between the loops' " + std::to_string(rim) +
                                ", so that faces reach from loop to loop and the map is far from conformal (mean angle "
                                "error " + figure(distortion.angle_error_deg.mean) + " degrees); subdivide the mesh"});
    if (!flaps.empty()) warnings.push_back(flap_warning(map, flaps));
    if (!untangled.freed.empty()) {
        Warning freed{WarningKind::off_circle, plural(untangled.freed.size(), "vertex") +
                                                   " taken off the circle, where straight triangles cannot follow it"};
        for (const Index v : untangled.freed) freed.elements.push_back(map.original[v]);
        std::sort(freed.elements.begin(), freed.elements.end());
        warnings.push_back(std::move(freed));
    }
    for (const LostRegion& region : lost_regions(map))
        warnings.push_back(
            {WarningKind::below_resolution,
             plural(region.faces.size(), "face") + " around vertex " + std::to_string(map.original[region.tip]) +
                 ", nearest to loop " + std::to_string(region.loop) +
                 ", shrank below the resolution of 32-bit UVs (edges from " + figure(region.shortest) + " to " +
                 figure(region.extent) + "), " + plural(region.flipped, "face") + " of them to no area",
             input_faces(map, region.faces),
             region.faces.size() < limb ? "" : "A long limb does this: a seam or a hole near its end helps"});
    if (!untangled.tangled.empty())
        warnings.push_back({WarningKind::flipped, plural(untangled.tangled.size(), "face") + " flipped",
                            input_faces(map, untangled.tangled)});
    return warnings;
}

}  // namespace koebe
