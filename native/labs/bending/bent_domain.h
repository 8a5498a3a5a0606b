// A circle domain whose faces bend while its rims lie on given circles.
#pragma once

#include "bending/circle_bending.h"
#include "foldover/foldover_free.h"

#include <vector>

namespace koebe {

/// Minimizes the energy of bend_along. Points are the (V) of the input, with the centre of each circle behind them.
class BentDomain {
public:
    /// @param input, context must outlive the domain @param circles the first ones
    BentDomain(const BendingInput& input, const std::vector<Circle>& circles, ExecutionContext& context);

    const PlanarPoints& start() const { return start_; }
    const std::vector<Index>& rim() const { return rim_; }                  ///< vertices on circles, loop by loop
    const std::vector<std::size_t>& rim_loops() const { return loop_of_; }  ///< of each of these
    int newton_steps() const { return newton_steps_; }

    /// Puts the rims exactly onto circles, and the middles of fans to their centres.
    void put_on(const std::vector<Circle>& circles, PlanarPoints& uv) const;

    /// (V + loops) 1: a corner of a face that is turned over.
    std::vector<char> folded_corners(const PlanarPoints& uv) const;

    /// Whether no face is turned over, and each rim runs once round its circle.
    bool is_one_to_one(const PlanarPoints& uv, const std::vector<Circle>& circles) const;

    /// Takes Newton steps. They may begin with faces that are turned over.
    /// @param uv in, out: stays if the result is not one to one @return whether it is one to one
    bool unfold(PlanarPoints& uv, const std::vector<Circle>& circles);

    /// At most so many Newton steps that turn no face over. @return whether the energy settled
    bool relax(PlanarPoints& uv, const std::vector<Circle>& circles, int steps);

    /// Bounds the faces' areas from below, so that they stay upright as 32-bit UVs, as far as they are now.
    void set_floors(const PlanarPoints& uv);

    /// Lowers the largest |mu|, with so many Newton steps for each power.
    void lower_the_largest(const Extremal& extremal, PlanarPoints& uv, const std::vector<Circle>& circles, int steps);

private:
    void add_fan(std::size_t k, double total);
    std::vector<Index> folded(const PlanarPoints& uv) const;
    bool rims_in_order(const PlanarPoints& uv, const std::vector<Circle>& circles) const;
    FoldoverOptions gentle(int steps) const;
    FoldoverResult minimize(PlanarPoints& uv, const std::vector<Circle>& circles, const FoldoverOptions& options);

    const BendingInput& input_;
    ExecutionContext& context_;
    FoldoverProblem problem_;
    Eigen::Index face_count_ = 0;  // of the problem's triangles, before those of the rims
    PlanarPoints start_;
    std::vector<Index> rim_;
    std::vector<std::size_t> loop_of_;
    int newton_steps_ = 0;
};

}  // namespace koebe
