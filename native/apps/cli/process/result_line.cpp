#include "cli/process/result_line.h"

#include "cli/process/standard_streams.h"
#include "core/counted.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cstdio>

namespace koebe::cli {
namespace {

constexpr std::size_t shown_bytes = 120;  // of a warning; the JSON has all of it

/// The start of a text, cut between two characters.
std::string shortened(const std::string& text)
{
    if (text.size() <= shown_bytes) return text;
    std::size_t end = shown_bytes;
    while (end > 0 && (static_cast<unsigned char>(text[end]) & 0xC0) == 0x80) --end;  // inside a UTF-8 character
    return text.substr(0, end) + "…";
}

}  // namespace

std::string one_line(std::string text)
{
    std::ranges::replace_if(
        text, [](unsigned char c) { return c < ' ' || c == 127; }, ' ');
    using Json = nlohmann::json;  // it detects bytes that are not UTF-8
    return Json::parse(Json(text).dump(-1, ' ', false, Json::error_handler_t::replace)).get<std::string>();
}

std::string warning_count(const std::vector<Warning>& warnings)
{
    if (warnings.empty()) return {};
    return ", " + counted(warnings.size(), "warning") + ": " + shortened(one_line(warnings.front().text()));
}

std::string last_words(double seconds, bool converged, const std::vector<Warning>& warnings)
{
    return ", " + formatted("%.2f", seconds) + " s" + (converged ? "" : ", not converged") + warning_count(warnings) +
           "\n";
}

void show_warnings(const std::vector<Warning>& warnings)
{
    if (!is_error_shown()) return;
    for (const Warning& warning : warnings) std::fprintf(stderr, "warning: %s\n", warning.text().c_str());
}

}  // namespace koebe::cli
