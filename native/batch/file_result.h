// What the process of a file writes: where, and how it gets to its place with a report, or is cleared away.
#pragma once

#include "batch/child_process.h"
#include "batch/claim.h"
#include "batch/file_report.h"

#include <nlohmann/json.hpp>

#include <filesystem>
#include <string>

namespace koebe::batch {

/// Where a process is to write. All of it is moved to its place once it is whole.
struct Scratch {
    std::filesystem::path output, report;
    std::filesystem::path log;  ///< what it prints
};

/// A file that this run has in hand.
struct ClaimedFile {
    const BatchFile* file;
    std::string hash;  ///< of its bytes
    Claims::Claim claim;
    Scratch scratch;
    ProcessEnd end;
};

/// Makes the folder of the result, and clears away what runs that were killed have left there.
Scratch make_scratch(const BatchFile& file, const Claims::Claim& claim);

/// Removes what is not in its place, and releases the claim.
void remove_scratch(ClaimedFile& claimed) noexcept;

/// The result and its report moved to their places. Without a result its failure is kept.
/// @param folder of the batch
/// @returns the report
/// @throws FileError
nlohmann::ordered_json keep_result(const ClaimedFile& claimed, const Recipe& recipe,
                                   const std::filesystem::path& folder);

/// The report of a mesh that could not be mapped, in place of a result that was made of other bytes.
/// @returns the report
/// @throws FileError
nlohmann::ordered_json keep_failure(const ClaimedFile& claimed, const Recipe& recipe,
                                    const nlohmann::ordered_json& error);

}  // namespace koebe::batch
