// The unknowns of a planar problem, and Newton's equations for them.
#pragma once

#include "foldover/face_energy.h"
#include "foldover/foldover_problem.h"
#include "linear/kept_factor.h"

#include <Eigen/Core>

#include <array>
#include <utility>
#include <vector>

namespace koebe {

/// The pattern of the Hessian and its analysis. They follow from triangles, mobility, tracks and lifts of a problem.
struct NewtonPattern {
    std::vector<Index> first_unknown;  ///< (V) that it was made for,
    std::vector<int> track_of;         ///< (V) and the tracks
    SparseMatrix hessian;
    std::vector<std::array<Index, 3>> places;  ///< per face and corner: set by NewtonSystem::set_pattern
    KeptFactor solver;
};

/// A free vertex has two unknowns. A sliding or riding vertex has one unknown: the way along its circle or track. The
/// unknowns of tracks and periods come last, as many faces share them. The pattern of the Hessian does not change.
class NewtonSystem {
public:
    /// @param problem must not change while the system is in use, except for its places
    /// @param kept pattern of an earlier system of the same triangles and lifts, or an empty one; it must outlive the
    /// system, which leaves its pattern there. It is made anew if mobility or tracks differ. Null: it is not kept
    explicit NewtonSystem(const FoldoverProblem& problem, NewtonPattern* kept = nullptr);
    ~NewtonSystem();
    NewtonSystem(const NewtonSystem&) = delete;
    NewtonSystem& operator=(const NewtonSystem&) = delete;

    Index unknowns() const { return unknowns_; }

    void clear();
    void add_face(Eigen::Index f, const FaceDerivatives& face, const WantedShape& shape);
    /// @param gradient, hessian by the place of a free vertex
    void add_vertex(Index vertex, const Eigen::Vector2d& gradient, const Eigen::Matrix2d& hessian);
    /// Call after all faces: adds the curvature of circles that vertices ride on, where the gradient pulls outward.
    void add_bends();

    /// -H^-1 gradient, with the Hessian's diagonal a little larger. If this step does not lower the sum: minus the
    /// gradient over the diagonal. @return the step and its slope; the slope is not below 0 if neither step lowers the
    /// sum
    std::pair<VectorXd, double> descent();

    /// The places after a share of a step.
    FoldoverPlaces moved(const VectorXd& step, double share) const;

private:
    using Mobility = FoldoverProblem::Mobility;

    /// An unknown, and the direction in which it moves a corner of a face.
    struct Column {
        Index unknown;
        int corner;
        Eigen::Vector2d way;
    };

    Index unknowns_of(Index v) const;
    bool rides(Index v) const { return problem_.mobility[v] == Mobility::riding; }
    const Track& track_of(Index v) const { return problem_.tracks[problem_.track_of[v]]; }
    bool is_shared(Eigen::Index f) const;
    std::vector<Column> columns(Eigen::Index f) const;
    std::pair<Index, Index> ends(Eigen::Index f, int k) const;
    Eigen::Vector2d tangent_now(Index v) const;
    const Eigen::Vector2d& tangent(Index v) const { return tangents_[v]; }
    void set_pattern();
    void add_shared_pairs(Eigen::Index f, std::vector<std::pair<Index, Index>>& pairs) const;
    void add(Index column_vertex, Index row_vertex, Index place, const Eigen::Matrix2d& block);
    void add_by_columns(Eigen::Index f, const FaceDerivatives& face, const WantedShape& shape);

    const FoldoverProblem& problem_;
    std::vector<Index> first_unknown_;  // per vertex, -1 if it is held
    std::vector<Index> first_of_track_, first_of_period_;
    Index unknowns_ = 0;
    NewtonPattern pattern_;
    NewtonPattern* kept_;
    VectorXd gradient_;
    std::vector<Eigen::Vector2d> tangents_;  // (V) of sliding and riding vertices, at the present places
    std::vector<double> angle_;              // (V) of sliding vertices round their circles, at the present places
    std::vector<double>
        outward_force_;  // (V) of riding, or bending sliding, vertices: minus the gradient, along the radius
};

}  // namespace koebe
