// The format in a file's name.
#pragma once

#include <algorithm>
#include <array>
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

/// Whether its name is that of a mesh file.
inline bool is_mesh_file(const std::filesystem::path& path)
{
    constexpr std::array extensions{".obj", ".off", ".ply", ".stl", ".glb"};
    return std::ranges::find(extensions, lower_extension(path)) != extensions.end();
}

}  // namespace koebe::io
