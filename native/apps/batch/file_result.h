// The temporary files of one mapping process. They are moved to their final places together with the report, or
// removed.
#pragma once

#include "batch/child_process.h"
#include "batch/claim.h"
#include "batch/file_report.h"

#include <nlohmann/json.hpp>

#include <filesystem>
#include <string>

namespace koebe::batch {

/// Paths that a process writes to. Its files are moved to their places once they are complete.
struct Scratch {
    std::filesystem::path output, report;
    std::filesystem::path log;  ///< the process's output
};

/// A file that this run is working on.
struct ClaimedFile {
    const BatchFile* file;
    std::string hash;  ///< of the file's bytes
    Claims::Claim claim;
    Scratch scratch;
    ProcessEnd end;
};

/// Makes the folder of the result, and removes what killed runs have left there.
Scratch make_scratch(const BatchFile& file, const Claims::Claim& claim);

/// Removes unfinished files, and releases the claim.
void remove_scratch(ClaimedFile& claimed) noexcept;

/// Moves the result and its report to their places. Without a result, keeps the failure.
/// @param folder of the batch
/// @returns the report
/// @throws FileError
nlohmann::ordered_json keep_result(const ClaimedFile& claimed, const Recipe& recipe,
                                   const std::filesystem::path& folder);

/// Writes the report of a mesh that could not be mapped, and removes a result made of other bytes.
/// @returns the report
/// @throws FileError
nlohmann::ordered_json keep_failure(const ClaimedFile& claimed, const Recipe& recipe,
                                    const nlohmann::ordered_json& error);

}  // namespace koebe::batch
