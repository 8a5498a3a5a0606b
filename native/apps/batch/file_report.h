// The report of one file of a batch: its result, and what the result was made of.
#pragma once

#include "batch/file_list.h"

#include <nlohmann/json.hpp>

#include <filesystem>
#include <optional>
#include <string>

namespace koebe::batch {

/// The settings that a result depends on, beside the mesh's bytes.
// NOLINTNEXTLINE(bugprone-exception-escape): JSON is moved without exceptions, by functions that could throw some
struct Recipe {
    nlohmann::ordered_json options;
    double time_limit = 0.0;  ///< seconds; 0: no limit
    bool retry = false;       ///< whether to try failed files again
};

/// The report at a path, if it is a batch's.
std::optional<nlohmann::ordered_json> read_report(const std::filesystem::path& path);

/// Whether a new run would give the same report: the bytes, options and version are the same, and the result is there
/// as it was written. A mesh that could not be mapped stays failed. Failures of the machine are tried again: a file
/// that cannot be read or written, a killed process, a time limit shorter than the present one.
bool is_current(const nlohmann::ordered_json& report, const BatchFile& file, const std::string& input_sha256,
                const Recipe& recipe);

/// Whether another try would give the same error.
bool is_lasting(const nlohmann::ordered_json& error, const Recipe& recipe);

/// The first entries of a report: version, name, input, input_sha256, options.
nlohmann::ordered_json report_head(const BatchFile& file, const std::string& input_sha256, const Recipe& recipe);

/// Writes {"name": "TopologyError", "kind": "closed", "reason": …} as "TopologyError(closed)".
std::string error_name(const nlohmann::ordered_json& error);

/// The error in the last line "NAME(KIND): reason" that a process has printed. Without such a line: its last line,
/// under the name `otherwise`.
nlohmann::ordered_json error_of_lines(const std::string& printed, const std::string& otherwise);

}  // namespace koebe::batch
