// Packs disks side by side in a square.
#pragma once

#include "circles/circle.h"
#include "core/api.h"

#include <vector>

namespace koebe {

/// Disks of the given relative sizes, scaled to the largest size found at which they fit the square [0, 1]^2. Up to 16
/// disks are nested, each in the lowest place where it touches two walls or disks. More disks lie in rows, the largest
/// first. Bisection finds the size. One disk fills the square.
/// @param radii positive, any unit
/// @param margin between two disks, and half of it at the border, in units of the square; for many disks it is made
/// smaller, so that they have room
KOEBE_API std::vector<Circle> pack_disks(const std::vector<double>& radii, double margin = 0.02);

/// A margin in sides of the square. @param margin in pixels @param pixels along the square
/// @throws InputError it is negative or not finite, or there are no pixels
double margin_in_square(double margin, int pixels);

}  // namespace koebe
