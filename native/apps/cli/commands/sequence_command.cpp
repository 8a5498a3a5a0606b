// koebe sequence FILES... --output FOLDER
#include "cli/commands/map_run.h"
#include "cli/commands/subcommand.h"
#include "cli/commands/uniformize_kind.h"
#include "cli/options/loop_options.h"
#include "cli/options/option_table.h"
#include "cli/options/uniformize_options.h"
#include "cli/options/wrong_usage.h"
#include "cli/process/error_line.h"

#include "core/errors.h"
#include "execution/stopwatch.h"
#include "files/file_error.h"
#include "pipeline/convex_disk.h"
#include "pipeline/surface_solver.h"

#include <cstdio>
#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace koebe::cli {
namespace {

namespace fs = std::filesystem;

struct SequenceRequest : MapRequest {
    std::string folder, extension = "obj";
    std::vector<std::string> inputs;
};

/// The request of one file.
MapRequest request_of(const SequenceRequest& all, const std::string& file)
{
    MapRequest one = all;
    const fs::path target = fs::path(all.folder) / fs::path(file).stem();
    one.input = file;
    one.output = target.string() + "." + all.extension;
    one.json = target.string() + ".json";
    one.format = required_format(one.output);
    return one;
}

void check_files(const SequenceRequest& all)
{
    std::map<std::string, std::string> file_of;
    for (const std::string& file : all.inputs) {
        const MapRequest one = request_of(all, file);
        const auto [other, is_new] = file_of.emplace(one.output, file);
        if (!is_new)
            throw CLI::ValidationError("FILES", other->second + " and " + file + " would both become " + one.output);
        for (const OutputFile& output : map_files(one))
            require_different_files({{"--output", output.path}}, all.inputs, !all.quiet);
    }
}

void make_folder(const std::string& folder)
{
    std::error_code failed;
    fs::create_directories(folder, failed);
    if (failed || !fs::is_directory(folder)) io::fail("cannot make the folder " + folder, failed);
}

/// Maps the files one after another, on the surface of the first one that can be mapped.
class Sequence {
public:
    explicit Sequence(const SequenceRequest& all) : all_(all), token_(cancel_on_signal()) {}

    int run()
    {
        int code = done;
        for (const std::string& file : all_.inputs) {
            try {
                if (const int own = map(file); code == done) code = own;
            } catch (const Cancelled&) {
                throw;
            } catch (const OutOfMemory&) {
                throw;
            } catch (const KoebeError& error) {
                std::fprintf(stderr, "%s: %s\n", one_line(file).c_str(), error_line(error).c_str());
                code = cannot_be_mapped;
            }
        }
        return code;
    }

private:
    int map(const std::string& file)
    {
        const Stopwatch run;
        const MapRequest request = request_of(all_, file);
        MeshInput input = read_mesh_input(file, token_, {.weld = all_.of_files.weld, .first = first_.joins});
        UniformizeResult result;
        {
            ProgressLine progress(all_.quiet);
            ExecutionContext context(progress.callback(), token_);
            result = with_filed_faces(input, [&] { return mapped(file, input, context); });
            add_input_warnings(input, result.warnings);
            result.seconds.read = input.seconds;
            write_map(request, UniformizeKind(request), input, result, run, context);
        }
        if (!all_.quiet) {
            print(map_line(request, UniformizeKind(request).first_words(result), result.distortion,
                           result.seconds.total, result.converged, result.warnings),
                  "; the files are written");
            show_warnings(result.warnings);
        }
        return result.converged ? done : not_converged;
    }

    UniformizeResult mapped(const std::string& file, MeshInput& input, ExecutionContext& context)
    {
        if (!surface_) {
            UniformizeOptions options = all_.options;
            name_mapped_vertices(input, options);
            require_fitting_vertices(input, options);
            surface_.emplace(input.polygons.vertices, input.triangulation.triangles, options);
            first_ = {file, input.polygons.corners, input.polygons.face_begin, input.triangulation, input.first};
        } else if (input.polygons.corners != first_.corners || input.polygons.face_begin != first_.face_begin ||
                   input.polygons.vertices.rows() != surface_->vertex_count()) {
            throw InputError("it has other faces than " + first_.file +
                             ": all files of a sequence must have the same faces");
        }
        input.triangulation = first_.triangulation;  // the surface was made of this triangulation
        UniformizeResult result = surface_->uniformize(input.polygons.vertices, context);
        make_polygons_convex(input.polygons.vertices, input.triangulation.triangles, input.triangulation.face, result,
                             context);
        input.give_to_joined(result.uv);
        return result;
    }

    struct First {
        std::string file;
        std::vector<Index> corners, face_begin;
        Triangulation triangulation;
        std::vector<Index> joins;  ///< see MeshInput::first
    };

    const SequenceRequest& all_;
    CancelToken token_;
    std::optional<SurfaceSolver> surface_;
    First first_;
};

}  // namespace

Subcommand add_sequence(CLI::App& app)
{
    auto request = std::make_shared<SequenceRequest>();
    CLI::App* options =
        app.add_subcommand("sequence", "map many files of one surface whose vertices move, each laid over the first");
    // The files, the folder of the results, and their format.
    options->add_option("FILES", request->inputs, "meshes with the same faces, in the order of the sequence")
        ->required();
    options
        ->add_option("--output", request->folder,
                     "folder for the results: a mesh and a .json for each file, with its name")
        ->required()
        ->type_name("FOLDER");
    options->add_option("--format", request->extension, "format of the written meshes")
        ->check(CLI::IsMember(io::format_names(io::FormatName::bare, true)))
        ->capture_default_str();
    add_options(*options, "sequence", request->options);
    add_options(*options, "sequence", request->of_files);
    options->add_flag("--quiet", request->quiet, "no progress and no result lines");
    // Names of results must differ, from each other and from the inputs.
    options->callback([request] {
        check_center(request->options);
        check_files(*request);
        report_options(*request, "sequence", request->options);
    });
    return {options, [request] {
                make_folder(request->folder);
                return Sequence(*request).run();
            }};
}

}  // namespace koebe::cli
