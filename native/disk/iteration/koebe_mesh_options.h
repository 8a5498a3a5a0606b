// The options of the mesh engine alone: the paper's own choices, where the default is another.
#pragma once

#include "conformal/annulus_map.h"
#include "iteration/sweep_order.h"

namespace koebe {

struct KoebeMeshOptions {
    /// The metric that a step takes for the surface and the disks that stay filled.
    enum class Metric {
        first,           ///< of the surface, and of each disk when it was filled: conformal maps change neither
        planar,          ///< of the last step's image in the plane, as in print: each step adds its O(h^2)
        reflected,       ///< planar, after the reflection tau in a circle inside a hole that the next step opens, as in
                         ///< print
        reflected_last,  ///< the same inside the hole that was opened last, around 0; not with CK
    };
    Metric metric = Metric::first;
    Partners partners = Partners::fixed;
    /// The loops that each step of a sweep opens, by their place in the order of the loops: pairs, with CK single
    /// loops. Empty: the method's own order.
    Sweep schedule;
    /// How GK's annuli, and the annulus of the Riemann map, are mapped: by 1-forms (section 4.2) or by the discrete
    /// Yamabe flow (abstract). The flow needs one metric on the whole, so it excludes Metric::first.
    AnnulusBackend annulus = AnnulusBackend::harmonic;
    bool record_steps = false;  ///< keep each step's own image (KoebeOutcome::step_images)
};

}  // namespace koebe
