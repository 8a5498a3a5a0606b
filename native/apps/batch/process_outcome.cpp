#include "batch/process_outcome.h"

#include "batch/file_report.h"
#include "core/counted.h"
#include "exit_code.h"

#include <algorithm>
#include <csignal>
#include <fstream>
#include <string>

namespace koebe::batch {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

constexpr std::streamoff shown_log = 65536;  // bytes at the end of a log

std::string end_of_text(const fs::path& path)
{
    std::ifstream file(path, std::ios::binary | std::ios::ate);
    if (!file) return {};
    const std::streamoff size = file.tellg(), begin = std::max<std::streamoff>(size - shown_log, 0);
    std::string text(static_cast<std::size_t>(size - begin), '\0');
    file.seekg(begin);
    file.read(text.data(), static_cast<std::streamsize>(text.size()));
    return text;
}

Json end_error(const ProcessEnd& end, const fs::path& log, double time_limit)
{
    if (end.timed_out) {
        return {{"name", "TimeLimit"},
                {"reason", formatted("it was not done after %g seconds", time_limit)},
                {"seconds", time_limit}};
    }
    const auto by = [&](const char* name, const std::string& reason) {
        return Json{{"name", name}, {"reason", reason}};
    };
    if (end.signal == SIGKILL) return by("Killed", "its process was killed, as the system does when memory runs out");
    if (end.signal == SIGTERM || end.signal == SIGINT || end.signal == SIGHUP || end.exit_status == interrupted)
        return by("Killed", "its process was told to end");
    if (end.signal != 0) return by("Crash", "its process ended by signal " + std::to_string(end.signal));
    if (end.exit_status < 0 || end.exit_status > interrupted)
        return by("Crash", "its process ended with status " + std::to_string(end.exit_status));
    // These codes are the script's own: the log says why it refuses the file.
    return error_of_lines(end_of_text(log), end.exit_status <= not_converged ? "Refused" : "Crash");
}

}  // namespace

bool is_mapped(const ProcessEnd& end)
{
    return end.signal == 0 && !end.timed_out && (end.exit_status == done || end.exit_status == not_converged);
}

bool is_killed(const ProcessEnd& end)
{
    return !end.timed_out && (end.signal == SIGINT || end.signal == SIGTERM || end.signal == SIGHUP ||
                              end.signal == SIGKILL || (end.signal == 0 && end.exit_status == interrupted));
}

Json own_report(const fs::path& report)
{
    std::ifstream file(report, std::ios::binary);
    Json own = Json::parse(file, nullptr, false);
    return own.is_object() ? own : Json::object();
}

Json error_of(const ProcessEnd& end, const fs::path& report, const fs::path& log, double time_limit)
{
    if (end.signal == 0 && !end.timed_out)
        if (const Json own = own_report(report); own.contains("error") && own["error"].is_object()) return own["error"];
    return end_error(end, log, time_limit);
}

}  // namespace koebe::batch
