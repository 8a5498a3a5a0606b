#include "embedding/convex_embedding.h"

#include "core/errors.h"
#include "embedding/disk_complex.h"
#include "linear/sparse_cholesky.h"
#include "planar/planar_predicates.h"
#include "planar/star_centre.h"
#include "quality/stored_uv.h"
#include "surface/laplacian.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>
#include <utility>

namespace koebe {
namespace {

constexpr int most_reweightings = 40;
constexpr double least_area_share = 1e-3;        // least area of a face, per face that it stands for, over the mean
constexpr double least_area_over_length = 1e-6;  // disk units: some rounding errors of 32-bit UVs
constexpr int last_sweeps = 20;
constexpr int most_thinnings = 40, patience = 3;  // of mend
constexpr double most_taken_out = 0.1;            // of the vertices: with more, little is left of the drawing

class ConvexEmbedding {
public:
    ConvexEmbedding(const FilledDisk& filled, const VertexLoop& outer, const VectorXcd& rim)
        : complex_(filled.triangles, filled.vertex_count, outer),
          given_(MatrixXd::Zero(filled.vertex_count, 2)),
          smallest_(least_area_share * std::numbers::pi / static_cast<double>(filled.triangles.rows()))
    {
        for (std::size_t i = 0; i < outer.size() && rim.size() > 0; ++i)
            given_.row(outer[i]) << rim[static_cast<Eigen::Index>(i)].real(), rim[static_cast<Eigen::Index>(i)].imag();
    }

    PlanarPoints run(const ExecutionContext& context)
    {
        int rings = 0;
        for (int round = 0; round < most_reweightings; ++round) {
            context.checkpoint();
            solve();
            const std::vector<Index> bad = bad_faces();
            if (bad.empty() || !thin_out(bad, rings++)) break;
        }
        put_all_back(context);
        return points_;
    }

    std::optional<MendedDrawing> mend(PlanarPoints points, std::vector<char> wrong, const ExecutionContext& context)
    {
        points_ = std::move(points);
        wrong_ = std::move(wrong);
        replaced_.assign(complex_.vertex_count(), 0);
        std::vector<Index> bad = bad_faces();
        std::size_t fewest = bad.size();
        int waited = 0, rings = 0;
        for (int round = 0; round < most_thinnings && !bad.empty(); ++round) {
            context.checkpoint();
            if (!thin_out(bad, rings) || complex_.taken_out() > most_taken_out * complex_.vertex_count()) return {};
            bad = bad_faces();
            // Wider where taking out leads no further.
            waited = bad.size() < fewest ? 0 : waited + 1;
            rings += waited > 0 && waited % patience == 0;
            fewest = std::min(fewest, bad.size());
        }
        if (!bad.empty()) return {};
        put_all_back(context);
        for (Index f = 0; f < complex_.face_count(); ++f)
            if (is_replaced(complex_.face(f)) && !is_upright(complex_.face(f))) return {};
        MendedDrawing result{points_, {}};
        for (Index v = 0; v < complex_.vertex_count(); ++v)
            if (replaced_[v]) result.replaced.push_back(v);
        return result;
    }

private:
    void put_all_back(const ExecutionContext& context)
    {
        std::size_t next_sweep = complex_.taken_out() > 0 ? present_inner() * 5 / 4 + 1 : 0;
        std::vector<Index> back;
        if (complex_.taken_out() > 0) sweep_all(5);
        std::size_t present = present_inner();
        while (complex_.taken_out() > 0) {
            const Index v = complex_.put_back();
            place(v);
            if (++present >= next_sweep) {
                context.checkpoint();
                sweep_all(1);
                next_sweep = present * 5 / 4 + 1;
            }
        }
        for (int i = 0; i < last_sweeps && !bad_faces().empty(); ++i) sweep_all(1);
    }

    /// Whether a given drawing is mended, and only replaced vertices move.
    bool mends() const { return !wrong_.empty(); }
    bool may_move(Index v) const { return !mends() || replaced_[v]; }

    Complex at(Index v) const { return {points_(v, 0), points_(v, 1)}; }

    std::size_t present_inner() const
    {
        std::size_t count = 0;
        for (Index v = 0; v < complex_.vertex_count(); ++v) count += complex_.present(v) && !complex_.outer(v);
        return count;
    }

    /// Puts every inner vertex at the mean of its neighbours.
    void solve()
    {
        const Triangles triangles = complex_.triangles();
        std::vector<char> fixed(complex_.vertex_count(), 0);
        for (Index v = 0; v < complex_.vertex_count(); ++v) fixed[v] = complex_.outer(v) || !complex_.present(v);
        try {
            const EdgeLengths weights = EdgeLengths::Constant(triangles.rows(), 3, 1.0);
            const SparseMatrix laplacian = cotan_laplacian(triangles, weights, complex_.vertex_count());
            points_ = DirichletSolver(laplacian, fixed).solve(given_);
        } catch (const SolverError&) {
            points_ = PlanarPoints::Zero(given_.rows(), 2);
        }
    }

    /// Faces that are wrong, or too small for the faces they stand for, and have a vertex to take out.
    std::vector<Index> bad_faces() const
    {
        std::vector<Index> bad;
        for (Index f = 0; f < complex_.face_count(); ++f) {
            if (!complex_.alive(f)) continue;
            const auto [a, b, c] = complex_.face(f);
            if (mends()) {
                const bool as_given =
                    f < static_cast<Index>(wrong_.size()) && !replaced_[a] && !replaced_[b] && !replaced_[c];
                if (as_given ? wrong_[f] : too_small({a, b, c}, complex_.weight(f))) bad.push_back(f);
                continue;
            }
            if (complex_.outer(a) && complex_.outer(b) && complex_.outer(c)) continue;
            const Complex u = at(b) - at(a), v = at(c) - at(a);
            const double twice = cross(u, v), longest = std::max({std::abs(u), std::abs(v), std::abs(v - u)});
            if (!(twice > 2.0 * smallest_ * complex_.weight(f)) || !(twice > least_area_over_length * longest))
                bad.push_back(f);
        }
        return bad;
    }

    /// Whether a corner was near a wrong face.
    bool is_replaced(const DiskComplex::Face& face) const
    {
        return replaced_[face[0]] || replaced_[face[1]] || replaced_[face[2]];
    }

    bool is_upright(const DiskComplex::Face& face) const
    {
        return cross(at(face[1]) - at(face[0]), at(face[2]) - at(face[0])) > 0.0;
    }

    /// Whether a face of a mended drawing has not the area that the faces it stands for need as 32-bit UVs.
    bool too_small(const DiskComplex::Face& face, double weight) const
    {
        const Complex u = at(face[1]) - at(face[0]), v = at(face[2]) - at(face[0]);
        return !(cross(u, v) > least_area_over_length * weight * std::max({std::abs(u), std::abs(v), std::abs(v - u)}));
    }

    /// Takes out vertices of some faces and of the rings around them, no two of them neighbours, starting with vertices
    /// of fewest faces. @return whether any were taken out
    bool thin_out(const std::vector<Index>& bad, int rings)
    {
        std::vector<char> near(complex_.vertex_count(), 0);
        std::vector<Index> region;
        const auto take = [&](Index f) {
            for (const Index v : complex_.face(f))
                if (!near[v]) {
                    near[v] = 1;
                    region.push_back(v);
                }
        };
        // Vertices of these faces, then ring after ring. Rings do not grow over the outer polygon.
        for (const Index f : bad) take(f);
        std::size_t begin = 0;
        for (int ring = 0; ring < rings; ++ring) {
            const std::size_t end = region.size();
            for (; begin < end; ++begin)
                if (!complex_.outer(region[begin]))
                    for (const Index f : std::vector<Index>(complex_.around(region[begin]))) take(f);
        }
        std::erase_if(region, [&](Index v) { return complex_.outer(v); });
        if (mends())
            for (const Index v : region) replaced_[v] = 1;
        const std::size_t before = complex_.taken_out();
        // An independent set of low degree: each hole is then a small star polygon. If none can go, one that needs a
        // chord between outer vertices.
        std::function<bool(const DiskComplex::Face&, double)> wrong;
        if (mends()) wrong = [&](const DiskComplex::Face& face, double weight) { return too_small(face, weight); };
        for (const bool chords : {false, true}) {
            std::sort(region.begin(), region.end(), [&](Index a, Index b) {
                return std::pair(complex_.around(a).size(), a) < std::pair(complex_.around(b).size(), b);
            });
            std::vector<char> blocked(complex_.vertex_count(), 0);
            for (const Index v : region) {
                if (blocked[v]) continue;
                const std::vector<Index> faces = complex_.around(v);
                std::vector<Index> neighbours, unused;
                complex_.link(v, neighbours, unused);
                if (!complex_.take_out(v, chords, wrong)) continue;
                for (const Index w : neighbours) blocked[w] = 1;
            }
            if (complex_.taken_out() > before) return true;
        }
        return false;
    }

    void sweep_all(int times)
    {
        for (int i = 0; i < times; ++i)
            for (Index v = 0; v < complex_.vertex_count(); ++v)
                if (complex_.present(v) && !complex_.outer(v) && may_move(v)) centre(v, true);
    }

    void place(Index v)
    {
        centre(v, false);
        std::vector<Index> neighbours, faces;
        complex_.link(v, neighbours, faces);
        for (const Index w : neighbours)
            if (!complex_.outer(w) && may_move(w)) centre(w, true);
        centre(v, true);
    }

    bool centre(Index v, bool placed)
    {
        complex_.link(v, neighbours_, link_faces_);
        polygon_.clear();
        weights_.clear();
        for (std::size_t i = 0; i < neighbours_.size(); ++i) {
            polygon_.push_back(at(neighbours_[i]));
            weights_.push_back(complex_.weight(link_faces_[i]));
        }
        const auto found = star_centre(polygon_, weights_, placed ? std::optional(at(v)) : std::nullopt);
        if (found) points_.row(v) << found->real(), found->imag();
        return found.has_value();
    }

    DiskComplex complex_;
    MatrixXd given_;
    double smallest_;
    PlanarPoints points_;
    std::vector<Index> neighbours_, link_faces_;
    std::vector<Complex> polygon_;
    std::vector<double> weights_;
    std::vector<char> wrong_;     // of mend: given faces that are wrong
    std::vector<char> replaced_;  // of mend: (V) 1 for vertices that were near one
};

}  // namespace

FilledDisk fill_with_fans(const Surface& surface, const std::vector<VertexLoop>& loops)
{
    Eigen::Index row = surface.triangles.rows(), count = row;
    for (std::size_t k = 1; k < loops.size(); ++k) count += static_cast<Eigen::Index>(loops[k].size());
    FilledDisk filled{Triangles(count, 3), surface.vertex_count, surface.vertex_count};
    filled.triangles.topRows(row) = surface.triangles;
    for (std::size_t k = 1; k < loops.size(); ++k) {
        const Index center = filled.vertex_count++;
        for (std::size_t i = 0; i < loops[k].size(); ++i)
            filled.triangles.row(row++) << loops[k][(i + 1) % loops[k].size()], loops[k][i], center;
    }
    return filled;
}

PlanarPoints convex_embedding(const FilledDisk& filled, const VertexLoop& outer, const VectorXcd& rim,
                              const ExecutionContext& context)
{
    return ConvexEmbedding(filled, outer, rim).run(context);
}

std::optional<MendedDrawing> mend_drawing(const FilledDisk& filled, const VertexLoop& outer, PlanarPoints points,
                                          std::vector<char> wrong, const ExecutionContext& context)
{
    return ConvexEmbedding(filled, outer, {}).mend(std::move(points), std::move(wrong), context);
}

}  // namespace koebe
