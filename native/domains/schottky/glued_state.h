// The state of Koebe's iteration with loops glued in pairs: a cut surface in the plane, where Moebius maps take a side
// of a cut to the other.
#pragma once

#include "linear/condensed_laplacian.h"
#include "schottky/handle_cut.h"

#include <vector>

namespace koebe {

/// The loops of a cut surface with a round disk of closed form in each, given by angles, as in the condensed engine
/// (docs/method.md).
///
/// A step opens one loop k; the others are filled. The flux from a source in the remaining disk gives the angles of its
/// conformal map along k. A hole takes these angles, as in Koebe's step. The side of a cut hands them to the other
/// side, which is then filled by the surface beyond the cut, as far as it is known. At a fixed point the outside of one
/// side's image is glued to the inside of the other side's image. The maps that glue them are conformal on both sides
/// of the cut, so they are a Moebius map (docs/domains.md, "Any number of handles").
class GluedState {
public:
    /// Starts with angles in proportion to length.
    /// @param surface its boundary is the concatenation of the loops, nothing grounded @param loops must outlive the
    /// state
    /// @throws SolverError memory
    GluedState(const CondensedLaplacian& surface, const std::vector<CutLoop>& loops);

    /// Opens each loop by itself, from the present state, with one inverse of the filled surface's matrix.
    /// @return the largest change of a disk's matrix, over its size
    double sweep();

    /// The first loop, if it is a hole, on the unit circle.
    VectorXcd rim() const;
    /// The images of the loops inside the first one, where the filled loops are harmonic. @param rim image of the first
    /// loop: rim(), or its image under an automorphism of the disk
    std::vector<VectorXcd> images_in_disk(const VectorXcd& rim) const;
    /// The images with infinity in the disk of the first loop, which lies round the others.
    std::vector<VectorXcd> images_round_infinity() const;

    /// The shift of each loop, the first one 0, after which no flux runs through any loop: the map is regular beyond
    /// each.
    /// @param images of the loops, near those of images_in_disk or images_round_infinity
    std::vector<Complex> shifts_without_flux(const std::vector<VectorXcd>& images) const;

private:
    void fill(std::size_t k, VectorXd angles);
    VectorXd flux_through(std::size_t k, const MatrixXd& inverse_factor) const;
    VectorXd seen_from_the_other_side(std::size_t k, const VectorXd& angles) const;
    std::vector<VectorXcd> split(const MatrixXd& z) const;

    const std::vector<CutLoop>& loops_;
    std::vector<Eigen::Index> begin_;  // first row of each loop
    std::vector<VectorXd> weights_, angles_;
    std::vector<MatrixXd> disks_;
    MatrixXd sigma_, filled_;
};

}  // namespace koebe
