// Weights of vertices that a caller gives.
#pragma once

#include "core/types.h"

#include <string>
#include <vector>

namespace koebe {

inline bool is_weight(double number) { return number >= 0.0 && number <= 1.0; }

/// @param name with its article, for messages @param weights (V), or empty
/// @throws InputError weights for another number of vertices, or not from 0 to 1: with these vertices
void require_weights(const std::string& name, const std::vector<double>& weights, Index vertex_count);

}  // namespace koebe
