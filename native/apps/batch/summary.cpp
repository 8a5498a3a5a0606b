#include "batch/summary.h"

#include "batch/file_report.h"
#include "batch/whole_file.h"
#include "report/json.h"

#include <algorithm>
#include <map>
#include <string>
#include <system_error>

namespace koebe::batch {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

constexpr const char* claimed_name = "//summary";  // no file has this name

/// Sums over the parts of a result.
struct Figures {
    double faces = 0.0, flipped = 0.0, below_resolution = 0.0, lost_area = 0.0, angle_error = 0.0, angle_faces = 0.0;
    std::size_t warnings = 0;
    bool any = false;

    void add(const Json& part)
    {
        if (!part.contains("angle_error_deg")) return;
        any = true;
        const double part_faces = part.value("faces", 0.0);
        faces += part_faces;
        flipped += part.value("flipped", 0.0);
        below_resolution += part.value("below_resolution", 0.0);
        lost_area = std::max(lost_area, part.value("lost_area", 0.0));
        if (const Json& mean = part["angle_error_deg"]["mean"]; mean.is_number()) {
            angle_error += part_faces * mean.get<double>();
            angle_faces += part_faces;
        }
        if (part.contains("warnings")) warnings += part["warnings"].size();
    }
};

Json count(double number) { return static_cast<std::int64_t>(number); }

std::map<fs::path, fs::file_time_type> reports_in(const fs::path& folder)
{
    std::map<fs::path, fs::file_time_type> found;
    std::error_code error;
    for (fs::recursive_directory_iterator entry(folder, error), end; !error && entry != end; entry.increment(error)) {
        const fs::path& path = entry->path();
        const bool is_own = entry.depth() == 0 && path.filename() == summary_json;
        if (path.filename() == work_folder)
            entry.disable_recursion_pending();
        else if (path.extension() == ".json" && !is_own)
            found[path] = entry->last_write_time(error);
    }
    return found;
}

/// The rows in RFC 4180, with the names of the columns first.
std::string csv_text(const Json& rows)
{
    const auto line = [](const auto& fields) {
        std::string text;
        for (const auto& field : fields) text += (text.empty() ? "" : ",") + field;
        return text + "\r\n";
    };
    std::vector<std::string> fields;
    const Json columns = summary_row(Json::object());
    for (const auto& [name, value] : columns.items()) fields.push_back(name);
    std::string text = line(fields);
    for (const Json& row : rows) {
        fields.clear();
        for (const auto& [name, value] : row.items())
            fields.push_back(value.is_null()     ? ""
                             : value.is_string() ? csv_field(value.get<std::string>())
                                                 : csv_field(value.dump()));
        text += line(fields);
    }
    return text;
}

}  // namespace

std::string csv_field(const std::string& text)
{
    if (text.find_first_of(",\"\r\n") == std::string::npos) return text;
    std::string quoted = "\"";
    for (const char c : text) quoted.append(c == '"' ? 2 : 1, c);
    return quoted + "\"";
}

Json summary_row(const Json& report)
{
    Figures figures;
    figures.add(report);
    for (const char* parts : {"objects", "meshes"})  // of a .blend, of a .glb
        if (report.contains(parts))
            for (const Json& part : report[parts]) figures.add(part);
    const auto entry = [&](const char* name) { return report.contains(name) ? report[name] : Json(); };
    const Json error = entry("error"), seconds = entry("seconds");
    const auto known = [&](const Json& figure) { return figures.any ? figure : Json(); };
    return {{"name", entry("name")},
            {"exit_code", entry("exit_code")},
            {"error", error.is_object() ? Json(error_name(error)) : Json()},
            {"error_text", error.is_object() ? error.value("reason", Json()) : Json()},
            {"seconds", seconds.is_object() ? seconds.value("total", Json()) : seconds},
            {"faces", known(count(figures.faces))},
            {"flipped", known(count(figures.flipped))},
            {"below_resolution", known(count(figures.below_resolution))},
            {"lost_area", known(figures.lost_area)},
            {"angle_error_deg", figures.angle_faces > 0.0 ? Json(figures.angle_error / figures.angle_faces) : Json()},
            {"warnings", known(figures.warnings)},
            {"output", entry("output")},
            {"input_sha256", entry("input_sha256")},
            {"options", entry("options")},
            {"version", entry("version")}};
}

void write_summary(const fs::path& folder, double stale)
{
    Claims claims(folder / work_folder, stale);
    write_summary(folder, claims);
    claims.clean_up();
}

void write_summary(const fs::path& folder, Claims& claims)
{
    Claims::Claim claim = claims.wait(claimed_name);
    for (auto reports = reports_in(folder);;) {
        std::map<std::string, Json> rows;  // by name
        for (const auto& [path, time] : reports)
            if (const auto report = read_report(path)) {
                const std::string name = (*report)["name"].get<std::string>();
                rows[name] = summary_row(*report);
            }
        Json files = Json::array();
        for (auto& [name, row] : rows) files.push_back(std::move(row));
        claim.beat();
        write_whole(claim.work(), folder / summary_csv, csv_text(files));
        write_whole(claim.work(), folder / summary_json,
                    json_text({{"version", KOEBE_VERSION}, {"files", std::move(files)}}));
        auto now = reports_in(folder);
        if (now == reports) break;
        reports = std::move(now);
    }
    claim.release();
}

}  // namespace koebe::batch
