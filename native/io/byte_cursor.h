// Binary values out of a file in memory, in either byte order.
#pragma once

#include "core/errors.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cstring>
#include <string_view>

namespace koebe::io {

class ByteCursor {
public:
    ByteCursor(std::string_view bytes, std::size_t position, std::endian order)
        : rest_(bytes.substr(std::min(position, bytes.size()))), order_(order) {}

    std::size_t bytes_left() const { return rest_.size(); }

    /// @throws InputError the file ends before the value does
    template <typename T>
    T read()
    {
        std::array<char, sizeof(T)> raw;
        std::memcpy(raw.data(), take(sizeof(T)).data(), sizeof(T));
        if (order_ != std::endian::native) std::reverse(raw.begin(), raw.end());
        return std::bit_cast<T>(raw);
    }

    /// @throws InputError the file ends earlier
    void skip(std::size_t count) { take(count); }

private:
    std::string_view take(std::size_t count)
    {
        if (count > rest_.size()) throw InputError("the file ends in the middle of its data");
        const std::string_view taken = rest_.substr(0, count);
        rest_.remove_prefix(count);
        return taken;
    }

    std::string_view rest_;
    std::endian order_;
};

}  // namespace koebe::io
