#include "report/svg.h"

#include "core/sort_unique.h"
#include "report/edge_trails.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <numeric>
#include <string_view>

namespace koebe {
namespace {

constexpr double disk_radius = 4800.0;  // picture units: a unit is 1/9600 of the disk's width
constexpr double center = 5000.0;
constexpr std::array<std::string_view, 6> loop_colors{"#c8553d", "#2a7f9e", "#d99a2b", "#5b8c5a", "#7d5ba6", "#b03a6b"};

class SvgText {
public:
    SvgText& operator<<(std::string_view word)
    {
        text_ += word;
        return *this;
    }
    SvgText& operator<<(double number)
    {
        char digits[32];
        const double rounded = std::round(10.0 * number) / 10.0;
        text_.append(digits, std::to_chars(digits, digits + sizeof digits, rounded).ptr);
        return *this;
    }
    SvgText& operator<<(Index number)
    {
        text_ += std::to_string(number);
        return *this;
    }
    std::string finish() { return std::move(text_); }

private:
    std::string text_;
};

struct Pixel {
    Index x, y;
    bool operator==(const Pixel&) const = default;
};

Pixel to_pixel(double x, double y)
{
    const auto round = [](double t) { return static_cast<Index>(std::lround(std::clamp(t, 0.0, 2.0 * center))); };
    return {round(center + disk_radius * x), round(center - disk_radius * y)};
}

bool is_drawable(const PlanarPoints& uv, Index v) { return uv.row(v).allFinite(); }

std::vector<Edge> polygon_edges(const PolygonMesh& mesh)
{
    std::vector<Edge> edges;
    edges.reserve(mesh.corners.size());
    for (Index f = 0; f < mesh.face_count(); ++f) {
        const auto face = mesh.face(f);
        for (std::size_t i = 0; i < face.size(); ++i) {
            const Index a = face[i], b = face[i + 1 < face.size() ? i + 1 : 0];
            if (a != b) edges.push_back({std::min(a, b), std::max(a, b)});
        }
    }
    sort_unique(edges);
    return edges;
}

/// One path: every trail as "M x y l dx dy …" in whole picture units, without steps of length 0.
void draw_trails(SvgText& svg, const std::vector<std::vector<Index>>& trails, const PlanarPoints& uv)
{
    for (const auto& trail : trails) {
        Pixel at = to_pixel(uv(trail[0], 0), uv(trail[0], 1));
        bool moved = false;
        for (std::size_t i = 1; i < trail.size(); ++i) {
            const Pixel to = to_pixel(uv(trail[i], 0), uv(trail[i], 1));
            if (to == at) continue;
            if (!moved) svg << "M" << at.x << " " << at.y << "l";
            const Index dx = to.x - at.x, dy = to.y - at.y;
            svg << (moved && dx >= 0 ? " " : "") << dx << (dy >= 0 ? " " : "") << dy;
            moved = true;
            at = to;
        }
    }
}

/// Edges of similar length share a stroke width, so that shrunken parts do not turn black.
void draw_wireframe(SvgText& svg, const UniformizeResult& result, const PolygonMesh& mesh)
{
    constexpr int class_count = 5;
    constexpr double shortest = disk_radius / 256.0;  // upper end of the first class; each next one is twice as long
    std::array<std::vector<Edge>, class_count> classes;
    for (const Edge& edge : polygon_edges(mesh)) {
        if (!is_drawable(result.uv, edge[0]) || !is_drawable(result.uv, edge[1])) continue;
        const double length = disk_radius * (result.uv.row(edge[0]) - result.uv.row(edge[1])).norm();
        const double octave = length > shortest ? std::ceil(std::log2(length / shortest)) : 0.0;
        classes[static_cast<std::size_t>(std::min<double>(octave, class_count - 1))].push_back(edge);
    }
    svg << "<g class=\"wire\" fill=\"none\" stroke=\"#33415c\" stroke-linejoin=\"round\" stroke-linecap=\"round\">\n";
    for (int c = 0; c < class_count; ++c) {
        if (classes[c].empty()) continue;
        svg << "<path stroke-width=\"" << 1.5 * std::pow(1.5, c) << "\" d=\"";
        draw_trails(svg, edge_trails(classes[c], static_cast<Index>(mesh.vertices.rows())), result.uv);
        svg << "\"/>\n";
    }
    svg << "</g>\n";
}

void draw_circle(SvgText& svg, const Circle& circle)
{
    svg << "<circle cx=\"" << center + disk_radius * circle.center.real() << "\" cy=\""
        << center - disk_radius * circle.center.imag() << "\" r=\"" << disk_radius * circle.radius << "\"";
}

void draw_holes(SvgText& svg, const UniformizeResult& result)
{
    svg << "<g class=\"holes\" fill=\"#ffffff\">\n";
    for (std::size_t k = 1; k < result.loops.size(); ++k) {
        const Circle& circle = result.loops[k].circle;
        draw_circle(svg, circle);
        const double width = std::clamp(0.1 * disk_radius * circle.radius, 4.0, 24.0);
        svg << " stroke=\"" << loop_colors[(k - 1) % loop_colors.size()] << "\" stroke-width=\"" << width << "\"/>\n";
    }
    svg << "</g>\n";
}

void draw_off_circle(SvgText& svg, const UniformizeResult& result)
{
    svg << "<g class=\"off-circle\" fill=\"#e01e37\">\n";
    for (const LoopReport& loop : result.loops)
        for (const Index v : loop.off_circle) {
            if (!is_drawable(result.uv, v)) continue;
            const Pixel p = to_pixel(result.uv(v, 0), result.uv(v, 1));
            svg << "<circle cx=\"" << p.x << "\" cy=\"" << p.y << "\" r=\"25\"/>\n";
        }
    svg << "</g>\n";
}

}  // namespace

std::string to_svg(const CutUniformizeResult& result, const PolygonMesh& mesh, const PlanarPoints& corner_uvs)
{
    SvgText svg;
    svg << "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 10000 10000\" width=\"1000\" height=\"1000\">\n"
        << "<title>" << static_cast<Index>(result.pieces.size()) << " pieces</title>\n"
        << "<rect width=\"10000\" height=\"10000\" fill=\"#ffffff\"/>\n";
    UniformizeResult sheet;  // with a vertex for each corner
    sheet.uv = 2.0 * corner_uvs.array() - 1.0;
    sheet.loops.emplace_back();
    svg << "<g class=\"disks\" fill=\"#f4efe6\" stroke=\"#1b2a41\" stroke-width=\"12\">\n";
    for (const MappedPiece& piece : result.pieces) {
        draw_circle(svg, piece.place);
        svg << "/>\n";
        for (std::size_t k = 1; k < piece.map.loops.size(); ++k) {
            const Circle& circle = piece.map.loops[k].circle;
            sheet.loops.emplace_back().circle = {piece.place.center + piece.place.radius * circle.center,
                                                 piece.place.radius * circle.radius};
        }
    }
    svg << "</g>\n";
    if (mesh.face_count() < wireframe_face_limit) {
        PolygonMesh corners{Vertices::Zero(corner_uvs.rows(), 3), mesh.corners, mesh.face_begin};
        std::iota(corners.corners.begin(), corners.corners.end(), 0);
        draw_wireframe(svg, sheet, corners);
    }
    draw_holes(svg, sheet);
    svg << "</svg>\n";
    return svg.finish();
}

std::string to_svg(const UniformizeResult& result, const PolygonMesh& mesh)
{
    SvgText svg;
    svg << "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 10000 10000\" width=\"1000\" height=\"1000\">\n"
        << "<title>Circle domain with " << static_cast<Index>(result.loops.size()) << " boundary loops</title>\n"
        << "<rect width=\"10000\" height=\"10000\" fill=\"#ffffff\"/>\n";
    const Circle unit;
    draw_circle(svg, unit);
    svg << " fill=\"#f4efe6\"/>\n";
    if (mesh.face_count() < wireframe_face_limit) draw_wireframe(svg, result, mesh);
    draw_holes(svg, result);
    draw_circle(svg, unit);
    svg << " fill=\"none\" stroke=\"#1b2a41\" stroke-width=\"24\"/>\n";
    draw_off_circle(svg, result);
    svg << "</svg>\n";
    return svg.finish();
}

}  // namespace koebe
