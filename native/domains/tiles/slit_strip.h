// Maps a ring to a strip with slits as holes.
#pragma once

#include "tiles/flat_map.h"
#include "tiles/tile_map.h"

namespace koebe {

/// Makes the rims straight and the holes slits: u and v are the two harmonic functions.
/// @param holes concentric or radial @param height out: height over period
/// Without holes it is the tube's conformal map to a cylinder. Nothing is exponential in it, so any height will do.
FlatMap slit_strip(const PeriodicSurface& domain, RingHoles holes, double& height);

/// Of a ring's height over period.
struct ModulusBounds {
    double lower = 0.0, upper = 0.0;
};

/// Encloses the height of a ring. Let E be the Dirichlet energy. With f from 0 to 1 between the rims and g of period 1
/// round them, both constant on each hole, 1 / E(f) <= height <= E(g) [Dirichlet's principle, and conjugate functions],
/// for any such functions that are linear on the surface's faces. With concentric slits f is constant on holes, g is
/// free; with radial slits g is constant, f is free. With filled holes both are constant, however they are filled.
/// f and g are harmonic in the metric, which may be mollified; their energies are those on the faces as given.
ModulusBounds modulus_bounds(const PeriodicSurface& domain, RingHoles holes);

}  // namespace koebe
