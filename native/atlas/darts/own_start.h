// Where a piece without places begins: in a part that has its faces, or in a map of its own.
#pragma once

#include "execution/execution.h"
#include "flat/flat_part.h"

#include <vector>

namespace koebe {

/// Gives a piece without places those that it has in an uncut part of the same surface, or those of a map of its own,
/// whichever are more even.
void start_by_itself(const std::vector<FlatPart>& uncut, FlatPart& piece, ExecutionContext& context);

}  // namespace koebe
