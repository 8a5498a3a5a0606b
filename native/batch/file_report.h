// The report of one file of a batch: what was made of it, and of what it was made.
#pragma once

#include "batch/file_list.h"

#include <nlohmann/json.hpp>

#include <filesystem>
#include <optional>
#include <string>

namespace koebe::batch {

/// What a result depends on beside the mesh's bytes.
// NOLINTNEXTLINE(bugprone-exception-escape): JSON is moved without exceptions, by functions that could throw some
struct Recipe {
    nlohmann::ordered_json options;
    double time_limit = 0.0;  ///< seconds; 0: none
    bool retry = false;       ///< try errors again
};

/// The report at a path, if it is one of a batch.
std::optional<nlohmann::ordered_json> read_report(const std::filesystem::path& path);

/// Whether a file's report says all that a new run would: the same bytes, options and version, and the result is there
/// as it was written. A mesh that could not be mapped stays so; what comes of the machine is tried again: a file that
/// cannot be read or written, a process that was killed, a time limit that was shorter than today's.
bool is_current(const nlohmann::ordered_json& report, const BatchFile& file, const std::string& input_sha256,
                const Recipe& recipe);

/// Whether the same would come of another try.
bool is_lasting(const nlohmann::ordered_json& error, const Recipe& recipe);

/// The head of a report: version, name, input, input_sha256, options.
nlohmann::ordered_json report_head(const BatchFile& file, const std::string& input_sha256, const Recipe& recipe);

/// {"name": "TopologyError", "kind": "closed", "reason": …} as "TopologyError(closed)".
std::string error_name(const nlohmann::ordered_json& error);

/// The error of a line "NAME(KIND): reason", the last such one of what a process has printed, or else its last line
/// under the name given.
nlohmann::ordered_json error_of_lines(const std::string& printed, const std::string& otherwise);

}  // namespace koebe::batch
