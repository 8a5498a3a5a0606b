// Memory for the updates that pieces pass to their separators. For the .cpp files of linear/ only.
#pragma once

#include "core/types.h"
#include "linear/large_array.h"

#include <algorithm>
#include <mutex>
#include <utility>
#include <vector>

namespace koebe::detail {

/// A square matrix; only its lower triangle is set.
struct LowerMatrix {
    LargeArray numbers;
    std::size_t room = 0;
    Index size = 0;

    double* column(Index c) const { return numbers.data() + static_cast<std::ptrdiff_t>(c) * size; }
};

/// Hands out zero matrices. It reuses memory that was given back, because new memory costs time page by page.
class RestPool {
public:
    LowerMatrix take(Index size)
    {
        const std::size_t room = static_cast<std::size_t>(size) * static_cast<std::size_t>(size);
        LowerMatrix result = smallest_with(room);
        if (result.room < room) {
            result.numbers = LargeArray(room);
            result.room = room;
        }
        result.size = size;
        for (Index c = 0; c < size; ++c) std::fill(result.column(c) + c, result.column(c) + size, 0.0);
        return result;
    }

    void give_back(LowerMatrix matrix)
    {
        const std::scoped_lock lock(mutex_);
        free_.push_back(std::move(matrix));
    }

private:
    LowerMatrix smallest_with(std::size_t room)
    {
        const std::scoped_lock lock(mutex_);
        auto best = free_.end();
        for (auto m = free_.begin(); m != free_.end(); ++m)
            if (m->room >= room && (best == free_.end() || m->room < best->room)) best = m;
        if (best == free_.end()) return {};
        std::swap(*best, free_.back());
        LowerMatrix result = std::move(free_.back());
        free_.pop_back();
        return result;
    }

    std::mutex mutex_;
    std::vector<LowerMatrix> free_;
};

}  // namespace koebe::detail
