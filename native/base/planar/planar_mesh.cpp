#include "planar/planar_mesh.h"

#include "core/connectivity.h"
#include "core/errors.h"
#include "core/types.h"
#include "planar/planar_predicates.h"
#include "planar/planar_region.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <map>
#include <utility>
#include <vector>

namespace koebe {
namespace {

using detail::FaceNote;
using detail::PlanarRegion;
using detail::to_complex;
using detail::to_point;
using Cdt = PlanarRegion::Cdt;

/// size(x) = min(longest, min_v (h_v + gradation |x - v|)) over the polygons' vertices v, h_v the mean of their two
/// edges. Vertices are kept in runs along the boundary, and runs in runs of runs, with a bound for each run. So a query
/// looks at a few runs of each level, and at fewer near the place of the last query: one thread at a time may ask.
class SizeField {
public:
    SizeField(const std::vector<VectorXcd>& polygons, double longest, double gradation);
    double operator()(Complex place) const;

private:
    /// Consecutive vertices, or runs of the level below.
    struct Run {
        std::size_t begin = 0, end = 0;
        Complex center;
        double radius = 0.0;    // of a disk around center that holds the run's vertices
        double shortest = 0.0;  // least wanted length in the run
    };
    double least_in(const Run& run, Complex place) const;
    void look(std::size_t level, std::size_t begin, std::size_t end, Complex place, double& size) const;

    double longest_, gradation_;
    mutable Complex last_place_;
    mutable double last_size_ = std::numeric_limits<double>::infinity();
    std::vector<std::vector<Run>> levels_;  // vertices, runs of them, and so on; the last level is one short run
};

constexpr std::size_t run_length = 8;

SizeField::SizeField(const std::vector<VectorXcd>& polygons, double longest, double gradation)
    : longest_(longest), gradation_(gradation), levels_(1)
{
    // Lowest level: the size at each corner, the mean of its two edges.
    for (const VectorXcd& polygon : polygons)
        for (Eigen::Index i = 0, n = polygon.size(); i < n; ++i) {
            const Complex here = polygon[i];
            const double length =
                0.5 * (distance(polygon[(i + 1) % n], here) + distance(here, polygon[(i + n - 1) % n]));
            levels_[0].push_back({0, 0, here, 0.0, length});
        }
    // Each level has runs of the one below: a disk around them, and their shortest size, for bounds from below.
    while (levels_.back().size() > run_length) {
        const std::vector<Run>& below = levels_.back();
        std::vector<Run> runs;
        for (std::size_t begin = 0; begin < below.size(); begin += run_length) {
            Run run = below[begin];
            run.begin = begin;
            run.end = std::min(begin + run_length, below.size());
            for (std::size_t i = begin; i < run.end; ++i) {
                run.radius = std::max(run.radius, distance(run.center, below[i].center) + below[i].radius);
                run.shortest = std::min(run.shortest, below[i].shortest);
            }
            runs.push_back(run);
        }
        levels_.push_back(std::move(runs));
    }
}

/// A bound for the sizes wanted by a run's vertices: the size itself for one vertex.
double SizeField::least_in(const Run& run, Complex place) const
{
    return run.shortest + gradation_ * std::max(distance(place, run.center) - run.radius, 0.0);
}

/// Lowers `size` to the least size wanted by these runs of a level. The runs with the lowest bounds come first.
void SizeField::look(std::size_t level, std::size_t begin, std::size_t end, Complex place, double& size) const
{
    std::array<std::pair<double, std::size_t>, run_length> bounds;
    std::size_t count = 0;
    for (std::size_t i = begin; i < end; ++i) {
        const double bound = least_in(levels_[level][i], place);
        if (!(bound < size)) continue;
        if (level == 0)
            size = bound;
        else
            bounds[count++] = {bound, i};
    }
    std::sort(bounds.begin(), bounds.begin() + static_cast<std::ptrdiff_t>(count));
    for (std::size_t i = 0; i < count && bounds[i].first < size; ++i) {
        const Run& run = levels_[level][bounds[i].second];
        look(level - 1, run.begin, run.end, place, size);
    }
}

double SizeField::operator()(Complex place) const
{
    // The field is Lipschitz: it bounds its values near the last one.
    constexpr double rounding = 1e-9;
    double size = std::min(longest_, (1.0 + rounding) * (last_size_ + gradation_ * distance(place, last_place_)));
    look(levels_.size() - 1, 0, levels_.back().size(), place, size);
    last_place_ = place;
    return last_size_ = size;
}

/// A triangle is split if its circumradius over the wanted edge length exceeds this. An equilateral triangle of the
/// wanted size has 0.577; splitting at 0.76 leaves edges whose mean is the wanted length.
constexpr double split_ratio = 0.76;

/// The state of a face inside. A new face starts as unseen.
enum FaceState : char {
    unseen = 1,      ///< not yet looked at
    pending,         ///< too large; both of its places may be tried
    without_center,  ///< too large; its circumcentre is refused for ever
    done             ///< small enough, or both places are refused for ever
};

struct Candidate {
    Complex place;
    double spacing;  ///< from it to the vertices, at least
    double excess;   ///< circumradius over wanted size; 0 for a centroid
    Cdt::Face_handle face;
};

enum class Insertion { allowed, refused, refused_for_ever };

/// Whether a point may be inserted: it sees no boundary edge at an obtuse angle, and no vertex is too close. A vertex
/// that is too close stays so, as points are only added.
Insertion judge(const PlanarRegion& region, Complex z, double spacing, Cdt::Face_handle hint, Cdt::Face_handle& found)
{
    const Cdt& cdt = region.cdt();
    const Cdt::Point p = to_point(z);
    Cdt::Locate_type type;
    int index = 0;
    found = cdt.locate(p, type, index, hint);
    if (type != Cdt::FACE && type != Cdt::EDGE) return Insertion::refused_for_ever;
    // All vertices of the faces in conflict lie on the rim. Those of the face with the point tell most of the refusals,
    // before the whole conflict zone is looked at, which is large beside long thin faces.
    const auto is_near = [&](Cdt::Vertex_handle v) { return distance(to_complex(v->point()), z) < spacing; };
    for (int k = 0; k < 3; ++k)
        if (!cdt.is_infinite(found->vertex(k)) && is_near(found->vertex(k))) return Insertion::refused_for_ever;
    std::vector<Cdt::Face_handle> conflict;
    std::vector<Cdt::Edge> rim;
    cdt.get_conflicts_and_boundary(p, std::back_inserter(conflict), std::back_inserter(rim), found);
    for (const Cdt::Face_handle face : conflict)
        if (cdt.is_infinite(face)) return Insertion::refused;
    for (const auto& [face, i] : rim) {
        const Complex a = to_complex(face->vertex(Cdt::ccw(i))->point());
        const Complex b = to_complex(face->vertex(Cdt::cw(i))->point());
        if (is_near(face->vertex(Cdt::ccw(i))) || is_near(face->vertex(Cdt::cw(i)))) return Insertion::refused_for_ever;
        if (face->is_constrained(i) && dot(a - z, b - z) < 0.0) return Insertion::refused;
    }
    return Insertion::allowed;
}

/// Triangles that are too large, by their circumcentres, largest first. Then the same triangles by their centroids,
/// where the circumcentre is not allowed.
std::vector<Candidate> candidates(PlanarRegion& region, const SizeField& size)
{
    std::vector<Candidate> result;
    Cdt& cdt = region.cdt();
    for (auto f = cdt.finite_faces_begin(); f != cdt.finite_faces_end(); ++f) {
        FaceNote& note = f->info();
        if (!region.inside(f) || note.state == done) continue;
        const Complex a = to_complex(f->vertex(0)->point());
        const Complex u = to_complex(f->vertex(1)->point()) - a, v = to_complex(f->vertex(2)->point()) - a;
        // a + arm is the circumcentre, |arm| the circumradius.
        const Complex centroid = a + (u + v) / 3.0;
        const Complex arm = Complex(0.0, 1.0) * (u * std::norm(v) - v * std::norm(u)) / (2.0 * cross(u, v));
        const double radius = distance(arm, 0.0);
        const bool is_new = note.state == unseen;
        // A triangle is large by the size at its centroid. Sizes do not change, so they are asked once.
        if (is_new) note.wanted = size(centroid);
        if (radius <= split_ratio * note.wanted) {
            note.state = done;
            continue;
        }
        if (is_new) note.state = std::isfinite(radius) ? pending : without_center;
        if (is_new && note.state == pending) note.there = size(a + arm);
        if (note.state == pending) result.push_back({a + arm, split_ratio * note.there, radius / note.wanted, f});
        result.push_back({centroid, split_ratio * note.wanted, 0.0, f});
    }
    // Largest first. Equal ones stay in order, so that the mesh is always the same.
    std::stable_sort(result.begin(), result.end(),
                     [](const Candidate& s, const Candidate& t) { return s.excess > t.excess; });
    return result;
}

/// Inserts circumcentres until every triangle is small enough or protected by the boundary. This ends, as points keep a
/// distance from each other.
void refine(PlanarRegion& region, const SizeField& size, std::vector<Complex>& interior, Index next_index)
{
    Cdt& cdt = region.cdt();
    for (bool inserted = true; inserted;) {
        inserted = false;
        Cdt::Face_handle hint;
        for (const Candidate& candidate : candidates(region, size)) {
            Cdt::Face_handle found;
            const Insertion insertion = judge(region, candidate.place, candidate.spacing, hint, found);
            hint = found;
            if (insertion == Insertion::refused_for_ever) {
                char& state = candidate.face->info().state;  // of another face, unseen, if this one is gone
                if (candidate.excess > 0.0 && state == pending)
                    state = without_center;
                else if (candidate.excess == 0.0 && state == without_center)
                    state = done;
            }
            if (insertion != Insertion::allowed || !region.inside(found)) continue;
            const auto vertex = cdt.insert(to_point(candidate.place), found);
            vertex->info() = next_index++;
            interior.push_back(candidate.place);
            inserted = true;
            // The new faces fill the conflict zone, which lies inside.
            auto face = cdt.incident_faces(vertex);
            const auto first = face;
            do face->info().state = unseen;
            while (++face != first);
            hint = first;
        }
    }
}

PlanarMesh planar_arrays(const PlanarRegion& region, const std::vector<VectorXcd>& polygons,
                         const std::vector<Complex>& interior)
{
    PlanarMesh mesh;
    std::vector<Complex> points;
    for (const VectorXcd& polygon : polygons) points.insert(points.end(), polygon.begin(), polygon.end());
    points.insert(points.end(), interior.begin(), interior.end());
    mesh.points = Eigen::Map<const VectorXcd>(points.data(), static_cast<Eigen::Index>(points.size()));
    std::vector<Index> corners;
    for (auto f = region.cdt().finite_faces_begin(); f != region.cdt().finite_faces_end(); ++f)
        if (region.inside(f))
            for (int k = 0; k < 3; ++k) corners.push_back(f->vertex(k)->info());
    mesh.triangles = Eigen::Map<const Triangles>(corners.data(), static_cast<Eigen::Index>(corners.size() / 3), 3);
    return mesh;
}

/// Moves each interior point towards the centroid of its star, with triangles weighted to keep the wanted sizes, if no
/// triangle of the star turns over.
void smooth(const PlanarMesh& mesh, const SizeField& size, std::vector<Complex>& interior)
{
    const Index boundary_count = static_cast<Index>(mesh.points.size() - interior.size());
    std::vector<std::vector<Index>> star(interior.size());
    for (Eigen::Index f = 0; f < mesh.triangles.rows(); ++f)
        for (int k = 0; k < 3; ++k)
            if (mesh.triangles(f, k) >= boundary_count)
                star[mesh.triangles(f, k) - boundary_count].push_back(static_cast<Index>(3 * f + k));
    VectorXcd points = mesh.points;
    for (std::size_t i = 0; i < interior.size(); ++i) {
        const Index v = boundary_count + static_cast<Index>(i);
        Complex sum(0.0, 0.0);
        double mass = 0.0;
        const auto others = [&](Index corner) {
            const Index f = corner / 3, k = corner % 3;
            return std::pair(points[mesh.triangles(f, (k + 1) % 3)], points[mesh.triangles(f, (k + 2) % 3)]);
        };
        // The mean of the centroids around, by area over the square of the area wanted there: small faces draw more.
        for (const Index corner : star[i]) {
            const auto [b, c] = others(corner);
            const Complex centroid = (points[v] + b + c) / 3.0;
            const double wanted = size(centroid), squared = wanted * wanted;
            const double weight = cross(b - points[v], c - points[v]) / (squared * squared);
            sum += weight * centroid;
            mass += weight;
        }
        // Not where a face would lose nine tenths of its area.
        const Complex target = sum / mass;
        bool safe = std::isfinite(target.real()) && std::isfinite(target.imag());
        for (const Index corner : star[i]) {
            const auto [b, c] = others(corner);
            safe = safe && cross(b - target, c - target) > 0.1 * cross(b - points[v], c - points[v]);
        }
        if (safe) points[v] = target;
    }
    for (std::size_t i = 0; i < interior.size(); ++i) interior[i] = points[boundary_count + static_cast<Index>(i)];
}

/// Cuts every inner edge between two boundary vertices in the middle.
void split_chords(PlanarMesh& mesh, Index boundary_count)
{
    const Index point_count = static_cast<Index>(mesh.points.size());
    const std::vector<Index> twin = pair_halfedges(mesh.triangles, point_count);
    std::map<std::pair<Index, Index>, Index> middles;
    std::vector<Complex> points(mesh.points.begin(), mesh.points.end());
    for (Index h = 0; h < static_cast<Index>(twin.size()); ++h) {
        const Index a = origin(mesh.triangles, h), b = target(mesh.triangles, h);
        if (twin[h] < h || a >= boundary_count || b >= boundary_count) continue;
        middles[std::minmax(a, b)] = static_cast<Index>(points.size());
        points.push_back(0.5 * (mesh.points[a] + mesh.points[b]));
    }
    if (middles.empty()) return;
    using Corners = std::array<Index, 3>;
    std::vector<Corners> pending, done;
    for (Eigen::Index f = 0; f < mesh.triangles.rows(); ++f)
        pending.push_back({mesh.triangles(f, 0), mesh.triangles(f, 1), mesh.triangles(f, 2)});
    while (!pending.empty()) {
        const Corners t = pending.back();
        pending.pop_back();
        int k = 0;
        auto middle = middles.end();
        for (; k < 3 && middle == middles.end(); ++k) middle = middles.find(std::minmax(t[k], t[(k + 1) % 3]));
        if (middle == middles.end()) {
            done.push_back(t);
        } else {
            // The edge found runs from t[k - 1] to t[k % 3], opposite to t[(k + 1) % 3].
            pending.push_back({t[k - 1], middle->second, t[(k + 1) % 3]});
            pending.push_back({middle->second, t[k % 3], t[(k + 1) % 3]});
        }
    }
    mesh.points = Eigen::Map<const VectorXcd>(points.data(), static_cast<Eigen::Index>(points.size()));
    mesh.triangles = Eigen::Map<const Triangles>(done.data()->data(), static_cast<Eigen::Index>(done.size()), 3);
}

/// The mesh of polygons whose largest coordinate is about 1.
PlanarMesh mesh_of_unit_size(const std::vector<VectorXcd>& polygons, Index boundary_count,
                             const PlanarMeshOptions& options)
{
    std::vector<Complex> interior;
    if (options.bare) return planar_arrays(PlanarRegion(polygons, interior), polygons, interior);
    const SizeField size(polygons, options.longest, options.gradation);
    {
        PlanarRegion region(polygons, interior);
        refine(region, size, interior, boundary_count);
    }
    for (int round = 0; round < options.smoothing && !interior.empty(); ++round)
        smooth(planar_arrays(PlanarRegion(polygons, interior), polygons, interior), size, interior);
    PlanarMesh mesh = planar_arrays(PlanarRegion(polygons, interior), polygons, interior);
    split_chords(mesh, boundary_count);
    return mesh;
}

}  // namespace

PlanarMesh planar_mesh(const std::vector<VectorXcd>& polygons, const PlanarMeshOptions& options)
{
    Index boundary_count = 0;
    double largest = 0.0;
    for (const VectorXcd& polygon : polygons) {
        if (polygon.size() < 3) throw InputError("a polygon needs at least three points");
        if (!polygon.allFinite()) throw InputError("a polygon's point is NaN or infinite");
        boundary_count += static_cast<Index>(polygon.size());
        largest = std::max({largest, polygon.real().cwiseAbs().maxCoeff(), polygon.imag().cwiseAbs().maxCoeff()});
    }
    // Scaling by a power of two does not round, and no square over- or underflows. Distances of 0 would let the
    // refinement go on for ever.
    const int exponent = largest > 0.0 ? std::ilogb(largest) : 0;
    const auto scaled = [](const VectorXcd& points, int by) -> VectorXcd {
        return points.unaryExpr(
            [by](Complex z) { return Complex(std::ldexp(z.real(), by), std::ldexp(z.imag(), by)); });
    };
    std::vector<VectorXcd> unit;
    for (const VectorXcd& polygon : polygons) unit.push_back(scaled(polygon, -exponent));
    PlanarMeshOptions unit_options = options;
    unit_options.longest = std::ldexp(options.longest, -exponent);
    PlanarMesh mesh = mesh_of_unit_size(unit, boundary_count, unit_options);
    mesh.points = scaled(mesh.points, exponent);
    Index begin = 0;
    for (const VectorXcd& polygon : polygons) {
        mesh.points.segment(begin, polygon.size()) = polygon;
        begin += static_cast<Index>(polygon.size());
    }
    return mesh;
}

}  // namespace koebe
