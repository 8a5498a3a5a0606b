// The words of an enumeration, as in reports and options.
#pragma once

#include <array>
#include <cstddef>

namespace koebe {

/// @param words of the enumerators from the first, 0, on
template <typename Enum, std::size_t count>
constexpr const char* word_of(Enum value, const std::array<const char*, count>& words) noexcept
{
    const auto place = static_cast<std::size_t>(value);
    return place < count ? words[place] : "unknown";
}

}  // namespace koebe
