#include "cli/commands/command.h"

#include "cli/commands/subcommand.h"
#include "cli/files/output_files.h"
#include "cli/options/option_table.h"
#include "cli/options/wrong_usage.h"
#include "cli/process/error_line.h"
#include "cli/process/standard_streams.h"
#include "core/numbering.h"
#include "execution/profile.h"
#include "exit_code.h"
#include "files/atomic_file.h"

#include <algorithm>
#include <atomic>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <functional>
#include <new>
#include <sstream>
#include <string>
#include <string_view>
#include <system_error>
#include <utility>
#include <vector>

#if defined(__GLIBC__)
#include <malloc.h>
#include <sys/resource.h>
#endif

namespace {

using namespace koebe;
using namespace koebe::cli;

std::atomic<bool> ran_out{false};

/// Prints the error of a command that ran out of memory, and exits. Allocates no memory.
[[noreturn]] void end_for_memory()
{
    std::fputs("OutOfMemory: the mesh needs more memory than there is\n", stderr);
    std::_Exit(cannot_be_mapped);  // an ordinary exit waits for threads, which wait for memory
}

[[noreturn]] void note_and_throw()
{
    ran_out = true;
    throw std::bad_alloc();
}

[[noreturn]] void end_of_exceptions()
{
    if (!ran_out) std::abort();
    AtomicFile::remove_temporary_files();
    end_for_memory();
}

/// Makes threads share one arena if the address space is limited: malloc would otherwise ask for new ones of 64 MB with
/// every allocation.
void share_arena()
{
#if defined(__GLIBC__)
    rlimit limit{};
    if (::getrlimit(RLIMIT_AS, &limit) == 0 && limit.rlim_cur != RLIM_INFINITY) ::mallopt(M_ARENA_MAX, 1);
#endif
}

/// Keeps freed memory for the next matrices: each new page costs about as much as 500 operations.
void keep_freed_memory()
{
#if defined(__GLIBC__)
    constexpr int largest_block = 32 << 20, most_kept = 128 << 20;
    ::mallopt(M_MMAP_THRESHOLD, largest_block);
    ::mallopt(M_TRIM_THRESHOLD, most_kept);
#endif
}

/// Whether memory ran out at any time. Then other errors, such as a number that could not be read, come from that.
bool memory_ran_out() noexcept { return ran_out; }

/// Call before other threads start. Makes end_for_memory end the process where an exception for memory would otherwise
/// do so, because no exception may pass there.
void prepare_for_scarce_memory()
{
    std::set_new_handler(note_and_throw);  // from here on exceptions are caught
    std::set_terminate(end_of_exceptions);
    share_arena();
    keep_freed_memory();
}

int fail(const std::string& line, int code)
{
    std::fprintf(stderr, "%s\n", line.c_str());
    return code;
}

int run_guarded(const std::function<int()>& run)
{
    try {
        return run();
    } catch (const koebe::Cancelled& error) {
        fail(error_line(error), interrupted);
        std::_Exit(interrupted);  // an ordinary exit waits for the computation's next checkpoint
    } catch (const koebe::KoebeError& error) {
        if (memory_ran_out()) end_for_memory();
        return fail(error_line(error), cannot_be_mapped);
    } catch (const WrongUsage& error) {
        return fail(error_line("WrongUsage", error.what()), wrong_usage);
    } catch (const std::bad_alloc&) {
        end_for_memory();
    } catch (const std::length_error&) {  // more than any memory holds
        end_for_memory();
    } catch (const std::system_error& error) {
        if (error.code() == std::errc::resource_unavailable_try_again) end_for_memory();  // no memory for a thread
        return fail(error_line("InternalError", error.what()), cannot_be_mapped);
    } catch (const std::exception& error) {
        return fail(error_line("InternalError", error.what()), cannot_be_mapped);
    }
}

/// How many letters must be changed, added or left out to make one word the other [Levenshtein 1966].
std::size_t edit_distance(const std::string& a, const std::string& b)
{
    std::vector<std::size_t> row = numbers_below<std::size_t>(b.size() + 1);
    for (std::size_t i = 1; i <= a.size(); ++i) {
        std::size_t corner = std::exchange(row[0], i);
        for (std::size_t j = 1; j <= b.size(); ++j)
            corner = std::exchange(row[j], std::min({row[j] + 1, row[j - 1] + 1, corner + (a[i - 1] != b[j - 1])}));
    }
    return row.back();
}

/// What is wrong with words that a command does not know.
std::string unknown_words(const CLI::App& app)
{
    const CLI::App* command = &app;
    while (!command->get_subcommands().empty()) command = command->get_subcommands().front();
    const std::vector<std::string> words = command->remaining();
    const auto option = std::ranges::find_if(words, [](const std::string& word) { return word.starts_with("--"); });
    if (option == words.end()) return {};
    const std::string name = option->substr(2, option->find('=') - 2);
    std::string nearest;
    std::size_t least = 1 + name.size() / 3;  // letters
    for (const CLI::Option* const known : command->get_options())
        for (const std::string& other : known->get_lnames())
            if (const std::size_t letters = edit_distance(name, other); letters <= least) {
                least = letters - (letters > 0);
                nearest = other;
            }
    return "koebe " + (command == &app ? "" : command->get_name() + " ") + "has no option --" + name +
           (nearest.empty() ? "" : ": did you mean --" + nearest + "?");
}

/// Ends after parsing: prints the help or the version, or an error as one line.
int end_of_parsing(const CLI::App& app, const CLI::ParseError& error)
{
    std::ostringstream text, complaint;
    if (app.exit(error, text, complaint) == 0) {
        print(text.str());
        return done;
    }
    const bool unknown = dynamic_cast<const CLI::ExtrasError*>(&error) != nullptr;
    const std::string words = unknown ? unknown_words(app) : "";
    return fail(error_line("WrongUsage", words.empty() ? error.what() : words) + " (see koebe --help)", wrong_usage);
}

/// @throws CLI::ValidationError the profile is standard output, or another file of the command
void require_own_file(const CLI::App& command, const std::string& profile)
{
    const OutputFile own{"--profile", profile};
    require_different_files({own}, {}, true);
    for (const CLI::Option* const option : command.get_options())
        if (option->get_name() != own.name && (option->get_positional() || option->get_type_name() == "FILE"))
            for (const std::string& path : option->results())
                require_different_files({{option->get_name(), path}, own}, {}, false);
}

/// Runs the command, and writes where its time went, unless it throws. @return an ExitCode
int run_profiled(const Subcommand& command, const std::string& profile)
{
    require_writable_files({{"--profile", profile}}, false);
    take_profile("koebe " + command.options->get_name());
    const int code = command.run();
    AtomicFile file(profile);
    file.write(folded_profile());
    file.commit();
    return code;
}

/// The sub-commands that are parsed: all cost 2 ms, so only what the first word names, if it names one.
std::vector<NamedSubcommand> needed(std::span<const NamedSubcommand> known, std::string_view word)
{
    if (word == "--version") return {};
    const auto named = std::ranges::find(known, word, &NamedSubcommand::name);
    return named == known.end() ? std::vector(known.begin(), known.end()) : std::vector{*named};
}

int run_command(std::span<const NamedSubcommand> known, int argc, char** argv)
{
    // The program, and the subcommands that are needed.
    CLI::App app("Conformal maps of surfaces with holes onto circle domains.", "koebe");
    app.set_version_flag("--version", KOEBE_VERSION);
    app.require_subcommand(1);
    app.footer("Exit codes: 0 done; 2 wrong usage; 3 the mesh cannot be mapped; 4 not converged (files are written);\n"
               "130 interrupted (nothing is written; batch leaves what is done).\n"
               "A file is written as .koebe-PROCESS-NUMBER.tmp in its folder and then renamed: it is whole or absent.\n"
               "Where it is a symbolic link, the link stays and its target is replaced.");
    std::vector<Subcommand> commands;
    std::string profile;
    for (const NamedSubcommand& one : needed(known, argc > 1 ? argv[1] : "")) {
        CLI::App& options = *commands.emplace_back(one.add(app)).options;
        if (const OptionRow* const row = find_row(options.get_name(), "profile")) add_value(options, *row, profile);
    }
    const auto is_parsed = [](const Subcommand& command) { return command.options->parsed(); };
    try {
        // Without --profile the subcommand runs as it is.
        app.parse(argc, argv);
        const Subcommand& command = *std::ranges::find_if(commands, is_parsed);
        if (profile.empty()) return command.run();
        require_own_file(*command.options, profile);
        return run_profiled(command, profile);
    } catch (const CLI::ParseError& error) {
        return end_of_parsing(app, error);
    }
}

}  // namespace

int koebe::cli::command(int argc, char** argv)
{
#define KOEBE_ADD(name) {#name, add_##name},
    constexpr NamedSubcommand all[]{KOEBE_SUBCOMMANDS(KOEBE_ADD)};
#undef KOEBE_ADD
    return command_of(all, argc, argv);
}

int koebe::cli::command_of(std::span<const NamedSubcommand> known, int argc, char** argv)
{
    keep_standard_streams();
    try {
        return run_guarded([&] {
            prepare_for_scarce_memory();
            return run_command(known, argc, argv);
        });
    } catch (...) {  // there was no memory even for the error's line
        end_for_memory();
    }
}
