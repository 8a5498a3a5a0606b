// koebe batch INPUTS... --output FOLDER
#include "cli/commands/subcommand.h"
#include "cli/options/option_table.h"
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
#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace koebe::cli {
namespace {

namespace fs = std::filesystem;

const std::vector<std::string> pattern_formats{"dxf", "svg"};

/// A domain's command as it is parsed alone: checks the options of a batch, and knows their defaults.
struct DomainCommand {
    BatchDomain domain;
    std::shared_ptr<CLI::App> app = std::make_shared<CLI::App>();
    Subcommand command = domain.add(*app);

    std::string name() const { return command.options->get_name(); }
    /// The option's row, or null. Files and the set of UVs are each file's own.
    const OptionRow* row_of(const CLI::Option& option) const
    {
        const std::vector<std::string>& words = option.get_lnames();
        std::string word = words.empty() ? "" : words.front();
        std::ranges::replace(word, '-', '_');
        const OptionRow* const row = find_row(name(), word);
        return row == nullptr || row->kind == "weights" || word == "uv_channel" ? nullptr : row;
    }
    const CLI::Option* find(const std::string& flag) const
    {
        const CLI::Option* const option = command.options->get_option_no_throw(flag);
        return option == nullptr || row_of(*option) == nullptr ? nullptr : option;
    }
};

std::vector<std::string> domain_names()
{
    std::vector<std::string> names;
    for (const BatchDomain& domain : batch_domains) names.emplace_back(domain.name);
    return names;
}

struct BatchRequest {
    std::vector<CLI::Option*> forwarded;  ///< the domains' options
    std::vector<DomainCommand> commands;
    const DomainCommand* chosen = nullptr;
    nlohmann::ordered_json recipe;  ///< the settings that a map depends on beside the mesh
    std::string domain = batch_domains[0].name;
    std::vector<std::string> inputs, blender_arguments;
    std::string folder, base, format, blender, blender_script;
    int workers = 0;
    double time_limit = 0.0, stale = 120.0;
    bool retry = false, list = false, no_summary = false, summary_only = false, exit_zero = false,
         ends_with_input = false, quiet = false;
};

void add_batch_options(CLI::App& app, BatchRequest& request)
{
    // What is mapped, and where the results go.
    app.add_option("INPUTS", request.inputs, "mesh files, and folders to search with all their folders")->required();
    app.add_option("--output", request.folder,
                   "folder for the results. Each file keeps its path below its input folder, with a .json beside it")
        ->required()
        ->type_name("FOLDER");
    app.add_option("--base", request.base, "names are relative to this folder, for runs on single files of it")
        ->type_name("FOLDER");
    // How: files at a time, for how long, in which format.
    app.add_option("--workers", request.workers, "files at a time; 0: one for each core")
        ->check(whole_number(0))
        ->capture_default_str();
    app.add_option("--time-limit", request.time_limit, "most seconds for a file. By default there is no limit")
        ->check(number_in({.above = 0.0}))
        ->type_name("SECONDS");
    std::vector<std::string> formats = io::format_names(io::FormatName::bare, true);
    if (std::ranges::any_of(batch_domains, &BatchDomain::makes_pattern))
        formats.insert(formats.end(), pattern_formats.begin(), pattern_formats.end());
    app.add_option("--format", request.format, "format of the results: by default obj, and dxf of patterns")
        ->check(CLI::IsMember(formats));
    // Which part of the work: runs of several hosts share a folder by claims.
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
    // How the run ends, and what it prints.
    app.add_flag("--exit-zero", request.exit_zero,
                 "for farms: exit code 0 even if a mesh was not mapped, 3 only if the machine failed");
    app.add_flag(end_with_input_flag, request.ends_with_input)->group("");
    app.add_flag("--quiet", request.quiet, "no line for each file and no result line");
    // The map, and the program that maps .blend files.
    app.add_option("--domain", request.domain,
                   "the map of each file. disk: koebe uniformize; each other word: the command of this name")
        ->check(CLI::IsMember(domain_names()))
        ->capture_default_str();
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

/// The names of the domains that have an option.
std::string domains_with(const BatchRequest& request, const std::string& flag)
{
    std::string names;
    for (const DomainCommand& command : request.commands)
        if (command.find(flag) != nullptr) names += (names.empty() ? "" : ", ") + std::string(command.domain.name);
    return names;
}

/// Adds each option of the domains once, as text that the domain's command checks.
void add_domain_options(CLI::App& app, BatchRequest& request)
{
    for (const BatchDomain& domain : batch_domains) request.commands.push_back({domain});
    for (const DomainCommand& command : request.commands)
        for (const CLI::Option* const option : command.command.options->get_options()) {
            const OptionRow* const row = command.row_of(*option);
            if (row == nullptr || app.get_option_no_throw(row->flag()) != nullptr) continue;
            CLI::Option* const added =
                row->kind == "flag" ? app.add_flag(row->flag()) : app.add_option(row->flag())->delimiter(',');
            added->description(option->get_description());
            if (row->kind != "flag") {
                added->type_name(option->get_type_name())->default_str(option->get_default_str());
                added->expected(option->get_expected_min(), option->get_expected_max());
            }
            const bool is_of_disk = &command == request.commands.data();
            added->group(is_of_disk ? option->get_group() : "With --domain " + domains_with(request, row->flag()));
            request.forwarded.push_back(added);
        }
}

/// A map's options as given, for the processes that make it.
std::vector<std::string> given_words(const BatchRequest& request, bool with_threads)
{
    std::vector<std::string> words;
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

/// Chooses the domain, checks its options by its command, and takes the recipe from there.
/// @throws CLI::ParseError options of another domain, or wrong values
void choose_domain(BatchRequest& request)
{
    request.chosen = &*std::ranges::find(request.commands, request.domain,
                                         [](const DomainCommand& command) { return std::string(command.domain.name); });
    const BatchDomain& domain = request.chosen->domain;
    for (const CLI::Option* option : request.forwarded)
        if (option->count() > 0 && request.chosen->find(option->get_name()) == nullptr)
            throw CLI::ValidationError(option->get_name(),
                                       "belongs to --domain " + domains_with(request, option->get_name()));
    if (!request.blender.empty() && domain.of_blender == nullptr)
        throw CLI::ValidationError("--blender", "does not work with --domain " + request.domain);
    if (request.format.empty()) request.format = domain.makes_pattern ? pattern_formats.front() : "obj";
    if ((std::ranges::count(pattern_formats, request.format) > 0) != domain.makes_pattern)
        throw CLI::ValidationError("--format", request.format + " does not work with --domain " + request.domain);
    std::vector<std::string> words = given_words(request, true);
    words.insert(words.begin(), {request.chosen->name(), "IN.obj", "OUT." + request.format, "--quiet"});
    std::ranges::reverse(words);  // as CLI11 takes them
    request.chosen->app->parse(words);
    request.recipe = request.chosen->command.entries->at("options");
    if (request.format == "svg" && request.recipe.at("page") != "none")
        throw CLI::ValidationError("--format", "svg needs --page none: it has a file for each page");
    if (request.domain != batch_domains[0].name) request.recipe["domain"] = request.domain;
}

std::vector<std::string> map_command(const BatchRequest& request, const std::string& own_program,
                                     const batch::BatchFile& file, const batch::Scratch& scratch)
{
    std::vector<std::string> words{own_program, request.chosen->name(), "--quiet", end_with_input_flag,
                                   "--json=" + batch::utf8(scratch.report)};
    for (std::string& word : given_words(request, true)) words.push_back(std::move(word));
    // Each worker has one core; a single map would take all cores.
    const bool says_threads = std::ranges::any_of(request.forwarded, [](const CLI::Option* option) {
        return option->count() > 0 && option->check_name("--threads");
    });
    if (request.chosen->find("--threads") != nullptr && request.workers != 1 && !says_threads)
        words.emplace_back("--threads=1");
    words.insert(words.end(), {batch::utf8(file.source), batch::utf8(scratch.output)});
    return words;
}

/// The words by which the add-on's batch.py makes the domain's maps.
std::vector<std::string> blend_words(const BatchRequest& request, bool with_threads)
{
    std::vector<std::string> words = given_words(request, with_threads);
    const std::string domain = request.chosen->domain.of_blender == nullptr ? "" : request.chosen->domain.of_blender;
    if (!domain.empty()) words.insert(words.begin(), domain);
    words.insert(words.end(), request.blender_arguments.begin(), request.blender_arguments.end());
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
    for (std::string& word : blend_words(request, true)) words.push_back(std::move(word));
    return words;
}

batch::FileList files_of(const BatchRequest& request)
{
    batch::ListOptions options;
    options.base = batch::path_of(request.base);
    options.output = batch::path_of(request.folder);
    options.extension = "." + request.format;
    options.keeps_scenes = !request.chosen->domain.makes_pattern;
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
    options.mesh = {request.recipe, request.time_limit, request.retry};
    options.blend = {{{"arguments", blend_words(request, false)}}, request.time_limit, request.retry};
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
    // What there is to map.
    const batch::FileList list = files_of(request);
    if (list.blends_passed_over > 0 && !request.quiet)
        std::fprintf(stderr, "%s of Blender's skipped: give the Blender program with --blender\n",
                     counted(list.blends_passed_over, "file").c_str());
    if (list.files.empty()) throw WrongUsage("there is no mesh file in " + request.inputs.front());
    // Runs that map nothing: a list, or the table of what is there.
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
    // The maps. A failed map ends with its own exit code, unless a farm would take that for a failed machine.
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
    add_domain_options(*options, *request);
    options->callback([request] { choose_domain(*request); });
    return {options, [request] { return run_batch(*request); }};
}

}  // namespace koebe::cli
