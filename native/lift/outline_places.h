// Where outlines begin in a sheet.
#pragma once

#include "lift/flat_sheet.h"
#include "lift/outline.h"

#include <vector>

namespace koebe {

/// Finds the copy of each outline whose first point lies in the sheet, and its face. Others lie beyond the sheet's
/// border, in no face.
void locate_outlines(const FlatSheet& sheet, std::vector<DrawnOutline>& outlines);

/// Brings a place into the first period of a domain.
Complex first_copy(const std::vector<Complex>& periods, Complex z);

}  // namespace koebe
