// The state of the condensed Koebe iteration: a surface with a round disk in every hole.
#pragma once

#include "core/types.h"
#include "iteration/sweep_order.h"

#include <vector>

namespace koebe {

/// One angle per boundary vertex, and A for these angles: the Laplacian of the surface with the disks T_k in all its
/// holes (docs/method.md, "The condensed engine", M8). A step opens loops by removing their disks; the others stay
/// filled.
class FilledState {
public:
    virtual ~FilledState() = default;

    int loop_count() const { return static_cast<int>(size_.size()); }

    /// The outer loop on the unit circle, at its angles.
    VectorXcd rim() const;

    /// The angles of each loop's vertices.
    const std::vector<VectorXd>& angles() const { return angles_; }

    /// The image of each loop under the harmonic map with the outer loop on the unit circle and all other loops filled.
    virtual std::vector<VectorXcd> images() = 0;

    /// Whether all steps of a sweep take effect together.
    virtual bool opens_at_once() const = 0;

    /// Sets the outer loop's first angles, where they follow from the other loops' angles.
    /// @param raised incremented by the number of steps along a loop that had to be raised
    virtual void start(int&) {}

    /// Takes some steps of a sweep from the present state: sets new angles for the loops they open. @param raised as
    /// above
    virtual void take_steps(const Sweep& together, int& raised) = 0;

protected:
    /// @param edges per loop: length on the surface of the edge from each vertex to the next; must outlive the state
    /// @param first_angles angles for all loops, or none
    FilledState(const std::vector<VertexLoop>& loops, const std::vector<VectorXd>& edges,
                std::vector<VectorXd> first_angles);

    /// Whether the first angles were given. Otherwise they are computed from a flux.
    bool begun() const { return begun_; }

    /// Fills the loops at the first angles, if these were given.
    void fill();

    /// Sets the angles of open loops by the flux through them: its running sum is the conjugate harmonic function.
    void take_angles(const OpenedLoops& open, const VectorXd& flux, int& raised);
    /// Sets the angles of open loops, each from its own flux.
    void take_angles(const OpenedLoops& open, const std::vector<VectorXd>& fluxes, int& raised);

    /// Sets the angles of inner loops by arc length.
    void take_arc_lengths(const OpenedLoops& loops);

    /// Whether loop k is ever filled.
    virtual bool fills(int) const { return true; }

    /// The disk of loop k at its angles. May be called for several loops side by side.
    virtual MatrixXd disk_of(int k);

    /// Fills loop k by this disk from now on: T_k, (n_k, n_k), unless disk_of() makes a smaller one.
    virtual void set_disk(int k, const MatrixXd& disk) = 0;

    Index total(const std::vector<int>& loops) const;

    /// All loops but the outer one.
    OpenedLoops inner_loops() const;

    const std::vector<VectorXd>& edges_;
    std::vector<Index> size_;        // of each loop
    std::vector<VectorXd> weights_;  // share of each vertex in the length of its loop
    std::vector<VectorXd> angles_;

private:
    /// Gives disks at their present angles to those of the loops that are ever filled.
    void fill(OpenedLoops loops);

    bool begun_;
};

/// Keeps the outer loop open and held at 0 in every step, so it is never filled: A is the surface with disks T_k in the
/// inner loops.
class GroundedState : public FilledState {
public:
    bool opens_at_once() const final { return true; }
    void start(int& raised) override
    {
        if (!begun()) take_angles({0}, outer_flux(), raised);
    }
    void take_steps(const Sweep&, int& raised) final;

protected:
    using FilledState::FilledState;
    bool fills(int k) const final { return k > 0; }

private:
    /// The flux through each inner loop at potential 1, with the outer loop at 0 and the other inner loops filled, all
    /// from the present state.
    virtual std::vector<VectorXd> fluxes_against_outer() = 0;

    /// The flux through the outer loop with the first inner loop at potential 1 and all others filled.
    virtual VectorXd outer_flux() = 0;
};

}  // namespace koebe
