// The table of a batch, with one row per file, as JSON and as CSV.
#pragma once

#include "batch/claim.h"

#include <nlohmann/json.hpp>

#include <filesystem>

namespace koebe::batch {

inline constexpr const char* summary_json = "summary.json";
inline constexpr const char* summary_csv = "summary.csv";
/// Beside the results: holds claims and unfinished files.
inline constexpr const char* work_folder = ".koebe-batch";

/// A text as a field of CSV [RFC 4180].
std::string csv_field(const std::string& text);

/// The row of a file's report: name, exit_code, error, error_text, seconds, faces, flipped, below_resolution,
/// lost_area, angle_error_deg (the mean), warnings (their number), output, input_sha256, options, version. Unknown
/// values are null. A .blend has the sums over its islands, the mean of the angle error by faces, and the largest
/// lost_area.
nlohmann::ordered_json summary_row(const nlohmann::ordered_json& report);

/// Writes summary.json and summary.csv, each complete or not at all, with a row for every report in the folder.
/// Concurrent runs write one after another and then look for new reports, so the last table has all.
/// @throws FileError
void write_summary(const std::filesystem::path& folder, Claims& claims);
/// Writes the summary outside a run.
/// @param stale as in Claims
void write_summary(const std::filesystem::path& folder, double stale);

}  // namespace koebe::batch
