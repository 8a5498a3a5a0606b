// Memory for the values of a factor. For the .cpp files of this folder only.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdlib>
#include <memory>
#include <new>

namespace koebe::detail {

/// An uninitialized array: the system makes a page of it in the thread that first writes there.
class LargeArray {
public:
    LargeArray() = default;
    /// @throws std::bad_alloc
    explicit LargeArray(std::size_t count)
        : numbers_(static_cast<double*>(std::malloc(sizeof(double) * std::max<std::size_t>(count, 1))))
    {
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
