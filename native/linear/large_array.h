// Memory for the numbers of a factor. For the .cpp files of this folder only.
#pragma once

#include <cstddef>
#include <cstdlib>
#include <memory>
#include <new>

#if defined(__linux__)
#include <sys/mman.h>
#endif

namespace koebe::detail {

/// Numbers that nobody has set yet, in large pages where the system has them: they are touched by the thread that fills
/// them first.
class LargeArray {
public:
    LargeArray() = default;
    /// @throws std::bad_alloc
    explicit LargeArray(std::size_t count)
    {
#if defined(__linux__)
        constexpr std::size_t page = std::size_t{2} << 20;
        const std::size_t bytes = (sizeof(double) * count + page - 1) / page * page;
        numbers_.reset(static_cast<double*>(std::aligned_alloc(page, bytes)));
        if (numbers_) madvise(numbers_.get(), bytes, MADV_HUGEPAGE);
#else
        numbers_.reset(static_cast<double*>(std::malloc(sizeof(double) * count)));
#endif
        if (!numbers_) throw std::bad_alloc();
    }
    double* data() const { return numbers_.get(); }

private:
    struct Free {
        void operator()(double* numbers) const { std::free(numbers); }
    };
    std::unique_ptr<double, Free> numbers_;
};

}  // namespace koebe::detail
