// Lists the files of a batch and their names in the output folder.
#pragma once

#include <filesystem>
#include <stdexcept>
#include <string>
#include <vector>

namespace koebe::batch {

/// Inputs that cannot form one batch: wrong usage by the caller.
class UsageError : public std::runtime_error {
    using std::runtime_error::runtime_error;
};

struct BatchFile {
    std::filesystem::path source;  ///< absolute
    std::string name;              ///< path below the given folder, with "/": "masks/a.obj"
    std::filesystem::path output;  ///< absolute
    std::filesystem::path report;  ///< the output's name with .json in place of its extension
    bool is_blend = false;
};

struct ListOptions {
    std::vector<std::filesystem::path> inputs;  ///< mesh files, and folders whose files are all taken
    std::filesystem::path base;                 ///< names are relative to it; empty: to each input folder
    std::filesystem::path output;               ///< the folder
    std::string extension = ".obj";             ///< of results; .blend keeps its own
    bool keeps_scenes = true;                   ///< whether .glb keeps its own, too
    bool with_blends = false;
};

struct FileList {
    std::vector<BatchFile> files;        ///< by name
    std::size_t blends_passed_over = 0;  ///< in folders, if with_blends is false
};

/// Searches folders and their subfolders, except hidden ones, links to folders, and the output folder.
/// @throws UsageError an input is missing, is not a mesh file or lies outside the base; two files would get one name,
/// or a report the name of a mesh or of the summary
/// @throws FileError a folder cannot be read
FileList list_files(const ListOptions& options);

}  // namespace koebe::batch
