// Independent pieces of work on several threads.
#pragma once

#include "core/api.h"
#include "execution/execution.h"

#include <cstddef>
#include <functional>

namespace koebe {

/// Calls work(i, context) once for each i < count, on the calling thread and others beside it, in no order that is
/// promised. The work must not share what it changes; then its results are the same for any number of threads.
///
/// The contexts of the work report no progress; `context` does, from the calling thread, as a share of what is done: 1
/// at the end.
/// @param threads at most; 0: as many as the machine has @param context as run_detachable gives it: one without a poll
/// callback, whose checkpoint any thread may reach
/// @throws Cancelled, and of what the work throws that of the lowest i; no more work is begun then
KOEBE_API void side_by_side(std::size_t count, int threads, ExecutionContext& context,
                            const std::function<void(std::size_t i, ExecutionContext& own)>& work);

}  // namespace koebe
