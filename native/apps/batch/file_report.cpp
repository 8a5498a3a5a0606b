#include "batch/file_report.h"

#include "batch/content_hash.h"
#include "batch/path_text.h"
#include "files/file_error.h"

#include <fstream>
#include <regex>
#include <sstream>

namespace koebe::batch {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

bool is_there_as_written(const fs::path& output, const Json& report)
{
    try {
        return report.value("output_sha256", "") == sha256_of_file(output);
    } catch (const FileError&) {
        return false;
    }
}

}  // namespace

std::optional<Json> read_report(const fs::path& path)
{
    std::ifstream file(path, std::ios::binary);
    Json report = Json::parse(file, nullptr, false);
    const auto is_text = [&](const char* name) { return report.contains(name) && report[name].is_string(); };
    if (!report.is_object() || !is_text("name") || !is_text("input_sha256") || !report.contains("exit_code")) return {};
    return report;
}

bool is_lasting(const Json& error, const Recipe& recipe)
{
    const std::string name = error.value("name", "");
    if (recipe.retry || name == "FileError" || name == "Killed" || name == "NativeError") return false;
    if (name != "TimeLimit") return true;
    return recipe.time_limit > 0.0 && recipe.time_limit <= error.value("seconds", 0.0);
}

bool is_current(const Json& report, const BatchFile& file, const std::string& input_sha256, const Recipe& recipe)
{
    const Json head = report_head(file, input_sha256, recipe);
    for (const char* name : {"version", "input_sha256", "options"})
        if (!report.contains(name) || report[name] != head[name]) return false;
    if (const auto error = report.find("error"); error != report.end() && error->is_object())
        return is_lasting(*error, recipe);
    return is_there_as_written(file.output, report);
}

Json report_head(const BatchFile& file, const std::string& input_sha256, const Recipe& recipe)
{
    return {{"version", KOEBE_VERSION},
            {"name", file.name},
            {"input", utf8(file.source.filename())},
            {"input_sha256", input_sha256},
            {"options", recipe.options}};
}

std::string error_name(const Json& error)
{
    const std::string name = error.value("name", "Error");
    return error.contains("kind") && error["kind"].is_string() ? name + "(" + error["kind"].get<std::string>() + ")"
                                                               : name;
}

Json error_of_lines(const std::string& printed, const std::string& otherwise)
{
    static const std::regex form(R"(([A-Z]\w*)(?:\((\w+)\))?: (.*))");
    std::istringstream lines(printed);
    std::string last;
    Json error;
    for (std::string line; std::getline(lines, line);) {
        if (!line.empty() && line.back() == '\r') line.pop_back();
        if (line.empty()) continue;
        last = line.substr(0, 1000);  // std::regex recurses for each character
        std::smatch part;
        if (!std::regex_match(last, part, form)) continue;
        error = {{"name", part[1].str()}};
        if (part[2].matched) error["kind"] = part[2].str();
        error["reason"] = part[3].str();
    }
    if (error.is_null()) error = {{"name", otherwise}, {"reason", last}};
    return error;
}

}  // namespace koebe::batch
