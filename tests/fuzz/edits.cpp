#include "edits.h"

#include "random.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <numeric>
#include <optional>
#include <utility>

namespace koebe::fuzz {
namespace {

struct Corner {
    std::size_t face;
    int corner;
};

Corner corner_of(const Soup& soup, std::size_t number)
{
    return {number / 3 % soup.faces.size(), static_cast<int>(number % 3)};
}

Index vertex(const Soup& soup, Corner c, int next = 0) { return soup.faces[c.face][(c.corner + next) % 3]; }

/// The face on the other side of the edge that starts at a corner, by the corner it starts at there.
std::optional<Corner> across(const Soup& soup, Corner c)
{
    const Index from = vertex(soup, c), to = vertex(soup, c, 1);
    for (std::size_t f = 0; f < soup.faces.size(); ++f)
        for (int k = 0; k < 3; ++k)
            if (soup.faces[f][k] == to && soup.faces[f][(k + 1) % 3] == from) return Corner{f, k};
    return std::nullopt;
}

/// The first edge without a face on its other side, from the corner of that number on.
std::optional<Corner> rim_edge(const Soup& soup, std::size_t number)
{
    const std::size_t count = 3 * soup.faces.size();
    for (std::size_t i = 0; i < count; ++i)
        if (const Corner c = corner_of(soup, (number + i) % count); !across(soup, c)) return c;
    return std::nullopt;
}

bool has_vertex(const Soup& soup, Index v) { return v >= 0 && v < static_cast<Index>(soup.points.size()); }

Index add_point(Soup& soup, const std::array<double, 3>& p)
{
    soup.points.push_back(p);
    return static_cast<Index>(soup.points.size()) - 1;
}

std::array<double, 3> point(const Soup& soup, Index v)
{
    return has_vertex(soup, v) ? soup.points[v] : std::array<double, 3>{};
}

std::array<double, 3> between(const Soup& soup, Index a, Index b, double part)
{
    std::array<double, 3> p;
    for (int k = 0; k < 3; ++k) p[k] = (1.0 - part) * point(soup, a)[k] + part * point(soup, b)[k];
    return p;
}

double factor(int amount) { return std::exp2(amount / 4.0); }

using Edit = void (*)(Soup&, const EditChoice&);

// ---------------------------------------------------------------- a surface stays one, as a rule

void flip_edge(Soup& soup, const EditChoice& e)
{
    const Corner c = corner_of(soup, e.a);
    const std::optional<Corner> other = across(soup, c);
    if (!other) return;
    const Index from = vertex(soup, c), to = vertex(soup, c, 1);
    const Index tip = vertex(soup, c, 2), other_tip = vertex(soup, *other, 2);
    soup.faces[c.face] = {tip, from, other_tip};
    soup.faces[other->face] = {other_tip, to, tip};
}

void delete_face(Soup& soup, const EditChoice& e)
{
    if (soup.faces.size() > 1)
        soup.faces.erase(soup.faces.begin() + static_cast<std::ptrdiff_t>(e.a % soup.faces.size()));
}

void delete_star(Soup& soup, const EditChoice& e)
{
    const Index v = static_cast<Index>(e.a % soup.points.size());
    Soup left = soup;
    std::erase_if(left.faces, [v](const auto& face) { return std::ranges::count(face, v) > 0; });
    if (!left.faces.empty()) soup = std::move(left);
}

void glue_ear(Soup& soup, const EditChoice& e)
{
    const std::optional<Corner> c = rim_edge(soup, e.a);
    if (!c) return;
    const Index from = vertex(soup, *c), to = vertex(soup, *c, 1), tip = vertex(soup, *c, 2);
    std::array<double, 3> p = between(soup, from, to, 0.5);
    for (int k = 0; k < 3; ++k) p[k] += e.amount / 32.0 * (p[k] - point(soup, tip)[k]);
    soup.faces.push_back({to, from, add_point(soup, p)});
}

/// A face over two edges that follow each other on the rim.
void close_corner(Soup& soup, const EditChoice& e)
{
    const std::optional<Corner> c = rim_edge(soup, e.a);
    if (!c) return;
    const Index from = vertex(soup, *c), to = vertex(soup, *c, 1);
    for (std::size_t h = 0; h < 3 * soup.faces.size(); ++h)
        if (const Corner next = corner_of(soup, h); vertex(soup, next) == to && !across(soup, next)) {
            const Index end = vertex(soup, next, 1);
            if (end != from) soup.faces.push_back({to, from, end});
            return;
        }
}

void stack_vertex(Soup& soup, const EditChoice& e)
{
    const std::size_t f = e.a % soup.faces.size();
    const auto [a, b, c] = soup.faces[f];
    std::array<double, 3> p = between(soup, a, b, 0.5);
    for (int k = 0; k < 3; ++k) p[k] += (p[k] - point(soup, c)[k]) * (e.amount - 40) / 120.0;
    const Index v = add_point(soup, p);
    soup.faces[f] = {a, b, v};
    soup.faces.push_back({b, c, v});
    soup.faces.push_back({c, a, v});
}

void split_edge(Soup& soup, const EditChoice& e)
{
    const Corner c = corner_of(soup, e.a);
    const std::optional<Corner> other = across(soup, c);
    const Index from = vertex(soup, c), to = vertex(soup, c, 1), tip = vertex(soup, c, 2);
    const Index middle = add_point(soup, between(soup, from, to, 0.5 + e.amount / 260.0));
    soup.faces[c.face] = {from, middle, tip};
    soup.faces.push_back({middle, to, tip});
    if (!other) return;
    const Index other_tip = vertex(soup, *other, 2);
    soup.faces[other->face] = {to, middle, other_tip};
    soup.faces.push_back({middle, from, other_tip});
}

void collapse_edge(Soup& soup, const EditChoice& e)
{
    const Corner c = corner_of(soup, e.a);
    const Index from = vertex(soup, c), to = vertex(soup, c, 1);
    Soup left = soup;
    for (auto& face : left.faces) std::ranges::replace(face, from, to);
    std::erase_if(left.faces,
                  [](const auto& face) { return face[0] == face[1] || face[1] == face[2] || face[2] == face[0]; });
    if (!left.faces.empty()) soup = std::move(left);
}

void stretch(Soup& soup, const EditChoice& e)
{
    for (auto& p : soup.points) p[e.a % 3] *= factor(e.amount);
}

void scale(Soup& soup, const EditChoice& e)
{
    for (auto& p : soup.points)
        for (double& x : p) x *= std::exp2(e.a % 8 == 0 ? 8.0 * e.amount : e.amount / 2.0);
}

void move_vertex(Soup& soup, const EditChoice& e) { soup.points[e.a % soup.points.size()][e.b % 3] += e.amount / 64.0; }

void rough(Soup& soup, const EditChoice& e)
{
    Random random(e.a * 65536 + e.b);
    for (auto& p : soup.points)
        for (double& x : p) x += 0.1 * factor(e.amount) * random.symmetric();
}

void coincide(Soup& soup, const EditChoice& e)
{
    const std::size_t a = e.a % soup.points.size(), b = e.b % soup.points.size();
    soup.points[a] = between(soup, static_cast<Index>(a), static_cast<Index>(b),
                             e.amount == 0 ? 1.0 : 1.0 - factor(-std::abs(e.amount)));
}

void flatten(Soup& soup, const EditChoice& e)
{
    for (auto& p : soup.points) p[e.a % 3] = e.amount % 2 ? p[(e.a + 1) % 3] : 0.0;
}

void renumber(Soup& soup, const EditChoice& e)
{
    Random random(e.a * 65536 + e.b);
    std::vector<Index> place(soup.points.size());
    std::iota(place.begin(), place.end(), 0);
    for (std::size_t i = place.size(); i > 1; --i) std::swap(place[i - 1], place[random.below(i)]);
    Soup result = soup;
    for (std::size_t v = 0; v < place.size(); ++v) result.points[place[v]] = soup.points[v];
    for (auto& face : result.faces)
        for (Index& v : face)
            if (has_vertex(soup, v)) v = place[v];
    for (std::size_t i = result.faces.size(); i > 1; --i) std::swap(result.faces[i - 1], result.faces[random.below(i)]);
    soup = std::move(result);
}

void turn_corners(Soup& soup, const EditChoice& e)
{
    auto& face = soup.faces[e.a % soup.faces.size()];
    std::rotate(face.begin(), face.begin() + 1, face.end());
}

void unused_vertex(Soup& soup, const EditChoice& e)
{
    soup.points.insert(soup.points.begin(), {1.0 * e.amount, 0.0, 0.0});
    for (auto& face : soup.faces)
        for (Index& v : face)
            if (v < std::numeric_limits<Index>::max()) ++v;
}

// ---------------------------------------------------------------- what a mesh must have is broken

void reverse_face(Soup& soup, const EditChoice& e)
{
    auto& face = soup.faces[e.a % soup.faces.size()];
    std::swap(face[0], face[1]);
}

void reverse_all(Soup& soup, const EditChoice&)
{
    for (auto& face : soup.faces) std::swap(face[0], face[1]);
}

void glue_face(Soup& soup, const EditChoice& e)
{
    const Corner c = corner_of(soup, e.a);
    const Index v = static_cast<Index>(e.b % soup.points.size());
    soup.faces.push_back({vertex(soup, c, 1), vertex(soup, c), v});
}

void duplicate_face(Soup& soup, const EditChoice& e) { soup.faces.push_back(soup.faces[e.a % soup.faces.size()]); }

/// A copy of a corner's vertex, which some of its faces take.
void duplicate_vertex(Soup& soup, const EditChoice& e)
{
    const Corner c = corner_of(soup, e.a);
    const Index v = vertex(soup, c);
    if (!has_vertex(soup, v)) return;
    const Index copy = add_point(soup, point(soup, v));
    for (std::size_t f = 0; f < soup.faces.size(); ++f)
        if (f == c.face || (e.b >> (f % 16)) % 2) std::ranges::replace(soup.faces[f], v, copy);
}

void merge_vertices(Soup& soup, const EditChoice& e)
{
    const Index a = static_cast<Index>(e.a % soup.points.size()), b = static_cast<Index>(e.b % soup.points.size());
    for (auto& face : soup.faces) std::ranges::replace(face, a, b);
}

void second_component(Soup& soup, const EditChoice& e)
{
    const std::size_t count = std::min<std::size_t>(soup.faces.size(), 1 + e.b % 8);
    const Index shift = static_cast<Index>(soup.points.size());
    const std::vector<std::array<double, 3>> copy = soup.points;
    soup.points.insert(soup.points.end(), copy.begin(), copy.end());
    for (std::size_t f = 0; f < count; ++f) {
        auto face = soup.faces[f];
        for (Index& v : face)
            if (v >= 0 && v < shift) v += shift;
        soup.faces.push_back(face);
    }
}

void odd_coordinate(Soup& soup, const EditChoice& e)
{
    using Limits = std::numeric_limits<double>;
    constexpr double odd[] = {Limits::quiet_NaN(),
                              Limits::infinity(),
                              -Limits::infinity(),
                              Limits::max(),
                              Limits::denorm_min(),
                              -0.0,
                              1e160,
                              1e-160,
                              1e20,
                              1e-20};
    soup.points[e.a % soup.points.size()][e.b % 3] = odd[static_cast<unsigned>(e.amount + 128) % std::size(odd)];
}

void odd_index(Soup& soup, const EditChoice& e)
{
    const Index count = static_cast<Index>(soup.points.size());
    const Index odd[] = {-1, count,  count - 1, std::numeric_limits<Index>::max(), std::numeric_limits<Index>::min(),
                         0,  -count, 65536};
    soup.faces[e.a % soup.faces.size()][e.b % 3] = odd[static_cast<unsigned>(e.amount + 128) % std::size(odd)];
}

void cut_points(Soup& soup, const EditChoice& e) { soup.points.resize(e.a % (soup.points.size() + 1)); }

void cut_faces(Soup& soup, const EditChoice& e) { soup.faces.resize(e.a % (soup.faces.size() + 1)); }

constexpr Edit keeping[] = {flip_edge,  delete_face,   delete_star, glue_ear,     close_corner, stack_vertex,
                            split_edge, collapse_edge, stretch,     scale,        move_vertex,  rough,
                            coincide,   flatten,       renumber,    turn_corners, unused_vertex};
constexpr Edit breaking[] = {reverse_face,     reverse_all,    glue_face,        duplicate_face,
                             duplicate_vertex, merge_vertices, second_component, odd_coordinate,
                             odd_index,        cut_points,     cut_faces};

}  // namespace

int first_breaking_edit() { return static_cast<int>(std::size(keeping)); }

int edit_kind_count() { return static_cast<int>(std::size(keeping) + std::size(breaking)); }

void edit(Soup& soup, const EditChoice& choice, const Limits& limits)
{
    if (soup.points.empty() || soup.faces.empty()) return;
    const int kind = choice.kind % edit_kind_count();
    const Edit run = kind < first_breaking_edit() ? keeping[kind] : breaking[kind - first_breaking_edit()];
    if (soup.faces.size() >= limits.faces && run != delete_face && run != flip_edge && run != collapse_edge) return;
    run(soup, choice);
}

}  // namespace koebe::fuzz
