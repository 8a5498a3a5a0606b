#include "cli/files/output_files.h"

#include "cli/process/standard_streams.h"
#include "files/atomic_file.h"
#include "files/descriptor.h"
#include "files/file_identity.h"

#include <CLI/CLI.hpp>

#include <filesystem>

namespace koebe::cli {

const MeshFormat* required_format(const std::string& out)
{
    if (const MeshFormat* const format = written_format(out)) return format;
    const std::string extension = std::filesystem::path(out).extension().string();
    throw CLI::ValidationError("OUT", (extension.empty() ? "'" + out + "' names no format"
                                                         : "the format '" + extension + "' cannot be written") +
                                          ": OUT must end in " + io::listed_formats(io::FormatName::extension, true));
}

void require_different_files(const std::vector<OutputFile>& outputs, const std::vector<std::string>& inputs,
                             bool has_line)
{
    for (std::size_t i = 0; i < outputs.size(); ++i) {
        const auto& [name, path] = outputs[i];
        if (path.empty()) continue;
        for (std::size_t j = 0; j < i; ++j)
            if (!outputs[j].path.empty() && io::same_file(path, outputs[j].path))
                throw CLI::ValidationError(outputs[j].name + " and " + name, "must be different files");
        for (const std::string& input : inputs)
            if (name != "OUT" && io::same_file(path, input))
                throw CLI::ValidationError(name, "is the mesh '" + input + "' itself");
        if (has_line && io::is_open_as(standard_output, path))
            throw CLI::ValidationError(name, "is standard output, where the result line goes");
    }
}

void require_writable_files(const std::vector<OutputFile>& outputs, bool has_line)
{
    if (has_line) require_standard_output();
    for (const OutputFile& output : outputs)
        if (!output.path.empty()) require_writable(output.path);
}

}  // namespace koebe::cli
