#include "lift/filled_sheet.h"

#include "lift/pattern_place.h"
#include "planar/divided_polygon.h"
#include "planar/planar_predicates.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <set>

namespace koebe {
namespace {

/// A polygon of the plane with vertices of the mesh.
struct GapPolygon {
    std::vector<Index> vertices;
    std::vector<Complex> places;

    void add(Index vertex, Complex place)
    {
        vertices.push_back(vertex);
        places.push_back(place);
    }
};

/// A loop of the surface in one chart, the surface on its left.
struct LoopInChart {
    GapPolygon points;
    Complex closing{0.0, 0.0};  // from its start to its end
};

double twice_area_of(const std::vector<Complex>& polygon)
{
    double sum = 0.0;
    for (std::size_t i = 0; i < polygon.size(); ++i)
        sum += cross(polygon[i] - polygon[0], polygon[(i + 1) % polygon.size()] - polygon[0]);
    return sum;
}

/// Follows a loop. @param met (3F) marks its half-edges @return nothing if a cut divides it
std::optional<LoopInChart> loop_in_chart(const FlatSheet& sheet, Index first, std::vector<char>& met)
{
    LoopInChart loop;
    Complex offset = 0.0;
    bool divided = false;
    Index h = first;
    do {
        met[h] = 1;
        loop.points.add(origin(sheet.triangles, h), sheet.uv[h] + offset);
        h = next_halfedge(h);
        while (sheet.twin[h] != no_twin) {
            divided |= sheet.border[h] != 0;
            offset -= sheet.step[h];
            h = next_halfedge(sheet.twin[h]);
        }
    } while (h != first);
    loop.closing = sheet.uv[h] + offset - loop.points.places[0];
    if (divided) return {};
    return loop;
}

class Filling {
public:
    explicit Filling(const FlatSheet& sheet) : sheet_(sheet), count_(static_cast<Index>(sheet.vertices.rows()))
    {
        std::vector<char> at_loop(count_, 0);
        for (Index h = 0; h < static_cast<Index>(sheet.twin.size()); ++h)
            if (sheet.twin[h] == no_twin) at_loop[origin(sheet.triangles, h)] = 1;
        for (Index h = 0; h < static_cast<Index>(sheet.twin.size()); ++h) {
            const Index a = origin(sheet.triangles, h), b = target(sheet.triangles, h);
            if (sheet.twin[h] != no_twin && at_loop[a] && at_loop[b]) edges_.insert({std::min(a, b), std::max(a, b)});
        }
        box_ = box_around(sheet.uv);
        beyond_ = std::max(box_.size().real(), box_.size().imag());
    }

    void fill_gap(const LoopInChart& loop)
    {
        if (loop.closing != 0.0)
            beyond_rim(loop);
        else if (const double area = twice_area_of(loop.points.places); area < 0.0)
            fill_hole(loop.points);
        else if (area > 0.0 && sheet_.periods.empty() && std::ranges::max(sheet_.sheet) == 0)
            around_outer(loop.points);
    }

    FlatSheet result() const
    {
        const Eigen::Index faces = sheet_.triangles.rows(), more = static_cast<Eigen::Index>(corners_.size() / 3);
        const Eigen::Index added = static_cast<Eigen::Index>(places_.size());
        Vertices vertices(sheet_.vertices.rows() + added, 3);
        vertices.topRows(sheet_.vertices.rows()) = sheet_.vertices;
        for (Eigen::Index v = 0; v < added; ++v)
            vertices.row(sheet_.vertices.rows() + v) << places_[v].real(), places_[v].imag(), 0.0;
        Triangles triangles(faces + more, 3);
        triangles.topRows(faces) = sheet_.triangles;
        triangles.bottomRows(more) = Eigen::Map<const Triangles>(corners_.data(), more, 3);
        std::vector<Complex> uv = sheet_.uv;
        uv.insert(uv.end(), uv_.begin(), uv_.end());
        FlatSheet filled = flat_sheet(vertices, triangles, planar_points(uv), sheet_.grid, sheet_.periods);
        filled.gap.assign(faces, -1);
        filled.gap.insert(filled.gap.end(), gap_.begin(), gap_.end());
        filled.area = sheet_.area;
        filled.mean_scale = sheet_.mean_scale;
        filled.grade = sheet_.grade;
        if (!filled.grade.empty()) filled.grade.resize(vertices.rows(), 1.0);
        filled.scale = sheet_.scale;
        filled.scale.resize(vertices.rows(), sheet_.mean_scale);
        filled.normals.topRows(sheet_.vertices.rows()) = sheet_.normals;
        return filled;
    }

private:
    Index new_vertex(Complex place)
    {
        places_.push_back(place);
        return count_ + static_cast<Index>(places_.size()) - 1;
    }

    double on_grid(double x) const { return sheet_.grid > 0.0 ? std::round(x / sheet_.grid) * sheet_.grid : x; }

    /// Adds the triangles of polygons, if no edge inside is an edge of the mesh already.
    void add_polygons(const std::vector<GapPolygon>& polygons)
    {
        std::vector<Index> corners;
        std::vector<Complex> uv;
        std::set<std::array<Index, 2>> inside;
        // All or nothing: cut up each polygon, and note its inner edges.
        for (const GapPolygon& polygon : polygons) {
            const Triangles faces = divided_polygon(polygon.places, {}, {});
            const Index n = static_cast<Index>(polygon.places.size());
            if (faces.rows() != n - 2) return;
            for (Index h = 0; h < static_cast<Index>(faces.size()); ++h) {
                const Index i = origin(faces, h), j = target(faces, h);
                const Index a = polygon.vertices[i], b = polygon.vertices[j];
                if (a == b) return;
                const std::array<Index, 2> edge{std::min(a, b), std::max(a, b)};
                if (j != (i + 1) % n && i != (j + 1) % n && i < j &&
                    (edges_.contains(edge) || !inside.insert(edge).second))
                    return;
                corners.push_back(a);
                uv.push_back(polygon.places[i]);
            }
        }
        // Nothing was wrong: add all.
        edges_.merge(inside);
        corners_.insert(corners_.end(), corners.begin(), corners.end());
        uv_.insert(uv_.end(), uv.begin(), uv.end());
        gap_.resize(corners_.size() / 3, number_++);
    }

    void fill_hole(GapPolygon loop)
    {
        std::ranges::reverse(loop.vertices);
        std::ranges::reverse(loop.places);
        add_polygons({loop});
    }

    /// Two polygons, above and below a counter-clockwise loop, up to a box around.
    void around_outer(const GapPolygon& loop)
    {
        const auto less = [](Complex a, Complex b) { return a.real() < b.real(); };
        const auto least = std::ranges::min_element(loop.places, less),
                   most = std::ranges::max_element(loop.places, less);
        const std::size_t n = loop.places.size(), left = static_cast<std::size_t>(least - loop.places.begin());
        const std::size_t right = static_cast<std::size_t>(most - loop.places.begin());
        const double low = box_.low.imag() - beyond_, high = box_.high.imag() + beyond_;
        const Complex left_side(box_.low.real() - beyond_, least->imag());
        const Complex right_side(box_.high.real() + beyond_, most->imag());
        const Index at_left = new_vertex(left_side), at_right = new_vertex(right_side);
        const auto half = [&](std::size_t from, Complex from_side, Index at_from, std::size_t to, Complex to_side,
                              Index at_to, double y) {  // `from` and `to` as the void's side of the loop runs
            GapPolygon polygon;
            polygon.add(loop.vertices[from], loop.places[from]);
            polygon.add(at_from, from_side);
            for (const Complex corner : {Complex(from_side.real(), y), Complex(to_side.real(), y)})
                polygon.add(new_vertex(corner), corner);
            polygon.add(at_to, to_side);
            for (std::size_t i = to; i != from; i = (i + n - 1) % n) polygon.add(loop.vertices[i], loop.places[i]);
            return polygon;
        };
        add_polygons({half(right, right_side, at_right, left, left_side, at_left, high),
                      half(left, left_side, at_left, right, right_side, at_right, low)});
    }

    /// The strip beyond a rim of a ring, one period wide.
    void beyond_rim(const LoopInChart& loop)
    {
        constexpr int pieces = 8;
        const bool lower = loop.closing.real() > 0.0;  // the surface lies above
        if (sheet_.periods.size() != 1 || loop.closing != (lower ? sheet_.periods[0] : -sheet_.periods[0])) return;
        const double way = lower ? 1.0 : -1.0;  // half a turn makes the upper rim a lower one
        const std::size_t n = loop.points.places.size();
        const auto height = [&](std::size_t i) { return way * loop.points.places[i].imag(); };
        std::size_t first = 0;
        for (std::size_t i = 1; i < n; ++i)
            if (height(i) < height(first)) first = i;
        GapPolygon polygon;
        for (std::size_t k = n + 1; k-- > 0;) {
            const std::size_t i = (first + k) % n, turns = (first + k) / n;
            polygon.add(loop.points.vertices[i], loop.points.places[i] + static_cast<double>(turns) * loop.closing);
        }
        const double y = on_grid((lower ? box_.low.imag() : box_.high.imag()) - way * beyond_);
        const double x = loop.points.places[first].real();
        const Index corner = new_vertex({x, y});
        for (int k = 0; k < pieces; ++k) {
            const Complex place(on_grid(x + k * loop.closing.real() / pieces), y);
            polygon.add(k == 0 ? corner : new_vertex(place), k == 0 ? Complex(x, y) : place);
        }
        polygon.add(corner, Complex(x, y) + loop.closing);
        add_polygons({polygon});
    }

    const FlatSheet& sheet_;
    Index count_, number_ = 0;
    PlaneBox box_;
    double beyond_ = 0.0;
    std::set<std::array<Index, 2>> edges_;  // between vertices of loops
    std::vector<Complex> places_;           // of new vertices
    std::vector<Index> corners_, gap_;
    std::vector<Complex> uv_;
};

}  // namespace

FlatSheet filled_sheet(const FlatSheet& sheet)
{
    Filling filling(sheet);
    std::vector<char> met(sheet.twin.size(), 0);
    for (Index h = 0; h < static_cast<Index>(sheet.twin.size()); ++h)
        if (sheet.twin[h] == no_twin && !met[h])
            if (const std::optional<LoopInChart> loop = loop_in_chart(sheet, h, met)) filling.fill_gap(*loop);
    return filling.result();
}

}  // namespace koebe
