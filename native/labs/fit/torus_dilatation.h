// The Teichmueller distance of flat tori.
#pragma once

#include "core/api.h"
#include "core/types.h"

namespace koebe {

/// K of the extremal map between two flat tori, over all markings: exp of the hyperbolic distance of their moduli in
/// the upper half-plane, least over the modular group.
/// @param a, b ratios of periods, above the real axis @throws InputError
KOEBE_API double torus_dilatation(Complex a, Complex b);

}  // namespace koebe
