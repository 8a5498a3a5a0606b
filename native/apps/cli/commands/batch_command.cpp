// koebe batch INPUTS... --output FOLDER
#include "cli/commands/subcommand.h"
#include "cli/options/option_table.h"
#include "cli/options/uniformize_options.h"
#include "cli/options/validators.h"
#include "cli/options/wrong_usage.h"
#include "cli/process/end_with_input.h"
#include "cli/process/result_line.h"
#include "cli/process/standard_streams.h"
#include "exit_code.h"

#include "batch/batch_run.h"
#include "batch/file_list.h"
#include "batch/path_text.h"
#include "batch/program.h"
#include "batch/summary.h"
#include "core/counted.h"
#include "io/mesh_formats.h"

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <map>
#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace koebe::cli {
namespace {

namespace fs = std::filesystem;

constexpr const char* disk_domain = "disk";
const std::vector<std::string> domains{disk_domain, "torus", "ring", "sphere", "schottky"};

/// The choices of other domains that the disk does not have.
std::vector<const OptionRow*> domain_rows()
{
    std::vector<const OptionRow*> rows;
    for (const OptionRow& row : option_rows())
        if (row.kind == "choice" && !row.is_of("uniformize") &&
            std::ranges::any_of(domains, [&](const std::string& domain) { return row.is_of(domain); }))
            rows.push_back(&row);
    return rows;
}

/// Whether another domain has the disk's option, with the same kind.
bool has_too(const std::string& domain, const std::string& flag)
{
    return std::ranges::any_of(option_rows(), [&](const OptionRow& row) {
        const OptionRow* const of_disk = find_row("uniformize", row.name);
        return row.flag() == flag && row.is_of(domain) && of_disk != nullptr && of_disk->kind == row.kind;
    });
}

struct BatchRequest : MapRequest {
    std::vector<CLI::Option*> forwarded;           ///< a map's options
    std::map<std::string, std::string> of_domain;  ///< words of options that only other domains have
    std::string domain = disk_domain;
    bool cut = false;
    std::vector<std::string> inputs, blender_arguments;
    std::string folder, base, format = "obj", blender, blender_script;
    int workers = 0;
    double time_limit = 0.0, stale = 120.0;
    bool retry = false, list = false, no_summary = false, summary_only = false, exit_zero = false,
         ends_with_input = false;
};

void add_batch_options(CLI::App& app, BatchRequest& request)
{
    app.add_option("INPUTS", request.inputs, "mesh files, and folders to search with all their folders")->required();
    app.add_option("--output", request.folder,
                   "folder for the results. Each file keeps its path below its input folder, with a .json beside it")
        ->required()
        ->type_name("FOLDER");
    app.add_option("--base", request.base, "names are relative to this folder, for runs on single files of it")
        ->type_name("FOLDER");
    app.add_option("--workers", request.workers, "files at a time; 0: one for each core")
        ->check(whole_number(0))
        ->capture_default_str();
    app.add_option("--time-limit", request.time_limit, "most seconds for a file. By default there is no limit")
        ->check(number_in({.above = 0.0}))
        ->type_name("SECONDS");
    app.add_option("--format", request.format, "format of the written meshes")
        ->check(CLI::IsMember(io::format_names(io::FormatName::bare, true)))
        ->capture_default_str();
    app.add_flag("--retry", request.retry, "try meshes again that could not be mapped");
    app.add_option("--stale", request.stale, "seconds without a sign of life until another host's claim is taken over")
        ->check(number_in({.above = 0.0}))
        ->capture_default_str()
        ->type_name("SECONDS");
    CLI::Option* const list =
        app.add_flag("--list", request.list, "map nothing, print a line for each file: its folder, a tab, its name");
    CLI::Option* const none = app.add_flag("--no-summary", request.no_summary, "leave the table to another run");
    app.add_flag("--summary-only", request.summary_only, "map nothing, write the table of the results in the folder")
        ->excludes(list)
        ->excludes(none);
    app.add_flag("--exit-zero", request.exit_zero,
                 "for farms: exit code 0 even if a mesh was not mapped, 3 only if the machine failed");
    app.add_flag(end_with_input_flag, request.ends_with_input)->group("");
    app.add_flag("--quiet", request.quiet, "no line for each file and no result line");
    app.add_option("--domain", request.domain,
                   "the map of each file. disk: koebe uniformize; each other word: the command of this name")
        ->check(CLI::IsMember(domains))
        ->capture_default_str();
    for (const OptionRow* row : domain_rows()) {
        std::string& word = request.of_domain[std::string(row->name)] = row->choices().front();
        add_choice(app, *row, 0, [&word, row](int k) { word = row->choices()[static_cast<std::size_t>(k)]; });
    }
    const std::string group = "Files of Blender";
    app.add_option("--blender", request.blender, "map .blend files too, by this program and the add-on")
        ->type_name("PROGRAM")
        ->group(group);
    app.add_option("--blender-script", request.blender_script, "the add-on's batch.py, if it is not found")
        ->type_name("FILE")
        ->group(group);
    app.add_option("--blender-argument", request.blender_arguments,
                   "passed on to the add-on's batch.py; may be repeated: --blender-argument=--tube=unroll")
        ->type_name("WORD")
        ->group(group);
}

/// @throws CLI::ValidationError options of another domain
void check_domain(const CLI::App& app, const BatchRequest& request)
{
    for (const OptionRow* row : domain_rows())
        if (app.count(row->flag()) > 0 && !row->is_of(request.domain))
            throw CLI::ValidationError(row->flag(), "belongs to --domain " + std::string(row->maps));
    if (request.domain == disk_domain) return;
    for (const CLI::Option* option : request.forwarded)
        if (option->count() > 0 && !has_too(request.domain, option->get_name()))
            throw CLI::ValidationError(option->get_name(), "belongs to --domain disk");
}

/// The settings that a map depends on beside the mesh.
nlohmann::ordered_json recipe_options(const BatchRequest& request)
{
    nlohmann::ordered_json report = nlohmann::ordered_json::object();
    if (request.of_files.weld) report["weld"] = *request.of_files.weld;
    if (request.domain == disk_domain) {
        report.update(uniformize_report(request.options, request.cut));
        return report;
    }
    report["domain"] = request.domain;
    for (const auto& [name, word] : request.of_domain)
        if (find_row(request.domain, name) != nullptr) report[name] = word;
    report.update(option_report<SweepOptions>(request.domain, request.options));
    return report;
}

/// A map's options as given, for the processes that make it.
std::vector<std::string> given_words(const BatchRequest& request, bool with_threads)
{
    std::vector<std::string> words;
    for (const auto& [name, word] : request.of_domain)
        if (find_row(request.domain, name) != nullptr)
            words.push_back(find_row(request.domain, name)->flag() + "=" + word);
    for (const CLI::Option* option : request.forwarded) {
        if (option->count() == 0 || (!with_threads && option->check_name("--threads"))) continue;
        if (option->get_expected_max() == 0) {  // a flag
            if (option->as<bool>()) words.push_back(option->get_name());
            continue;
        }
        std::string value;
        for (const std::string& part : option->results()) value += (value.empty() ? "" : ",") + part;
        words.push_back(option->get_name() + "=" + value);
    }
    return words;
}

std::vector<std::string> map_command(const BatchRequest& request, const std::string& own_program,
                                     const batch::BatchFile& file, const batch::Scratch& scratch)
{
    std::vector<std::string> words{own_program, request.domain == disk_domain ? "uniformize" : request.domain,
                                   "--quiet", end_with_input_flag, "--json=" + batch::utf8(scratch.report)};
    for (std::string& word : given_words(request, true)) words.push_back(std::move(word));
    // Each worker has one core; a single map would take all cores.
    const bool says_threads = std::ranges::any_of(request.forwarded, [](const CLI::Option* option) {
        return option->count() > 0 && option->check_name("--threads");
    });
    const bool has_threads = request.domain == disk_domain || find_row(request.domain, "threads") != nullptr;
    if (has_threads && request.workers != 1 && !says_threads) words.emplace_back("--threads=1");
    words.insert(words.end(), {batch::utf8(file.source), batch::utf8(scratch.output)});
    return words;
}

std::vector<std::string> blend_command(const BatchRequest& request, const std::string& script,
                                       const batch::BatchFile& file, const batch::Scratch& scratch)
{
    std::vector<std::string> words{request.blender,
                                   "-b",
                                   batch::utf8(file.source),
                                   "--python-exit-code",
                                   "1",
                                   "-P",
                                   script,
                                   "--",
                                   end_with_input_flag,
                                   "--output",
                                   batch::utf8(scratch.output),
                                   "--report",
                                   batch::utf8(scratch.report)};
    if (request.domain != disk_domain) words.push_back("--domain=" + request.domain);
    for (std::string& word : given_words(request, true)) words.push_back(std::move(word));
    words.insert(words.end(), request.blender_arguments.begin(), request.blender_arguments.end());
    return words;
}

batch::FileList files_of(const BatchRequest& request)
{
    batch::ListOptions options;
    options.base = batch::path_of(request.base);
    options.output = batch::path_of(request.folder);
    options.extension = "." + request.format;
    options.with_blends = !request.blender.empty();
    for (const std::string& input : request.inputs) options.inputs.push_back(batch::path_of(input));
    try {
        return batch::list_files(options);
    } catch (const batch::UsageError& error) {
        throw WrongUsage(error.what());
    }
}

/// Prints the list of files that would be mapped.
void print_list(const batch::FileList& list)
{
    std::string text;
    for (const batch::BatchFile& file : list.files) {
        const std::string source = batch::generic_utf8(file.source);
        if (source.find_first_of("\t\r\n") != std::string::npos)
            throw WrongUsage("a tab or a line break is in the name " + source);
        text += source.substr(0, source.size() - file.name.size() - 1) + "\t" + file.name + "\n";
    }
    print(text);
}

batch::BatchOptions batch_options(const BatchRequest& request, const fs::path& output)
{
    batch::BatchOptions options;
    options.output = output;
    options.writes_summary = !request.no_summary;
    options.workers = request.workers > 0 ? static_cast<unsigned>(request.workers) : batch::core_count();
    options.stale = request.stale;
    options.mesh = {recipe_options(request), request.time_limit, request.retry};
    auto blend_words = given_words(request, false);
    if (request.domain != disk_domain) blend_words.insert(blend_words.begin(), "--domain=" + request.domain);
    blend_words.insert(blend_words.end(), request.blender_arguments.begin(), request.blender_arguments.end());
    options.blend = {{{"arguments", std::move(blend_words)}}, request.time_limit, request.retry};
    const std::string script = request.blender.empty() ? "" : batch::blender_script(request.blender_script);
    options.command = [&request, own = batch::own_program(), script](const auto& file, const auto& scratch) {
        return file.is_blend ? blend_command(request, script, file, scratch) : map_command(request, own, file, scratch);
    };
    options.tell = [&request](const std::string& line) {
        if (!request.quiet) std::fprintf(stderr, "%s\n", one_line(line).c_str());
    };
    return options;
}

std::string result_line(const batch::BatchCount& count, std::size_t total, const batch::BatchOptions& options)
{
    std::string line = counted(total, "file") + ": " + std::to_string(count.done) + " done";
    if (count.not_converged > 0) line += ", " + std::to_string(count.not_converged) + " not converged";
    if (count.failed > 0) line += ", " + std::to_string(count.failed) + " failed";
    if (count.unchanged > 0) line += " (" + std::to_string(count.unchanged) + " unchanged)";
    if (options.writes_summary) line += "; the table is " + batch::utf8(options.output / batch::summary_json);
    return one_line(line) + "\n";
}

int run_batch(const BatchRequest& request)
{
    if (request.ends_with_input) end_with_input();
    if (!request.quiet) require_standard_output();
    const batch::FileList list = files_of(request);
    if (list.blends_passed_over > 0 && !request.quiet)
        std::fprintf(stderr, "%s of Blender's skipped: give the Blender program with --blender\n",
                     counted(list.blends_passed_over, "file").c_str());
    if (list.files.empty()) throw WrongUsage("there is no mesh file in " + request.inputs.front());
    const fs::path output = fs::weakly_canonical(batch::path_of(request.folder));
    if (request.list) {
        print_list(list);
        return done;
    }
    if (request.summary_only) {
        batch::write_summary(output, request.stale);
        if (!request.quiet) print(one_line("the table is " + batch::utf8(output / batch::summary_json)) + "\n");
        return done;
    }
    const batch::BatchOptions options = batch_options(request, output);
    const batch::BatchCount count = run_batch(list.files, options);
    if (count.interrupted) {
        std::fputs("interrupted: finished files stay, and the same command continues from there\n", stderr);
        return interrupted;
    }
    if (!request.quiet) print(result_line(count, list.files.size(), options), "; the files are written");
    if (request.exit_zero) return count.lost > 0 ? cannot_be_mapped : done;
    return count.failed > 0 ? cannot_be_mapped : count.not_converged > 0 ? not_converged : done;
}

}  // namespace

Subcommand add_batch(CLI::App& app)
{
    auto request = std::make_shared<BatchRequest>();
    CLI::App* options = app.add_subcommand("batch", "map many files, each by a process of its own; go on after a stop");
    add_batch_options(*options, *request);
    const std::size_t before = options->get_options().size();
    add_uniformize_options(*options, request->options, request->cut);
    add_value(*options, *find_row("uniformize", "weld"), request->of_files.weld);
    const std::vector<CLI::Option*> all = options->get_options({});
    request->forwarded.assign(all.begin() + static_cast<std::ptrdiff_t>(before), all.end());
    options->callback([options, request] {
        check_uniformize_options(*options, request->options, request->cut);
        check_domain(*options, *request);
    });
    return {options, [request] { return run_batch(*request); }};
}

}  // namespace koebe::cli
