// Numbers in sentences.
#pragma once

#include <cstdio>
#include <string>

namespace koebe {

/// Returns "1 face", "3 faces", "3 vertices".
inline std::string counted(std::size_t number, const std::string& noun)
{
    if (number == 1) return "1 " + noun;
    return std::to_string(number) + " " + (noun == "vertex" ? "vertices" : noun + "s");
}

/// The number in a printf format of at most 160 characters.
inline std::string formatted(const char* format, double number)
{
    char text[160];
    std::snprintf(text, sizeof text, format, number);
    return text;
}

}  // namespace koebe
