// Entries of the inverse of a sparse matrix. For the .cpp files of linear/ only.
#pragma once

#include "linear/factor/supernodal_factor.h"

#include <vector>

namespace koebe::detail {

/// Blocks of A^-1, A = L L', for sets of rows; A has an entry between any two rows of a set. Goes from the root of the
/// elimination tree down: for a supernode of the columns J with the rows R below, Z_RJ = -Z_RR L_RJ L_JJ^-1 and Z_JJ =
/// L_JJ^-T L_JJ^-1 - (L_RJ L_JJ^-1)' Z_RJ (Takahashi, Fagan and Chin 1973; Erisman and Tinney 1975). Visits only the
/// supernodes from the sets up to the root.
/// @return for each set its block, rows and columns in the given order
std::vector<MatrixXd> selected_inverse(const SupernodalFactor& l, const std::vector<std::vector<Index>>& sets);

}  // namespace koebe::detail
