// The threads that a computation may use, known wherever it goes.
#pragma once

#include "core/api.h"
#include "core/not_copied.h"

#include <cstddef>
#include <functional>
#include <vector>

namespace koebe {

/// How many threads what runs on this thread may take, itself counted, for the object's lifetime. It is 1 where nothing
/// is said, and always in work that runs beside other work (side_by_side, each_beside).
class KOEBE_API ThreadShare : NotCopied {
public:
    /// @param threads 0: as many as the machine has
    explicit ThreadShare(int threads);
    ~ThreadShare();

    static int here();

private:
    int before_;
};

/// This thread has work beside others for the object's lifetime: its share is 1 whatever is said.
class BesideOthers : NotCopied {
public:
    BesideOthers();
    ~BesideOthers();

private:
    bool before_;
};

/// Calls work(i) once for each i < count, on this thread's share of threads. The work must not share what it changes:
/// then its results are the same for any number.
/// @throws of what the work throws that of the lowest i; no more work is begun then
KOEBE_API void each_beside(std::size_t count, const std::function<void(std::size_t i)>& work);

/// Calls work(begin, end) for the pieces of [0, size) of `length` each, the last one shorter: the same ones for any
/// number of threads.
KOEBE_API void in_pieces(std::size_t size, std::size_t length,
                         const std::function<void(std::size_t begin, std::size_t end)>& work);

/// Calls work(begin, end) for ranges of [0, size), one for each of this thread's share of threads: for work that looks
/// at all there is and does what concerns its range, in the order of one range. Then its results do not depend on how
/// many ranges there are.
KOEBE_API void in_ranges(std::size_t size, const std::function<void(std::size_t begin, std::size_t end)>& work);

/// The numbers below `size` that a test finds, ascending.
template <class Number, class Test>
std::vector<Number> found_in_pieces(Number size, const Test& test)
{
    constexpr std::size_t at_a_time = 32768;
    const std::size_t all = static_cast<std::size_t>(size);
    std::vector<std::vector<Number>> found((all + at_a_time - 1) / at_a_time);
    in_pieces(all, at_a_time, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i)
            if (test(static_cast<Number>(i))) found[begin / at_a_time].push_back(static_cast<Number>(i));
    });
    std::vector<Number> result;
    for (const std::vector<Number>& some : found) result.insert(result.end(), some.begin(), some.end());
    return result;
}

}  // namespace koebe
