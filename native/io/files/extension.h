// The format in a file's name.
#pragma once

#include <filesystem>
#include <string>

namespace koebe::io {

/// A word with its ASCII letters in lower case, in every locale.
inline std::string lower(std::string word)
{
    for (char& c : word)
        if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
    return word;
}

/// ".obj" of "scan.OBJ"; empty without an extension.
inline std::string lower_extension(const std::filesystem::path& path) { return lower(path.extension().string()); }

}  // namespace koebe::io
