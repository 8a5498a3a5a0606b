// Lattices of shapes in the plane, and how they fit a period or two.
#pragma once

#include "core/types.h"

#include <string>
#include <vector>

namespace koebe {

/// A pattern that repeats along a and b. The middles of neighbouring cells are 1 apart.
struct Lattice {
    Complex a, b;
    std::vector<std::vector<Complex>> shapes;          ///< of one cell, counter-clockwise
    int columns = 1;                                   ///< repeats in the direction of the real axis along a
    std::vector<std::vector<Complex>> other_shapes{};  ///< if there are: of half of the cells, at random
};

/// The lattice of a built-in pattern: hexagons, triangles, diamonds, stripes, truchet, or circles in rows. Truchet's
/// cells have two quarters of a ring about opposite corners [Truchet 1704; Smith 1987].
/// @param bridge between shapes, for cells of size 1: from 0 to below 1
/// @param along whether stripes run along the real axis, and not across it
Lattice lattice_of(const std::string& pattern, double bridge, bool along = false);

/// A lattice laid over a domain: the shapes around each place, and these places.
struct LaidLattice {
    std::vector<std::vector<Complex>> shapes, other_shapes;
    std::vector<Complex> places;
    double unit = 1.0;  ///< length of the middles' distance 1
    double bend = 1.0;  ///< longest over shortest image of a unit vector: above 1 the lattice is no longer regular
};

/// @param periods of the domain: none, one along the real axis, or two
/// @param size of a cell in the plane @param repeats round the one period; 0: it follows from the size
/// @param low, high corners of the domain's bounding box, with one period between the rims
/// @throws InputError a number of repeats that does not fit the lattice (the message has the nearest); too many cells
LaidLattice lay_lattice(const Lattice& lattice, const std::vector<Complex>& periods, double size, int repeats,
                        Complex low, Complex high);

/// A convex polygon after three rounds in which all corners are cut off [Chaikin 1974].
std::vector<Complex> rounded_corners(std::vector<Complex> polygon);

}  // namespace koebe
