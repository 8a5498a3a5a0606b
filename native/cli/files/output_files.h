// The files that a sub-command writes, checked before anything is read.
#pragma once

#include "io/mesh_writer.h"

#include <string>
#include <vector>

namespace koebe::cli {

struct OutputFile {
    std::string name;  ///< as the usage has it: OUT, --json
    std::string path;  ///< empty if it is not wanted
};

/// @throws CLI::ValidationError OUT has no extension of a format that can be written
WrittenFormat required_format(const std::string& out);

/// Files are the same if they are one on the disk, whatever they are called; OUT may be an input.
/// @param inputs files that only OUT may replace
/// @param has_line whether a line goes to standard output
/// @throws CLI::ValidationError two of the files are one, or one is an input or where the line goes
void require_different_files(const std::vector<OutputFile>& outputs, const std::vector<std::string>& inputs,
                             bool has_line);

/// @throws FileError one of the files cannot be written, or standard output is closed and has_line
void require_writable_files(const std::vector<OutputFile>& outputs, bool has_line);

}  // namespace koebe::cli
