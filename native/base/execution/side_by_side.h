// Runs independent pieces of work on several threads.
#pragma once

#include "core/api.h"
#include "execution/execution.h"

#include <cstddef>
#include <functional>

namespace koebe {

/// Calls work(i, context) once for each i < count, on the calling thread and others, in any order. The calls must not
/// change shared data; then any number of threads gives the same results.
///
/// The contexts of the work report no progress. `context` does, from the calling thread, as the finished share: 1 at
/// the end.
/// @param threads at most; 0: as many as the machine has @param context as run_detachable gives it: without a poll
/// callback, as its checkpoints are reached on any thread
/// @throws Cancelled, and the exception of the lowest i that throws; no more work starts then
KOEBE_API void side_by_side(std::size_t count, int threads, ExecutionContext& context,
                            const std::function<void(std::size_t i, ExecutionContext& own)>& work);

}  // namespace koebe
