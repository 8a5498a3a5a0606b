// Where outlines begin in a sheet.
#pragma once

#include "lift/flat_sheet.h"
#include "lift/outline.h"

#include <vector>

namespace koebe {

/// A place in a sheet. Added to the place that was asked for, `shift` leads to the copy that lies in the sheet.
struct SheetPlace {
    Index face = -1;  ///< -1: the place lies beyond the sheet's border
    Complex shift{0.0, 0.0};
    Eigen::RowVector3d weights{1.0, 0.0, 0.0};
};

/// Finds the copies of places in the UVs that lie in the sheet. @param near a place may be so far outside
std::vector<SheetPlace> places_in_sheet(const FlatSheet& sheet, const std::vector<Complex>& places, double near);

/// Finds the copy of each outline whose first point lies in the sheet, and its face. Others lie beyond the sheet's
/// border, in no face.
void locate_outlines(const FlatSheet& sheet, std::vector<DrawnOutline>& outlines);

/// Brings a place into the first period of a domain.
Complex first_copy(const std::vector<Complex>& periods, Complex z);

}  // namespace koebe
