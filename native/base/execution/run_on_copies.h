// Abandonable computations on copies of their arguments.
#pragma once

#include "execution/detachable_run.h"

namespace koebe {

/// run_detachable of compute(arguments..., context), with copies of the arguments: it may outlive the call.
template <class Result, class Compute, class... Arguments>
Result run_on_copies(ExecutionContext& context, const Compute& compute, const Arguments&... arguments)
{
    return run_detachable<Result>(
        context, [compute, ... own = arguments](ExecutionContext& inner) { return compute(own..., inner); });
}

}  // namespace koebe
