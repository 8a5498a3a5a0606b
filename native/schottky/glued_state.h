// The state of Koebe's iteration where loops are glued in pairs: a cut surface in the plane, the sides of its cuts
// Moebius maps apart.
#pragma once

#include "linear/condensed_laplacian.h"
#include "schottky/handle_cut.h"

#include <vector>

namespace koebe {

/// A cut surface with a round disk of closed form in every loop, given by angles, as in the condensed engine
/// (docs/method.md), on its loops alone.
///
/// A step opens one loop k, the others filled; the rest is a disk, and the flux from a source in it gives the angles of
/// its conformal map along k. A hole takes them as its own, which is Koebe's step. The side of a cut hands them to the
/// other side: what fills that is then the surface beyond the cut, as far as it is known. Where nothing changes any
/// more the outside of one side's image and the inside of the other's are glued to one another by maps that are
/// conformal on both sides of the cut, so by a Moebius map (docs/domains.md, "Any number of handles").
class GluedState {
public:
    /// Angles in proportion to length.
    /// @param surface its boundary the concatenation of the loops, nothing grounded @param loops must outlive this
    /// @throws SolverError memory
    GluedState(const CondensedLaplacian& surface, const std::vector<CutLoop>& loops);

    /// All loops opened, each for itself, from the present state: one inverse of the filled surface's matrix.
    /// @return the largest change of a disk's matrix, over its size
    double sweep();

    /// The first loop, if it is a hole, on the unit circle.
    VectorXcd rim() const;
    /// The loops inside the first one, harmonic where they are filled. @param rim where that is: rim(), or its image
    /// under an automorphism of the disk
    std::vector<VectorXcd> images_in_disk(const VectorXcd& rim) const;
    /// The same with infinity in the disk of the first loop, which lies round the others.
    std::vector<VectorXcd> images_round_infinity() const;

    /// By what each loop has to be shifted, the first one by 0, so that no flux runs through any: the map is regular
    /// beyond each of them. @param images of the loops, near those above
    std::vector<Complex> shifts_without_flux(const std::vector<VectorXcd>& images) const;

private:
    void fill(std::size_t k, VectorXd angles);
    VectorXd flux_through(std::size_t k, const MatrixXd& inverse_factor) const;
    VectorXd seen_from_the_other_side(std::size_t k, const VectorXd& angles) const;
    std::vector<VectorXcd> split(const MatrixXd& z) const;

    const std::vector<CutLoop>& loops_;
    std::vector<Eigen::Index> begin_;  // of each loop among the rows
    std::vector<VectorXd> weights_, angles_;
    std::vector<MatrixXd> disks_;
    MatrixXd sigma_, filled_;
};

}  // namespace koebe
