// Entries of the inverse of a sparse matrix. For the .cpp files of linear/ only.
#pragma once

#include "linear/factor/supernodal_factor.h"

#include <vector>

namespace koebe::detail {

/// Blocks of A^-1, A = L L', for sets of rows between any two of which A has an entry: from the root of the elimination
/// tree down, Z_RJ = -Z_RR L_RJ L_JJ^-1 and Z_JJ = L_JJ^-T L_JJ^-1 - (L_RJ L_JJ^-1)' Z_RJ for a supernode of the
/// columns J with the rows R below them (Takahashi, Fagan and Chin 1973; Erisman and Tinney 1975). Only supernodes on
/// the way from the sets to the root are visited.
/// @return for each set its block, rows and columns in the order given
std::vector<MatrixXd> selected_inverse(const SupernodalFactor& l, const std::vector<std::vector<Index>>& sets);

}  // namespace koebe::detail
