// A loop over numbers, shared by threads.
#pragma once

#include "execution/thread_share.h"

namespace koebe {

/// Calls work(i) for the numbers below `size`, in pieces (in_pieces). The calls must not change shared data.
template <class Number, class Work>
void each_in_pieces(Number size, const Work& work)
{
    constexpr std::size_t at_a_time = 16384;
    in_pieces(static_cast<std::size_t>(size), at_a_time, [&](std::size_t begin, std::size_t end) {
        for (Number i = static_cast<Number>(begin); i < static_cast<Number>(end); ++i) work(i);
    });
}

}  // namespace koebe
