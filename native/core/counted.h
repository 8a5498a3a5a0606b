// Numbers with their nouns.
#pragma once

#include <string>

namespace koebe {

/// Returns "1 face", "3 faces", "3 vertices".
inline std::string counted(std::size_t number, const std::string& noun)
{
    if (number == 1) return "1 " + noun;
    return std::to_string(number) + " " + (noun == "vertex" ? "vertices" : noun + "s");
}

}  // namespace koebe
