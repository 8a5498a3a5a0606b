// Takes stretch out of a flat part.
#pragma once

#include "core/types.h"
#include "execution/execution.h"
#include "parts/flat_part.h"

namespace koebe {

/// Unfolds the part face by face, and takes the result if it is one to one and less stretched. Then relaxes it as long
/// as that helps.
void stretch_less(FlatPart& part, ExecutionContext& context);

}  // namespace koebe
