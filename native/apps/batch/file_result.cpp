#include "batch/file_result.h"

#include "batch/content_hash.h"
#include "batch/path_text.h"
#include "batch/process_outcome.h"
#include "batch/whole_file.h"
#include "exit_code.h"
#include "report/json.h"

#include <system_error>

namespace koebe::batch {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

/// Removes what killed runs have left in the folder of a .blend.
void remove_left_blends(const BatchFile& file, const Claims::Claim& claim)
{
    std::error_code error;
    const std::string begin = ".koebe-" + claim.key() + ".";
    for (fs::directory_iterator entry(file.output.parent_path(), error), end; !error && entry != end;) {
        const fs::path path = entry->path();
        entry.increment(error);
        std::error_code ignored;
        if (utf8(path.filename()).starts_with(begin)) fs::remove(path, ignored);
    }
}

}  // namespace

Scratch make_scratch(const BatchFile& file, const Claims::Claim& claim)
{
    const fs::path& work = claim.work();
    const fs::path folder = file.output.parent_path();
    std::error_code error;
    fs::create_directories(folder, error);
    // A .blend names other files relative to itself, so it is written in its final folder.
    if (file.is_blend) remove_left_blends(file, claim);
    return {file.is_blend ? folder / (".koebe-" + claim.word() + ".blend")
                          : work / ("result" + utf8(file.output.extension())),
            work / "report.json", work / "log"};
}

void remove_scratch(ClaimedFile& claimed) noexcept
{
    std::error_code error;
    fs::remove(claimed.scratch.output, error);
    if (claimed.file->is_blend) remove_left_blends(*claimed.file, claimed.claim);  // files that Blender wrote beside it
    claimed.claim.release();
}

Json keep_result(const ClaimedFile& claimed, const Recipe& recipe, const fs::path& folder)
{
    const BatchFile& file = *claimed.file;
    const Scratch& scratch = claimed.scratch;
    Json own = own_report(scratch.report);
    std::error_code error;
    if (own.empty() || !fs::is_regular_file(scratch.output, error))
        return keep_failure(claimed, recipe, {{"name", "Crash"}, {"reason", "its process wrote no result"}});
    Json report = report_head(file, claimed.hash, recipe);
    for (const char* name : {"name", "input", "options"}) own.erase(name);
    report.update(own);  // with its own hash, of the bytes that it read
    if (!own.contains("seconds")) report["seconds"] = {{"total", claimed.end.seconds}};
    report["exit_code"] = claimed.end.exit_status;
    report["output"] = generic_utf8(file.output.lexically_relative(folder));
    report["output_sha256"] = sha256_of_file(scratch.output);
    move_whole(scratch.output, file.output);
    write_whole(claimed.claim.work(), file.report, json_text(report));
    return report;
}

Json keep_failure(const ClaimedFile& claimed, const Recipe& recipe, const Json& error)
{
    const BatchFile& file = *claimed.file;
    Json report = report_head(file, claimed.hash, recipe);
    report["error"] = error;
    report["exit_code"] = cannot_be_mapped;
    report["seconds"] = {{"total", claimed.end.seconds}};
    std::error_code ignored;
    fs::create_directories(file.output.parent_path(), ignored);
    fs::remove(file.output, ignored);
    write_whole(claimed.claim.work(), file.report, json_text(report));
    return report;
}

}  // namespace koebe::batch
