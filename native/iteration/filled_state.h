// The state of the condensed Koebe iteration: a surface with a round disk in every hole.
#pragma once

#include "core/types.h"
#include "iteration/sweep_order.h"

#include <vector>

namespace koebe {

/// One angle per boundary vertex, and for them A, the Laplacian of the surface with the disks T_k in all its holes
/// (docs/method.md, "The condensed engine"). Loops are opened by removing their disk; the rest stays filled.
class FilledState {
public:
    virtual ~FilledState() = default;

    int loop_count() const { return static_cast<int>(size_.size()); }

    /// The outer loop on the unit circle, at its angles.
    VectorXcd rim() const;

    /// Of the vertices of each loop.
    const std::vector<VectorXd>& angles() const { return angles_; }

    /// The map of the surface with all loops but the outer one filled and the outer one on the unit circle, on every
    /// loop: harmonic where it is filled.
    virtual std::vector<VectorXcd> images() = 0;

    /// Whether all steps of a sweep take effect together.
    virtual bool opens_at_once() const = 0;

    /// The outer loop's first angles, where they follow from the other loops'.
    /// @param raised incremented by the number of steps along a loop that had to be raised
    virtual void start(int&) {}

    /// Takes steps of a sweep, all from the present state: new angles for the loops they open. @param raised as above
    virtual void take_steps(const Sweep& together, int& raised) = 0;

protected:
    /// @param edges per loop: length on the surface of the edge from each vertex to the next; must outlive this
    /// @param first_angles angles for all loops, or none
    FilledState(const std::vector<VertexLoop>& loops, const std::vector<VectorXd>& edges,
                std::vector<VectorXd> first_angles);

    /// Whether the first angles were given; else those of each loop are to be taken from a flux.
    bool begun() const { return begun_; }

    /// Disks at the first angles, if they were given.
    void fill();

    /// New angles for open loops from the flux through them: the conjugate of the harmonic function.
    void take_angles(const OpenedLoops& open, const VectorXd& flux, int& raised);
    /// The same for each loop its own flux.
    void take_angles(const OpenedLoops& open, const std::vector<VectorXd>& fluxes, int& raised);

    /// Angles by arc length for inner loops.
    void take_arc_lengths(const OpenedLoops& loops);

    /// Whether loop k is ever filled.
    virtual bool fills(int) const { return true; }

    /// Loop k is filled by this disk from now on: T_k, (n_k, n_k).
    virtual void set_disk(int k, const MatrixXd& disk) = 0;

    Index total(const std::vector<int>& loops) const;

    /// All but the outer one.
    OpenedLoops inner_loops() const;

    const std::vector<VectorXd>& edges_;
    std::vector<Index> size_;        // of each loop
    std::vector<VectorXd> weights_;  // share of each vertex in the length of its loop
    std::vector<VectorXd> angles_;

private:
    /// Those of the loops that are ever filled get the disks of their angles.
    void fill(OpenedLoops loops);

    bool begun_;
};

/// The outer loop held at 0 in every step, and so never filled: A is that of the surface and the disks T_k in its inner
/// loops.
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
    /// All inner loops opened at once, each for itself, the others filled, from the present state: the flux through
    /// each at potential 1, the outer one at 0.
    virtual std::vector<VectorXd> fluxes_against_outer() = 0;

    /// The flux through the outer loop with the first inner one at potential 1 and all others filled.
    virtual VectorXd outer_flux() = 0;
};

}  // namespace koebe
