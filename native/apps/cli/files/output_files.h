// The files that a sub-command writes. They are checked before anything is read.
#pragma once

#include "io/mesh_writer.h"

#include <string>
#include <vector>

namespace koebe::cli {

struct OutputFile {
    std::string name;  ///< as in the usage: OUT, --json
    std::string path;  ///< empty: not requested
};

/// @throws CLI::ValidationError OUT does not have an extension of a format that can be written
const MeshFormat* required_format(const std::string& out);

inline constexpr const char* glb_extension = ".glb";

/// Requires different files. Files are compared on the disk, not by name; OUT may be an input.
/// @param inputs files that only OUT may replace
/// @param has_line whether a line goes to standard output
/// @throws CLI::ValidationError two outputs are the same file; an output is an input, or standard output if has_line
void require_different_files(const std::vector<OutputFile>& outputs, const std::vector<std::string>& inputs,
                             bool has_line);

/// @throws FileError one of the files cannot be written, or standard output is closed and has_line
void require_writable_files(const std::vector<OutputFile>& outputs, bool has_line);

}  // namespace koebe::cli
