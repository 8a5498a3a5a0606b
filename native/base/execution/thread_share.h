// The number of threads that a computation may use, known to all its functions.
#pragma once

#include "core/api.h"
#include "core/not_copied.h"

#include <cstddef>
#include <functional>
#include <vector>

namespace koebe {

/// Sets the number of threads for work on this thread, itself included, for the object's lifetime. It is 1 by default,
/// and always in work that runs beside other work (side_by_side, each_beside).
class KOEBE_API ThreadShare : NotCopied {
public:
    /// @param threads 0: as many as the machine has
    explicit ThreadShare(int threads);
    ~ThreadShare();

    static int here();

private:
    int before_;
};

/// This thread works beside others for the object's lifetime: its share is always 1.
class BesideOthers : NotCopied {
public:
    BesideOthers();
    ~BesideOthers();

private:
    bool before_;
};

/// Calls work(i) once for each i < count, on this thread's share of threads. The calls must not change shared data;
/// then any number of threads gives the same results.
/// @throws the exception of the lowest i that throws; no more work starts then
KOEBE_API void each_beside(std::size_t count, const std::function<void(std::size_t i)>& work);

/// Calls work(begin, end) for the pieces of [0, size) of `length` each, the last one shorter. Any number of threads has
/// the same pieces.
KOEBE_API void in_pieces(std::size_t size, std::size_t length,
                         const std::function<void(std::size_t begin, std::size_t end)>& work);

/// Calls work(begin, end) for ranges of [0, size), one for each of this thread's share of threads. Such work looks at
/// all data, and handles what concerns its range in the order of a single range. Then results do not depend on the
/// number of ranges.
KOEBE_API void in_ranges(std::size_t size, const std::function<void(std::size_t begin, std::size_t end)>& work);

/// The numbers below `size` that pass a test, ascending.
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
