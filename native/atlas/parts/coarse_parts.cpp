#include "parts/coarse_parts.h"

#include "core/errors.h"
#include "part_maps/part_mesh.h"
#include "splitting/coarse_surface.h"

#include <algorithm>
#include <map>
#include <numeric>
#include <optional>
#include <unordered_map>
#include <utility>

namespace koebe {
namespace {

constexpr double least_share = 0.05;  // of the coarse faces: a part gets about as many, however small it is

/// All parts as one mesh of several components, small parts enlarged.
struct Together {
    std::vector<Index> first_vertex{0}, first_face{0};  // (parts + 1)
    Vertices vertices;
    PlanarPoints points;
    Triangles triangles;
};

Together put_together(const std::vector<FlatPart>& parts)
{
    Together all;
    for (const FlatPart& part : parts) {
        all.first_vertex.push_back(all.first_vertex.back() + static_cast<Index>(part.vertices.rows()));
        all.first_face.push_back(all.first_face.back() + static_cast<Index>(part.surface.triangles.rows()));
    }
    all.vertices.resize(all.first_vertex.back(), 3);
    all.points.resize(all.first_vertex.back(), 2);
    all.triangles.resize(all.first_face.back(), 3);
    std::vector<double> areas;
    for (const FlatPart& part : parts) areas.push_back(face_areas(part.vertices, part.surface.triangles).sum());
    const double least = least_share * std::accumulate(areas.begin(), areas.end(), 0.0);
    for (std::size_t k = 0; k < parts.size(); ++k) {
        const double larger = std::sqrt(std::max(1.0, least / std::max(areas[k], 1e-300)));
        all.vertices.middleRows(all.first_vertex[k], parts[k].vertices.rows()) = larger * parts[k].vertices;
        all.points.middleRows(all.first_vertex[k], parts[k].points.rows()) = parts[k].points;
        all.triangles.middleRows(all.first_face[k], parts[k].surface.triangles.rows()) =
            parts[k].surface.triangles.array() + all.first_vertex[k];
    }
    return all;
}

/// (V) the mirror image of each vertex of all parts, where it is one vertex of one part; empty: there is no mirror.
std::vector<Index> images_of(const std::vector<FlatPart>& parts, const Together& all)
{
    if (std::ranges::all_of(parts, [](const FlatPart& part) { return part.image.empty(); })) return {};
    std::unordered_map<Index, std::vector<std::pair<std::size_t, Index>>> places;  // by the vertex of the whole
    for (std::size_t k = 0; k < parts.size(); ++k)
        for (std::size_t v = 0; v < parts[k].original.size(); ++v)
            places[parts[k].original[v]].emplace_back(k, all.first_vertex[k] + static_cast<Index>(v));
    const auto places_of = [&](Index v) {
        const auto found = places.find(v);
        return found == places.end() ? std::vector<std::pair<std::size_t, Index>>{} : found->second;
    };
    std::vector<Index> images(static_cast<std::size_t>(all.first_vertex.back()), -1);
    for (std::size_t k = 0; k < parts.size(); ++k) {
        // A vertex at a cut lies in several parts: its image is in the part where most images are.
        std::map<std::size_t, Index> votes;
        for (const Index image : parts[k].image)
            if (const auto found = places_of(image); found.size() == 1) ++votes[found.front().first];
        if (votes.empty()) continue;
        const std::size_t there =
            std::ranges::max_element(votes, {}, [](const auto& vote) { return vote.second; })->first;
        for (std::size_t v = 0; v < parts[k].image.size(); ++v) {
            auto found = places_of(parts[k].image[v]);
            std::erase_if(found, [&](const auto& place) { return place.first != there; });
            if (found.size() == 1) images[static_cast<std::size_t>(all.first_vertex[k]) + v] = found.front().second;
        }
    }
    return images;
}

/// @param faces of the fine part @param triangles their corners after the coarsening, fine vertices
/// @param source fills with the fine vertex of each vertex
std::optional<FlatPart> coarse_part(const FlatPart& fine, const std::vector<Index>& faces, Triangles triangles,
                                    std::vector<Index>& source)
{
    std::vector<Index> number(fine.original.size(), -1);
    for (Index& corner : triangles.reshaped<Eigen::RowMajor>()) {
        Index& own = number[corner];
        if (own < 0) {
            own = static_cast<Index>(source.size());
            source.push_back(corner);
        }
        corner = own;
    }
    FlatPart part;
    try {
        part.surface = require_bordered_genus_zero(triangles, static_cast<Index>(source.size()));
    } catch (const TopologyError&) {
        return {};
    }
    if (part.surface.loops.size() != fine.surface.loops.size()) return {};
    take_faces(fine, faces, part);
    take_vertices(fine, source, part);
    part.polygon.clear();
    part.kind = fine.kind;
    part.loops = fine.loops;
    part.slit = fine.slit;
    for (const std::vector<Index>& rim : fine.rims) {
        part.rims.emplace_back();
        for (const Index v : rim)
            if (number[v] >= 0) part.rims.back().push_back(number[v]);
    }
    if (!lies_one_to_one(part, part.points)) return {};
    // Chords are shorter than arcs: as large as the fine part, it wants the same scale.
    const double area = face_areas(fine.vertices, fine.surface.triangles).sum();
    part.vertices *= std::sqrt(area / std::max(face_areas(part.vertices, part.surface.triangles).sum(), 1e-300));
    return part;
}

}  // namespace

CoarseParts coarse_parts(const std::vector<FlatPart>& fine, Index faces, ExecutionContext& context)
{
    const Together all = put_together(fine);
    CoarseParts result;
    const CoarseSurface coarse =
        coarse_surface(all.vertices, all.triangles, faces, {&all.points, images_of(fine, all)}, context);
    std::size_t begin = 0;
    for (std::size_t k = 0; k < fine.size(); ++k) {
        std::size_t end = begin;
        while (end < coarse.face.size() && coarse.face[end] < all.first_face[k + 1]) ++end;
        std::vector<Index> own, source;
        Triangles corners(static_cast<Eigen::Index>(end - begin), 3);
        for (std::size_t i = begin; i < end; ++i) {
            own.push_back(coarse.face[i] - all.first_face[k]);
            for (int c = 0; c < 3; ++c)
                corners(static_cast<Eigen::Index>(i - begin), c) =
                    coarse.vertex[coarse.triangles(static_cast<Eigen::Index>(i), c)] - all.first_vertex[k];
        }
        begin = end;
        std::optional<FlatPart> part;
        if (fine[k].tips.empty() && !own.empty()) part = coarse_part(fine[k], own, corners, source);
        if (!part) {
            source.resize(fine[k].original.size());
            std::iota(source.begin(), source.end(), 0);
        }
        result.parts.push_back(part ? std::move(*part) : fine[k]);
        result.vertex.push_back(std::move(source));
    }
    return result;
}

}  // namespace koebe
