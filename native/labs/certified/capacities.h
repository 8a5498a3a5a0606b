// Capacities of a surface between its boundary loops, and what follows from them, enclosed with proof.
#pragma once

#include "certified/condenser.h"
#include "certified/interval.h"
#include "core/api.h"
#include "core/types.h"
#include "core/warning.h"
#include "execution/execution.h"

#include <optional>
#include <string>
#include <vector>

namespace koebe {

struct CapacityOptions {
    std::optional<double> width;  ///< refine until no enclosure is wider; none: only the mesh's own faces
    int max_faces = 300000;       ///< refine to this many triangles at most
    int threads = 0;              ///< 0: all cores. Any number gives the same bounds
};

struct Capacity {
    Condenser condenser;
    Interval value;  ///< the least Dirichlet energy between 0 and 1, dimensionless
};

struct CapacityReport {
    std::vector<Capacity> capacities;
    /// Of a surface with two loops whose one capacity is C: 1 / C, the height of the conformal cylinder over its girth.
    std::optional<Interval> modulus;
    /// The conformal module (shape/conformal_module.h) of the loops in this order: of two loops exp(-2 pi / C), of
    /// three and four as enclose_module (certified/module_enclosure.h), if the condensers are those of loop_condensers.
    std::vector<Interval> module;
    std::vector<int> order;
    std::string no_module;               ///< why three loops or more have no enclosure of the module, or empty
    std::vector<Warning> warnings = {};  ///< of faces that were turned
    Index faces = 0;                     ///< of the finest triangulation
    int levels = 0;                      ///< triangulations that were solved on
    double width = 0.0;                  ///< of the widest enclosure
    bool converged = true;               ///< false: an enclosure is wider than wanted, but it still holds its number
};

/// The condensers that give a surface's conformal invariants, all loops held: each loop against the others, then each
/// pair against the others. A condenser is left out if an earlier one is the same with 0 and 1 exchanged. Their
/// capacities give the matrix of fluxes C_jk between loops, which has as many numbers: C_jj, and C_jk = (capacity of j
/// and k - C_jj - C_kk) / 2.
KOEBE_API std::vector<Condenser> loop_condensers(int loop_count);

/// Encloses the capacities of the polyhedral surface: the flat faces with exactly these vertices.
///
/// Upper bound: the energy of a function u with the condenser's values on the loops, quadratic on each triangle. Lower
/// bound: Phi^2 over the energy of a flux without sources, where Phi is the flux into the loops at 1 (Dirichlet's and
/// Thomson's principles). Any such u and any such flux give bounds. So an error of the linear solver makes the
/// enclosure wider, but never wrong. The flux is dg + c. g is quadratic on each triangle, and constant on each loop
/// through which nothing flows. c is constant on each triangle. It carries the fluxes of the loops along a tree of
/// faces, in multiples of one power of two, so that it has no sources exactly. Energies are summed in intervals
/// (interval.h) on exact places (bisected_surface.h).
///
/// Until the width is reached, the triangles with most of the gap are cut in four. The gap between the bounds is the
/// integral of |grad u - flux|^2 over all triangles (Prager and Synge 1947).
///
/// @param condensers by default those of loop_condensers
/// @throws InputError a condenser without loops at 0 or at 1, a loop that is there twice or does not exist (listed);
/// faces without area (listed); TopologyError as require_bordered_genus_zero; SolverError; Cancelled
KOEBE_API CapacityReport certified_capacities(const Vertices& vertices, const Triangles& triangles,
                                              const std::vector<Condenser>& condensers, const CapacityOptions& options,
                                              ExecutionContext& context);

}  // namespace koebe
