#include "certified/flux_tree.h"

#include "core/connectivity.h"
#include "core/errors.h"

#include <cmath>

namespace koebe {

FluxTree::FluxTree(const BisectedSurface& surface)
    : surface_(surface), gate_(surface.loop_count(), no_twin), towards_root_(surface.face_count(), no_twin)
{
    for (Index h = 0; h < static_cast<Index>(surface.twin().size()); ++h)
        if (surface.twin()[h] == no_twin) gate_[surface.loop_of()[origin(surface.triangles(), h)]] = h;
    std::vector<char> met(surface.face_count(), 0);
    order_.push_back(0);
    met[0] = 1;
    for (std::size_t head = 0; head < order_.size(); ++head)
        for (Index h = 3 * order_[head]; h < 3 * order_[head] + 3; ++h) {
            const Index twin = surface.twin()[h];
            if (twin == no_twin || met[face_of(twin)]) continue;
            met[face_of(twin)] = 1;
            towards_root_[face_of(twin)] = twin;
            order_.push_back(face_of(twin));
        }
}

OneForm FluxTree::carry(const VectorXd& out_of_loop) const
{
    OneForm flux = OneForm::Zero(static_cast<Eigen::Index>(surface_.twin().size()));
    for (std::size_t k = 0; k < gate_.size(); ++k) flux[gate_[k]] = out_of_loop[static_cast<Eigen::Index>(k)];
    for (std::size_t i = order_.size(); i-- > 1;) {
        const Index h = towards_root_[order_[i]];
        flux[h] = -(flux[next_halfedge(h)] + flux[previous_halfedge(h)]);
        flux[surface_.twin()[h]] = -flux[h];
    }
    return flux;
}

VectorXd rounded_fluxes(VectorXd flux, const std::vector<int>& held)
{
    const double largest = flux.cwiseAbs().maxCoeff();
    if (!(largest > 0.0 && std::isfinite(largest))) throw SolverError("no flux runs between the loops of a condenser");
    const double unit = std::ldexp(1.0, std::ilogb(largest) - 40);
    double sum = 0.0;
    for (const int k : held) sum += flux[k] = std::nearbyint(flux[k] / unit) * unit;
    flux[held.back()] -= sum;
    return flux;
}

}  // namespace koebe
