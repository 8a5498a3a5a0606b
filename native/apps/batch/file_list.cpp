#include "batch/file_list.h"

#include "batch/path_text.h"
#include "batch/summary.h"
#include "files/extension.h"
#include "files/file_error.h"
#include "io/mesh_formats.h"

#include <algorithm>
#include <map>
#include <set>
#include <string_view>
#include <system_error>

namespace koebe::batch {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view blend_extension = ".blend", scene_extension = ".glb";

bool is_blend(const fs::path& path) { return io::lower_extension(path) == blend_extension; }

/// Scenes keep everything but their UVs, which no other format can.
std::string output_extension(const fs::path& source, const ListOptions& options)
{
    const std::string own = io::lower_extension(source);
    return own == blend_extension || (own == scene_extension && options.keeps_scenes) ? own : options.extension;
}

bool is_hidden(const fs::path& path) { return utf8(path.filename()).starts_with('.'); }

bool is_inside(const fs::path& relative) { return !relative.empty() && *relative.begin() != fs::path(".."); }

class Lister {
public:
    explicit Lister(const ListOptions& options)
        : options_(options), output_(fs::weakly_canonical(options.output)), base_(options.base)
    {
        if (base_.empty()) return;
        if (!fs::is_directory(base_)) throw UsageError("--base " + utf8(base_) + " is not a folder");
        base_ = fs::canonical(base_);
    }

    FileList list()
    {
        for (const fs::path& input : options_.inputs) add_input(input);
        std::ranges::sort(list_.files, {}, &BatchFile::name);
        for (const BatchFile& file : list_.files) require_own_names(file);
        return std::move(list_);
    }

private:
    void add_input(const fs::path& input)
    {
        std::error_code error;
        if (fs::is_directory(input, error)) return add_folder(fs::canonical(input));
        if (!fs::exists(input, error)) throw UsageError(utf8(input) + " does not exist");
        if (is_blend(input) && !options_.with_blends)
            throw UsageError(utf8(input) + " is a .blend file: give the Blender program with --blender");
        if (!io::is_mesh_file(input) && !is_blend(input))
            throw UsageError(utf8(input) + " is not a mesh file: mesh files end in " +
                             io::listed_formats(io::FormatName::extension));
        // A link gives its own name, as its target may be called anything.
        const fs::path source = fs::canonical(fs::absolute(input).parent_path()) / input.filename();
        add_file(source, source.parent_path());
    }

    void add_folder(const fs::path& folder)
    {
        std::error_code error;
        fs::recursive_directory_iterator entry(folder, error);
        if (error) io::fail("cannot read " + utf8(folder), error);
        for (const fs::recursive_directory_iterator end; entry != end; entry.increment(error)) {
            if (error) io::fail("cannot read " + utf8(folder), error);
            const fs::path& path = entry->path();
            if (entry->is_directory(error)) {
                if (is_hidden(path) || path == output_) entry.disable_recursion_pending();
            } else if (!is_hidden(path) && entry->is_regular_file(error)) {
                if (io::is_mesh_file(path) || (options_.with_blends && is_blend(path)))
                    add_file(path, folder);
                else if (is_blend(path))
                    ++list_.blends_passed_over;
            }
        }
        if (error) io::fail("cannot read " + utf8(folder), error);
    }

    void add_file(const fs::path& source, const fs::path& folder)
    {
        const fs::path relative = source.lexically_relative(base_.empty() ? folder : base_);
        if (!is_inside(relative)) throw UsageError(utf8(source) + " is not in --base " + utf8(base_));
        BatchFile file;
        file.source = source;
        file.name = generic_utf8(relative);
        file.is_blend = is_blend(source);
        const auto known = names_.find(file.name);
        if (known != names_.end() && fs::equivalent(known->second, source)) return;  // given twice
        if (known != names_.end())
            throw UsageError(utf8(known->second) + " and " + utf8(source) + " would both get the name " + file.name);
        names_.emplace(file.name, source);
        sources_.insert(fs::canonical(source));
        file.output = (output_ / relative).replace_extension(output_extension(source, options_));
        file.report = fs::path(file.output).replace_extension(".json");
        list_.files.push_back(std::move(file));
    }

    void require_own_names(const BatchFile& file)
    {
        const auto [place, is_new] = reports_.emplace(file.report, &file);
        if (!is_new)
            throw UsageError(place->second->name + " and " + file.name + " would both write " + utf8(file.report));
        if (file.report == output_ / summary_json || file.report == output_ / summary_csv)
            throw UsageError(file.name + " would write " + utf8(file.report) + ", which is the summary's name");
        if (const auto replaced = sources_.find(fs::weakly_canonical(file.output)); replaced != sources_.end())
            throw UsageError("the result of " + file.name + " would replace the mesh " + utf8(*replaced));
    }

    const ListOptions& options_;
    fs::path output_, base_;
    FileList list_;
    std::map<std::string, fs::path> names_;
    std::set<fs::path> sources_;
    std::map<fs::path, const BatchFile*> reports_;
};

}  // namespace

FileList list_files(const ListOptions& options) { return Lister(options).list(); }

}  // namespace koebe::batch
