#include "promise_check.h"
#include "targets.h"

#include "parts/parts.h"
#include "report/parts_json.h"
#include "report/schottky_json.h"
#include "report/sphere_json.h"
#include "report/tile_json.h"
#include "schottky/schottky_map.h"
#include "sphere/sphere_map.h"
#include "tiles/tile_map.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <string>
#include <vector>

namespace koebe::fuzz {
namespace {

constexpr Limits limits{9, 160};
constexpr double resolution = 1e-6;  // UV units

using Uv = std::array<double, 2>;

/// A number for each vertex, the same for those that some of the edges join: the least of them. -1: no such edge ends
/// there.
std::vector<Index> joined(std::size_t vertex_count, const std::vector<std::array<Index, 2>>& edges)
{
    std::vector<Index> part(vertex_count, -1);
    for (const auto& edge : edges)
        for (const Index v : edge) part[v] = v;
    for (bool changed = true; changed;) {
        changed = false;
        for (const auto& [a, b] : edges) {
            changed = changed || part[a] != part[b];
            part[a] = part[b] = std::min(part[a], part[b]);
        }
    }
    return part;
}

/// The largest piece, without faces that name a vertex twice or one that there is not, and without pairs of faces of
/// the same three vertices, which a plate's corners become when it is doubled: else hardly a surface would be left.
void clean(Soup& soup)
{
    const Index count = static_cast<Index>(soup.points.size());
    std::map<std::array<Index, 3>, int> copies;
    std::erase_if(soup.faces, [&](const auto& face) {
        return std::ranges::min(face) < 0 || std::ranges::max(face) >= count || face[0] == face[1] ||
               face[1] == face[2] || face[2] == face[0];
    });
    const auto key = [](std::array<Index, 3> face) {
        std::ranges::sort(face);
        return face;
    };
    for (const auto& face : soup.faces) ++copies[key(face)];
    std::erase_if(soup.faces, [&](const auto& face) { return copies[key(face)] > 1; });
    std::vector<std::array<Index, 2>> edges;
    for (const auto& [a, b, c] : soup.faces) edges.insert(edges.end(), {{a, b}, {b, c}});
    const std::vector<Index> piece = joined(soup.points.size(), edges);
    std::vector<int> size(soup.points.size(), 0);
    for (const auto& face : soup.faces) ++size[piece[face[0]]];
    const auto largest = std::ranges::max_element(size) - size.begin();
    std::erase_if(soup.faces, [&](const auto& face) { return piece[face[0]] != largest; });
}

/// As `joined` by the boundary.
std::vector<Index> boundary_parts(const Soup& soup)
{
    std::map<std::pair<Index, Index>, int> sides;
    for (const auto& face : soup.faces)
        for (std::size_t k = 0; k < 3; ++k) ++sides[std::minmax(face[k], face[(k + 1) % 3])];
    std::vector<std::array<Index, 2>> edges;
    for (const auto& [edge, count] : sides)
        if (count == 1) edges.push_back({edge.first, edge.second});
    return joined(soup.points.size(), edges);
}

/// Without the faces round some vertices, the first ones from `first` on whose neighbours are all inside.
void punch(Soup& soup, int count, std::size_t first)
{
    for (std::size_t i = 0; i < soup.points.size() && count > 0; ++i) {
        const Index v = static_cast<Index>((first + i) % soup.points.size());
        const std::vector<Index> boundary = boundary_parts(soup);
        const auto is_there = [&](const auto& face) { return std::ranges::count(face, v) > 0; };
        const auto is_inside = [&](const auto& face) {
            return std::ranges::all_of(face, [&](Index w) { return boundary[w] < 0; });
        };
        if (std::ranges::none_of(soup.faces, is_there)) continue;
        if (!std::ranges::all_of(soup.faces, [&](const auto& face) { return !is_there(face) || is_inside(face); }))
            continue;
        std::erase_if(soup.faces, is_there);
        --count;
    }
}

/// Each face in four.
Soup subdivided(const Soup& soup)
{
    Soup finer{soup.points, {}};
    std::map<std::pair<Index, Index>, Index> middles;
    const auto middle = [&](Index a, Index b) {
        const auto [at, is_new] = middles.try_emplace(std::minmax(a, b), static_cast<Index>(finer.points.size()));
        if (is_new) {
            const auto &p = soup.points[a], &q = soup.points[b];
            finer.points.push_back({0.5 * (p[0] + q[0]), 0.5 * (p[1] + q[1]), 0.5 * (p[2] + q[2])});
        }
        return at->second;
    };
    for (const auto& [a, b, c] : soup.faces) {
        const Index ab = middle(a, b), bc = middle(b, c), ca = middle(c, a);
        finer.faces.insert(finer.faces.end(), {{a, ab, ca}, {ab, b, bc}, {ca, bc, c}, {ab, bc, ca}});
    }
    return finer;
}

/// The surface and a second one behind it, sewn along the boundary: of a plate with h holes a body with h handles.
/// @param open the boundary's first part is not sewn
Soup doubled(const Soup& soup, bool open)
{
    const std::vector<Index> part = boundary_parts(soup);
    Index first = -1;
    for (const Index p : part)
        if (p >= 0 && (first < 0 || p < first)) first = p;
    Soup both = soup;
    std::vector<Index> twin(soup.points.size());
    for (std::size_t v = 0; v < twin.size(); ++v) {
        twin[v] = static_cast<Index>(v);
        if (part[v] >= 0 && !(open && part[v] == first)) continue;
        const auto [x, y, z] = soup.points[v];
        twin[v] = static_cast<Index>(both.points.size());
        both.points.push_back({x + 0.1, y - 0.05, z - 0.7});
    }
    for (const auto& [a, b, c] : soup.faces) both.faces.push_back({twin[a], twin[c], twin[b]});
    return both;
}

/// The faces without positive area as 32-bit floats, those that were turned seen from behind.
struct Flips {
    std::vector<Index> flipped, tiny;
};

Flips flips_of(const PlanarPoints& uv, const std::vector<Index>& turned)
{
    Flips flips;
    for (Index f = 0; 3 * f < uv.rows(); ++f) {
        const auto at = [&](int k) -> Uv {
            return {static_cast<float>(uv(3 * f + k, 0)), static_cast<float>(uv(3 * f + k, 1))};
        };
        Uv a = at(0), b = at(1), c = at(2);
        if (std::ranges::binary_search(turned, f)) std::swap(b, c);
        if ((b[0] - a[0]) * (c[1] - a[1]) - (c[0] - a[0]) * (b[1] - a[1]) > 0.0) continue;
        flips.flipped.push_back(f);
        const auto is_short = [](const Uv& p, const Uv& q) {
            return std::hypot(p[0] - q[0], p[1] - q[1]) < resolution;
        };
        if (is_short(a, b) && is_short(b, c) && is_short(c, a)) flips.tiny.push_back(f);
    }
    return flips;
}

void require_in_square(const PlanarPoints& uv)
{
    require(uv.allFinite(), "UVs are finite");
    require(uv.size() == 0 || (uv.minCoeff() >= 0.0 && uv.maxCoeff() <= 1.0), "UVs are in the unit square");
}

/// What every map promises of its UVs. @param flips of the UVs
void check_verdict(const MapReport& report, const Flips& flips)
{
    const Distortion& told = report.distortion;
    require(flips.flipped == told.flipped, "the flips are those of the report");
    require(flips.tiny == told.below_resolution, "so are those below resolution");
    require(std::isfinite(told.angle_error_stored_deg.mean), "the stored angle error is a number");
    require(told.lost_area >= 0.0 && told.lost_area <= 1.0, "the lost area is a share");
    require(!report.converged || told.lost_area <= MapOptions{}.most_lost, "what converged has lost little");
}

/// What tiles and Schottky maps promise alike.
template <class Result>
void check_plane(const Result& result)
{
    require_in_square(result.uv);
    const Flips flips = flips_of(result.uv, result.turned);
    check_verdict(result, flips);
    require(!result.converged || flips.flipped == flips.tiny, "what converged has no flips");
    require(!to_json(result).dump().empty(), "the report is JSON");
}

void check_tile(const TileResult& result)
{
    check_plane(result);
    require(std::isfinite(std::abs(result.modulus)) && result.modulus.imag() > 0.0, "the modulus is of a lattice");
    for (const TileLoop& loop : result.loops)
        require(!loop.has_circle || (loop.circle.radius > 0.0 && std::isfinite(loop.circle.radius)),
                "radii are positive");
}

void check_schottky(const SchottkyResult& result)
{
    check_plane(result);
    for (const SchottkyHandle& handle : result.handles) {
        const double size = std::abs(handle.generator.multiplier());
        require(size > 0.0 && size < 1.0, "generators are loxodromic");
        for (const Circle& circle : handle.circles) require(circle.radius > 0.0, "radii are positive");
    }
}

void check_sphere(const SphereResult& result)
{
    require(result.points.allFinite() && result.uv.allFinite(), "points and UVs are finite");
    for (Eigen::Index v = 0; v < result.points.rows(); ++v)
        require(std::abs(result.points.row(v).norm() - 1.0) < 1e-12, "points are on the unit sphere");
    check_verdict(result, flips_of(result.uv, result.turned));
    require(!result.converged || result.flipped_on_sphere == result.below_sphere_resolution,
            "what converged has no flips");
    for (const SphereLoop& loop : result.loops)
        require(std::isfinite(loop.cap.radius) && loop.cap.radius > 0.0, "caps have a positive radius");
    require(!to_json(result).dump().empty(), "the report is JSON");
}

void check_parts(const PartsResult& result)
{
    require_in_square(result.uv);
    std::vector<Index> turned;
    for (const Warning& warning : result.warnings)
        if (warning.kind == WarningKind::reoriented_faces) turned = warning.elements;
    Flips flips = flips_of(result.uv, turned);
    for (std::vector<Index>* faces : {&flips.flipped, &flips.tiny})
        std::erase_if(*faces, [&](Index f) { return result.part[f] < 0; });
    check_verdict(result, flips);
    require(!result.converged || flips.flipped == flips.tiny, "what converged has no flips");
    require(std::isfinite(result.density_ratio_5_95) && std::isfinite(result.cut_length), "figures are finite");
    require(!to_json(result).dump().empty(), "the report is JSON");
}

void check_domain(const Soup& soup, int kind, ExecutionContext& context)
{
    const Vertices vertices = soup.vertices();
    const Triangles triangles = soup.triangles();
    switch (kind) {
    case 0:
    case 1: {
        const SphereOptions options{.layout = kind == 0 ? SphereLayout::equirectangular : SphereLayout::octahedral};
        check_sphere(sphere_map(vertices, triangles, options, context));
        break;
    }
    case 2: check_tile(ring_map(vertices, triangles, {}, context)); break;
    case 3: check_tile(ring_map(vertices, triangles, {.holes = RingHoles::radial}, context)); break;
    case 4: check_tile(ring_map(vertices, triangles, {.holes = RingHoles::concentric}, context)); break;
    case 5: check_tile(torus_map(vertices, triangles, {}, context)); break;
    case 6: check_schottky(schottky_map(vertices, triangles, {}, context)); break;
    case 7:
        check_schottky(schottky_map(vertices, triangles, {.normalization = SchottkyNormalization::circles}, context));
        break;
    default: check_parts(parts_of(vertices, triangles, {.round_cuts = kind == 9}, context));
    }
}

}  // namespace

void fuzz_domains(Bytes bytes)
{
    constexpr int shapes = 3, kinds = domain_choices / shapes;
    Program program = run_program(bytes, limits);
    const int shape = program.choice % shapes, kind = program.choice / shapes % kinds;
    if (shape > 0) {  // else as it is, whatever it is
        clean(program.soup);
        if (kind >= 5) {
            program.soup = subdivided(program.soup);
            const int handles = kind == 5 ? 1 : 1 + program.choice % 3;
            punch(program.soup, handles + (shape == 1), program.choice);  // what is open is no handle
        }
        program.soup = doubled(program.soup, shape == 1);
        clean(program.soup);
    }
    ExecutionContext context;
    try {
        check_domain(program.soup, kind, context);
    } catch (const KoebeError& error) {
        const std::size_t most = std::max(program.soup.points.size(), program.soup.faces.size());
        const auto* topology = dynamic_cast<const TopologyError*>(&error);
        require(dynamic_cast<const Cancelled*>(&error) == nullptr, "nobody cancelled");
        require(kind < 8 || !topology, "parts take any topology: " + std::string(error.what()));
        if (topology)
            for (const Index element : error.elements())
                require(element >= 0 && static_cast<std::size_t>(element) < most, "an error's elements exist");
    }
}

}  // namespace koebe::fuzz
