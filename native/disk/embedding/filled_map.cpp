#include "embedding/filled_map.h"

#include "circles/circle_projection.h"
#include "circles/moebius.h"
#include "circles/on_circle.h"
#include "core/numbering.h"
#include "core/uv_resolution.h"
#include "embedding/widened_rim.h"
#include "planar/planar_predicates.h"
#include "quality/stored_uv.h"

#include <Eigen/Dense>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <utility>

namespace koebe {
namespace {

constexpr double area_rounding = 3e-7;  // twice the area a face can lose by rounding, over its longest edge, disk units
constexpr double ample = 1e-4;          // of the mean area: a larger face has room
constexpr int most_cautions = 4;
// Relative decreases of the energy. The vertex for 0 gets there only when faces have made room.
constexpr double settled_without_center = 3e-4, settled_with_center = 1e-5;
constexpr int rings_that_move = 8;  // round places that are replaced

/// Whether wrong faces are so few that the rest of the map is worth keeping.
bool is_small_share(std::ptrdiff_t wrong, std::size_t all) { return 200 * wrong < static_cast<std::ptrdiff_t>(all); }

Eigen::RowVector2d middle_of_edges(const VertexLoop& loop, const PlanarPoints& uv)
{
    Eigen::RowVector2d sum = Eigen::RowVector2d::Zero();
    double around = 0.0;
    for (std::size_t i = 0; i < loop.size(); ++i) {
        const Eigen::RowVector2d from = uv.row(loop[i]), to = uv.row(loop[(i + 1) % loop.size()]);
        const double length = (to - from).norm();
        sum += 0.5 * length * (from + to);
        around += length;
    }
    return around > 0.0 ? Eigen::RowVector2d(sum / around) : Eigen::RowVector2d(uv.row(loop[0]));
}

}  // namespace

FilledMap::FilledMap(const Vertices& vertices, const Surface& surface, const std::vector<VertexLoop>& loops,
                     const std::vector<Ear>& ears, FixedPlaces places)
    : vertices_(vertices),
      surface_(surface),
      loops_(loops),
      filled_(fill_with_fans(surface, loops)),
      around_(filled_.vertex_count),
      loop_of_(filled_.vertex_count, -1),
      pulled_(filled_.vertex_count, 0),
      caution_(filled_.triangles.rows(), 1.0),
      places_(places),
      now_{{}, std::vector(filled_.vertex_count, Mobility::free), std::vector<Circle>(loops.size())},
      faces_(numbers_below(surface.triangles.rows()))
{
    for (std::size_t k = 0; k < loops.size(); ++k)
        for (const Index v : loops[k]) {
            loop_of_[v] = static_cast<int>(k);
            pulled_[v] = k > 0;
            if (k == 0) now_.mobility[v] = v == places.point ? Mobility::held : Mobility::sliding;
        }
    for (const Ear& ear : ears)
        for (const Index v : ear.rim) pulled_[v] = 0;
    for (Eigen::Index f = 0; f < filled_.triangles.rows(); ++f)
        for (const Index v : filled_.triangles.row(f)) around_[v].push_back(static_cast<Index>(f));
}

FilledMap::FilledMap(const Vertices& vertices, const Surface& surface, const std::vector<VertexLoop>& loops,
                     const std::vector<Ear>& ears, const VectorXcd& rim, FixedPlaces places,
                     const ExecutionContext& context)
    : FilledMap(vertices, surface, loops, ears, places)
{
    start(rim, context);
    if (places_.center >= 0) bring_to_center(context);
}

FilledMap::FilledMap(const Vertices& vertices, const Surface& surface, const std::vector<VertexLoop>& loops,
                     const std::vector<Ear>& ears, const CircleMap& map, FixedPlaces places,
                     const ExecutionContext& context)
    : FilledMap(vertices, surface, loops, ears, places)
{
    // The holes' fans lie round the middles of their edges, which are inside where all vertices are on the circle.
    PlanarPoints points(filled_.vertex_count, 2);
    points.topRows(surface.vertex_count) = map.uv;
    for (std::size_t k = 1; k < loops.size(); ++k) points.row(fan_centre(k)) = middle_of_edges(loops[k], map.uv);
    now_.points = std::move(points);
    now_.circles = map.circles;
    // Wrong places are replaced, and only vertices near them will move.
    std::optional<MendedDrawing> mended;
    std::vector<char> wrong = wrong_faces();
    if (is_small_share(std::ranges::count(wrong, 1), wrong.size()))
        mended = mend_drawing(filled_, loops[0], now_.points, std::move(wrong), context);
    if (!mended || std::ranges::binary_search(mended->replaced, places.center)) {
        now_.points.resize(0, 2);
        return;
    }
    now_.points = std::move(mended->points);
    hold_far_from(std::move(mended->replaced));
    for (std::size_t k = 1; k < loops.size(); ++k)
        for (const Index v : loops[k])
            if (pulled_[v] && is_on_circle(now_.circles[k], at(v), inner_circle_tolerance))
                now_.mobility[v] = Mobility::sliding;
}

/// Faces of the surface that are flipped as stored, and fans that are not upright.
std::vector<char> FilledMap::wrong_faces() const
{
    std::vector<char> wrong(filled_.triangles.rows());
    for (Eigen::Index f = 0; f < filled_.triangles.rows(); ++f) {
        const StoredFace face(filled_.triangles, now_.points, f);
        wrong[f] = f < surface_.triangles.rows() ? face.doubtful() && !face.below_resolution() : !(area(f) > 0.0);
    }
    return wrong;
}

/// Holds all vertices but some, and the rings around these. @param moving the vertices that move
void FilledMap::hold_far_from(std::vector<Index> moving)
{
    still_.assign(filled_.vertex_count, 1);
    for (const Index v : moving) still_[v] = 0;
    std::size_t begin = 0;
    for (int ring = 0; ring < rings_that_move; ++ring)
        for (const std::size_t end = moving.size(); begin < end; ++begin)
            for (const Index f : around_[moving[begin]])
                for (const Index w : filled_.triangles.row(f))
                    if (std::exchange(still_[w], 0)) moving.push_back(w);
    for (const Index v : {places_.center, places_.point})
        if (v >= 0) still_[v] = 1;
    std::erase_if(faces_, [&](Index f) { return !moves(f); });
}

/// Whether a corner of the face moves.
bool FilledMap::moves(Eigen::Index f) const
{
    return still_.empty() || !still_[filled_.triangles(f, 0)] || !still_[filled_.triangles(f, 1)] ||
           !still_[filled_.triangles(f, 2)];
}

/// The rim turned so that the vertex for 1 is at 1.
VectorXcd FilledMap::placed_rim(VectorXcd rim) const
{
    if (places_.point < 0) return rim;
    const auto place = std::ranges::find(loops_[0], places_.point) - loops_[0].begin();
    rim *= std::conj(rim[place]) / std::abs(rim[place]);
    rim[place] = 1.0;
    return rim;
}

void FilledMap::start(const VectorXcd& rim, const ExecutionContext& context)
{
    PlanarPoints best;
    Eigen::Index fewest = filled_.triangles.rows() + 1;
    for (const double share : {0.0, 0.3, 1.0}) {
        if (places_.center >= 0 && share < 1.0) continue;  // the given rim may leave no room for the middle
        const VectorXcd wider = share > 0.0 ? widened_rim(filled_, loops_[0], rim, share, places_.center) : rim;
        now_.points = convex_embedding(filled_, loops_[0], placed_rim(wider), context);
        const double least = ample * std::numbers::pi / static_cast<double>(filled_.triangles.rows());
        Eigen::Index poor = 0;
        for (Eigen::Index f = 0; f < filled_.triangles.rows(); ++f) poor += !right(f) || !(area(f) > least);
        if (poor < fewest) {
            fewest = poor;
            best = now_.points;
        }
        if (poor == 0) break;
    }
    now_.points = std::move(best);
}

double FilledMap::area(Eigen::Index f) const
{
    const Complex a = at(filled_.triangles(f, 0));
    return 0.5 * cross(at(filled_.triangles(f, 1)) - a, at(filled_.triangles(f, 2)) - a);
}

double FilledMap::longest_edge(Eigen::Index f) const
{
    const Complex a = at(filled_.triangles(f, 0)), b = at(filled_.triangles(f, 1)), c = at(filled_.triangles(f, 2));
    return std::max({std::abs(b - a), std::abs(c - b), std::abs(a - c)});
}

bool FilledMap::right(Eigen::Index f) const
{
    if (!(area(f) > 0.0)) return false;
    if (f >= surface_.triangles.rows()) return true;
    const StoredFace face(filled_.triangles, now_.points, f);
    return !face.flipped() || face.below_resolution();
}

std::vector<char> FilledMap::right_faces() const
{
    std::vector<char> result(filled_.triangles.rows());
    for (Eigen::Index f = 0; f < filled_.triangles.rows(); ++f) result[f] = right(f);
    return result;
}

bool FilledMap::star_right(Index vertex, const std::vector<char>& was_right) const
{
    return std::all_of(around_[vertex].begin(), around_[vertex].end(),
                       [&](Index f) { return !was_right[f] || right(f); });
}

/// A sector of a regular polygon, with a given area.
Eigen::Matrix2d FilledMap::fan_reference(Eigen::Index f, double area) const
{
    const auto corners = static_cast<double>(around_[filled_.triangles(f, 2)].size());
    const double angle = 2.0 * std::numbers::pi / corners;
    Eigen::Matrix2d edges;
    edges << std::cos(angle) - 1.0, -1.0, std::sin(angle), 0.0;
    return edges * std::sqrt(2.0 * area / edges.determinant());
}

/// Poses the problem. Wrong faces are left out, and their corners are held.
FoldoverProblem FilledMap::problem(Pull pull) const
{
    FoldoverProblem problem;
    problem.points = now_.points;
    problem.mobility = now_.mobility;
    for (std::size_t v = 0; v < still_.size(); ++v)
        if (still_[v]) problem.mobility[v] = Mobility::held;
    // Faces that have lost their area to rounding take no part, and hold their corners. Faces of the surface want their
    // shape on it, faces of the fans a regular one; a floor keeps the area that 32 bits need.
    const PatchShapes shapes = patch_shapes(vertices_, surface_.triangles, now_.points, faces_, pull.shape);
    std::vector<Index> taken;
    std::vector<double> floors, weights;
    Eigen::Index row = 0;  // in shapes
    for (Eigen::Index f = 0; f < filled_.triangles.rows(); ++f) {
        if (!moves(f)) continue;
        const Eigen::Index shape = row++;
        const double now = area(f), longest = longest_edge(f);
        if (!(now > 1e-15 * longest * longest) || !(now > 1e-200)) {
            for (int k = 0; k < 3; ++k) problem.mobility[filled_.triangles(f, k)] = Mobility::held;
            continue;
        }
        const bool fan = f >= surface_.triangles.rows();
        taken.push_back(static_cast<Index>(f));
        problem.reference.push_back(fan ? fan_reference(f, now) : shapes.references[shape]);
        const double floor = fan ? 0.0 : std::min(0.5 * caution_[f] * area_rounding * longest, 0.5 * now);
        floors.push_back(floor / (fan ? now : shapes.areas[shape]));
        weights.push_back(fan ? pull.regular : 1.0);
    }
    problem.triangles = filled_.triangles(taken, Eigen::all);
    problem.floor = Eigen::Map<const VectorXd>(floors.data(), static_cast<Eigen::Index>(floors.size()));
    problem.weight = Eigen::Map<const VectorXd>(weights.data(), static_cast<Eigen::Index>(weights.size()));
    // Loops on their circles, and the centres of fans and of the map drawn to their places.
    problem.circles.resize(filled_.vertex_count);
    for (Index v = 0; v < filled_.surface_vertices; ++v)
        if (loop_of_[v] >= 0) problem.circles[v] = now_.circles[loop_of_[v]];
    if (pull.rim > 0.0 || pull.centre > 0.0 || pull.place > 0.0) {
        problem.pull = VectorXd::Zero(filled_.vertex_count);
        for (Index v = 0; v < filled_.surface_vertices; ++v) problem.pull[v] = pulled_[v] ? pull.rim : 0.0;
        problem.pull_inside.assign(filled_.vertex_count, 0);
        for (std::size_t k = 1; k < loops_.size(); ++k) {
            problem.circles[fan_centre(k)] = now_.circles[k];
            problem.pull[fan_centre(k)] = pull.centre;
            problem.pull_inside[fan_centre(k)] = 1;
        }
        if (places_.center >= 0) {
            problem.circles[places_.center] = Circle{};
            problem.pull[places_.center] = pull.place;
            problem.pull_inside[places_.center] = 1;
        }
    }
    return problem;
}

void FilledMap::relax(Pull pull, int iterations, const ExecutionContext& context)
{
    const std::vector<char> was_right = right_faces();
    const PlanarPoints before = now_.points;
    for (int attempt = 0; attempt < most_cautions; ++attempt) {
        FoldoverProblem moving = problem(pull);
        const FoldoverResult moved =
            minimize_foldover_free(moving, context,
                                   {.max_iterations = iterations,
                                    .settled = places_.center < 0 ? settled_without_center : settled_with_center,
                                    .strict = true});
        work_ += static_cast<std::size_t>(moved.iterations) * static_cast<std::size_t>(moving.triangles.rows());
        bool kept = moving.points.allFinite();
        if (kept) {
            now_.points = std::move(moving.points);
            kept = run_once_round(image_of(0), 1);  // upright faces may overlap at a rim that turns back
            for (Eigen::Index f = 0; f < filled_.triangles.rows(); ++f)
                if (was_right[f] && !right(f)) {
                    kept = false;
                    caution_[f] *= 4.0;
                }
        }
        if (kept) return;
        now_.points = before;
        iterations = std::max(1, iterations / 2);
    }
}

Complex FilledMap::on_circle(Index vertex) const
{
    const Circle& circle = now_.circles[loop_of_[vertex]];
    const Complex arm = at(vertex) - circle.center;
    return circle.center + circle.radius / std::max(std::abs(arm), 1e-300) * arm;
}

int FilledMap::snap()
{
    const std::vector<char> was_right = right_faces();
    const PlanarPoints before = now_.points;
    std::vector<Index> moved;
    for (Index v = 0; v < filled_.surface_vertices; ++v)
        if (pulled_[v] && now_.mobility[v] == Mobility::free) moved.push_back(v);
    const auto put = [&](Index v, Complex place) { now_.points.row(v) << place.real(), place.imag(); };
    for (const Index v : moved) put(v, on_circle(v));
    // Return the vertices at wrong faces until there is no wrong face; then move them one by one.
    std::vector<Index> back;
    for (bool again = true; again;) {
        again = std::erase_if(moved, [&](Index v) {
                    if (star_right(v, was_right)) return false;
                    now_.points.row(v) = before.row(v);
                    back.push_back(v);
                    return true;
                }) > 0;
    }
    for (const Index v : back) {
        put(v, on_circle(v));
        if (star_right(v, was_right))
            moved.push_back(v);
        else
            now_.points.row(v) = before.row(v);
    }
    for (const Index v : moved) now_.mobility[v] = Mobility::sliding;
    int off = 0;
    for (Index v = 0; v < filled_.surface_vertices; ++v) off += pulled_[v] && now_.mobility[v] == Mobility::free;
    return off;
}

void FilledMap::release(std::size_t loop)
{
    for (const Index v : loops_[loop]) now_.mobility[v] = Mobility::free;
}

void FilledMap::let_rim_slide(bool slides)
{
    for (const Index v : loops_[0])
        now_.mobility[v] = slides && v != places_.point ? Mobility::sliding : Mobility::held;
}

VectorXcd FilledMap::image_of(std::size_t loop) const
{
    VectorXcd image(static_cast<Eigen::Index>(loops_[loop].size()));
    for (std::size_t i = 0; i < loops_[loop].size(); ++i) image[static_cast<Eigen::Index>(i)] = at(loops_[loop][i]);
    return image;
}

Roundness FilledMap::roundness_of(std::size_t loop) const
{
    VectorXcd image = image_of(loop);
    Eigen::Index count = 0;
    for (std::size_t i = 0; i < loops_[loop].size(); ++i)
        if (loop == 0 || pulled_[loops_[loop][i]]) image[count++] = image[static_cast<Eigen::Index>(i)];
    return roundness(image.head(count), now_.circles[loop]);
}

std::vector<Index> FilledMap::off_circle(std::size_t loop, bool pulled) const
{
    std::vector<Index> off;
    for (const Index v : loops_[loop])
        if ((!pulled || pulled_[v]) && !is_on_circle(now_.circles[loop], at(v), inner_circle_tolerance))
            off.push_back(v);
    return off;
}

}  // namespace koebe
