#include "foldover/angle_newton.h"

#include "core/errors.h"
#include "linear/kept_factor.h"

#include <Eigen/Dense>

#include <algorithm>
#include <cmath>

namespace koebe {
namespace {

constexpr double shift = 1e-9;  // share added to the Hessian's diagonal

/// d arg w = Im(c dz) by x and y.
Eigen::Vector2d slope(Complex c) { return {c.imag(), c.real()}; }

}  // namespace

struct AngleNewton::Impl {
public:
    explicit Impl(const AngleMap& map) : map_(map), first_unknown_(map.vertex_count(), -1)
    {
        for (Index v = 0; v < map.vertex_count(); ++v) {
            if (map.mobility[v] == AngleMap::Mobility::held) continue;
            first_unknown_[v] = unknowns_;
            unknowns_ += dimension(v);
        }
    }

    bool solve(double least)
    {
        if (unknowns_ == 0) return false;
        weight_.clear();
        weight_.reserve(map_.error.size());
        for (const double e : map_.error) weight_.push_back(1.0 / std::sqrt(e * e + least * least));
        assemble();
        try {
            step_ = -factored(solver_, hessian_).solve(gradient_);
        } catch (const SolverError&) {
            return false;
        }
        return step_.allFinite();
    }

    std::vector<Complex> places(double share) const
    {
        std::vector<Complex> result = map_.points;
        for (Index v = 0; v < map_.vertex_count(); ++v) {
            const Index u = first_unknown_[v];
            if (u < 0) continue;
            if (map_.mobility[v] == AngleMap::Mobility::free)
                result[v] += share * Complex(step_[u], step_[u + 1]);
            else
                result[v] = map_.slid(v, share * step_[u]);
        }
        return result;
    }

private:
    struct Block {
        Index vertex;
        Eigen::Matrix2d values;
    };

    Index dimension(Index v) const { return map_.mobility[v] == AngleMap::Mobility::free ? 2 : 1; }

    /// The directions in which a vertex moves, as columns; for a sliding vertex the second is 0.
    Eigen::Matrix2d directions(Index v) const
    {
        if (map_.mobility[v] == AngleMap::Mobility::free) return Eigen::Matrix2d::Identity();
        const Complex arm = map_.points[v] - map_.slide(v).circle.center;
        Eigen::Matrix2d tangent = Eigen::Matrix2d::Zero();
        tangent.col(0) << -arm.imag(), arm.real();
        return tangent / std::abs(arm);
    }

    void assemble()
    {
        gradient_.setZero(unknowns_);
        hessian_.resize(unknowns_, unknowns_);
        hessian_.reserve(8 * static_cast<Eigen::Index>(unknowns_));
        for (Index v = 0; v < map_.vertex_count(); ++v)
            if (first_unknown_[v] >= 0) add_columns(v);
        hessian_.finalize();
    }

    /// Adds the columns of a vertex: its own rows, and the rows of later vertices.
    void add_columns(Index v)
    {
        Eigen::Matrix2d own = Eigen::Matrix2d::Zero();
        Eigen::Vector2d gradient = Eigen::Vector2d::Zero();
        sum_star(v, own, gradient);
        std::ranges::sort(blocks_, {}, &Block::vertex);
        const Eigen::Matrix2d here = directions(v);
        own = here.transpose() * own * here;
        const Eigen::Vector2d along = here.transpose() * gradient;
        for (Index j = 0; j < dimension(v); ++j) {
            const Index column = first_unknown_[v] + j;
            gradient_[column] = along[j];
            hessian_.startVec(column);
            for (Index i = j; i < dimension(v); ++i)
                hessian_.insertBack(first_unknown_[v] + i, column) = own(i, j) * (i == j ? 1.0 + shift : 1.0);
            for (std::size_t k = 0; k < blocks_.size(); ++k) {
                const Index w = blocks_[k].vertex;
                Eigen::Vector2d rows = blocks_[k].values * here.col(j);
                // Two faces share an edge: the other face's part is next.
                if (k + 1 < blocks_.size() && blocks_[k + 1].vertex == w) rows += blocks_[++k].values * here.col(j);
                rows = directions(w).transpose() * rows;
                for (Index i = 0; i < dimension(w); ++i) hessian_.insertBack(first_unknown_[w] + i, column) = rows[i];
            }
        }
    }

    /// Sums over the faces around a vertex: its own block, its gradient, and the blocks of later vertices face by face.
    void sum_star(Index v, Eigen::Matrix2d& own, Eigen::Vector2d& gradient)
    {
        blocks_.clear();
        const Complex z = map_.points[v];
        for (const AngleMap::Corner& corner : map_.star(v)) {
            Eigen::Matrix2d next = Eigen::Matrix2d::Zero(), previous = next;
            if (map_.counts(corner)) {
                const Complex a = 1.0 / (map_.points[corner.next] - z), b = 1.0 / (map_.points[corner.previous] - z);
                const Complex e = 1.0 / (map_.points[corner.previous] - map_.points[corner.next]);
                const auto add = [&](Index k, Complex at_own, Complex at_next, Complex at_previous) {
                    const Eigen::Vector2d here = slope(at_own), weighted = weight_[k] * here;
                    own += weighted * here.transpose();
                    gradient += map_.error[k] * weighted;
                    next += slope(at_next) * weighted.transpose();
                    previous += slope(at_previous) * weighted.transpose();
                };
                add(corner.own, a - b, -a, b);
                add(corner.after, -a, a + e, -e);
                add(corner.before, b, -e, e - b);
            }
            if (corner.next > v && first_unknown_[corner.next] >= 0) blocks_.push_back({corner.next, next});
            if (corner.previous > v && first_unknown_[corner.previous] >= 0)
                blocks_.push_back({corner.previous, previous});
        }
    }

    const AngleMap& map_;
    std::vector<Index> first_unknown_;  // per vertex, -1 if it is held
    Index unknowns_ = 0;
    std::vector<double> weight_;
    std::vector<Block> blocks_;
    SparseMatrix hessian_;  // the lower triangle
    VectorXd gradient_, step_;
    KeptFactor solver_;
};

AngleNewton::AngleNewton(const AngleMap& map) : impl_(std::make_unique<Impl>(map)) {}
AngleNewton::~AngleNewton() = default;

bool AngleNewton::solve(double least) { return impl_->solve(least); }

std::vector<Complex> AngleNewton::places(double share) const { return impl_->places(share); }

}  // namespace koebe
