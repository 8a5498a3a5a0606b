// What a file's name says of its format.
#pragma once

#include <filesystem>
#include <string>

namespace koebe::io {

/// A word with its ASCII letters small, whatever the locale.
inline std::string lower(std::string word)
{
    for (char& c : word)
        if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
    return word;
}

/// ".obj" of "scan.OBJ"; empty if there is none.
inline std::string lower_extension(const std::filesystem::path& path) { return lower(path.extension().string()); }

}  // namespace koebe::io
