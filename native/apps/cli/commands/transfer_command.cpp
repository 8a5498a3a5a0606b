// koebe transfer A B OUT
#include "cli/commands/map_kind.h"
#include "cli/commands/subcommand.h"
#include "cli/files/mesh_input.h"
#include "cli/files/output_files.h"
#include "cli/options/map_request.h"
#include "cli/options/option_table.h"
#include "cli/process/interrupt.h"
#include "cli/process/progress_line.h"
#include "cli/process/result_line.h"
#include "cli/process/standard_streams.h"
#include "exit_code.h"

#include "cli/files/text_file.h"
#include "core/errors.h"
#include "execution/detachable_run.h"
#include "files/atomic_file.h"
#include "files/text_lines.h"
#include "io/mesh_writer.h"
#include "pipeline/uniformize.h"
#include "report/json.h"
#include "surface/surface_point.h"
#include "transfer/correspondence.h"

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <iterator>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

namespace koebe::cli {
namespace {

/// The points of all lines, on A and on B.
struct NamedLandmarks {
    std::vector<NamedPoint> on_a, on_b;
};

[[noreturn]] void refuse(const std::string& path, int line)
{
    throw InputError(path + ", line " + std::to_string(line) +
                     ": a landmark is two vertices, counted from 0, or the six coordinates of two points");
}

NamedPoint vertex_of(std::string_view word, const std::string& path, int line)
{
    NamedPoint point;
    if (!io::to_number(word, point.vertex) || point.vertex < 0) refuse(path, line);
    return point;
}

NamedPoint position_of(const std::vector<std::string_view>& words, std::size_t first, const std::string& path, int line)
{
    NamedPoint point;
    for (int k = 0; k < 3; ++k)
        if (!io::to_number(words[first + k], point.position[k])) refuse(path, line);
    return point;
}

/// Each line is a landmark: two vertices, counted from 0, or x y z on A and x y z on B, separated by blanks, tabs or
/// commas. Text after a # is a comment.
/// @throws FileError it cannot be read; InputError a line that is not a landmark (its number)
NamedLandmarks read_landmarks(const std::string& path)
{
    const std::string text = read_words(path);
    NamedLandmarks landmarks;
    io::TextLines lines(text);
    for (int line = 1; lines.next_line(); ++line) {
        std::vector<std::string_view> words;
        for (std::string_view word = lines.next_word(); !word.empty(); word = lines.next_word()) words.push_back(word);
        if (words.empty()) continue;
        if (words.size() == 2) {
            landmarks.on_a.push_back(vertex_of(words[0], path, line));
            landmarks.on_b.push_back(vertex_of(words[1], path, line));
        } else if (words.size() == 6) {
            landmarks.on_a.push_back(position_of(words, 0, path, line));
            landmarks.on_b.push_back(position_of(words, 3, path, line));
        } else {
            refuse(path, line);
        }
    }
    if (landmarks.on_a.empty()) throw InputError(path + " holds no landmark");
    return landmarks;
}

struct TransferRequest {
    std::string first, second, output, json, landmarks;
    const MeshFormat* format = nullptr;
    bool aligned_only = false, extremal = false, quiet = false;
    UniformizeOptions options;
    FileOptions of_files;

    std::vector<OutputFile> files() const { return {{"OUT", output}, {"--json", json}}; }
};

struct MappedInput {
    MeshInput mesh;
    MappedSurface surface;
    bool converged = false;
    std::vector<Warning> warnings;  ///< of turned faces
};

MappedInput read_and_map(const std::string& path, const TransferRequest& request, const CancelToken& token)
{
    MappedInput input{read_mesh_input(path, token, {.weld = request.of_files.weld}), {}, false, {}};
    ProgressLine progress(request.quiet);
    ExecutionContext context(progress.callback(), token);
    const Vertices& vertices = input.mesh.polygons.vertices;
    const Triangles& triangles = input.mesh.triangulation.triangles;
    const UniformizeResult result =
        with_filed_faces(input.mesh, [&] { return uniformize(vertices, triangles, request.options, context); });
    input.surface = conformal_surface(vertices, triangles, result);
    input.mesh.give_to_joined(input.surface.uv);
    input.converged = result.converged;
    std::ranges::copy_if(result.warnings, std::back_inserter(input.warnings),
                         [](const Warning& warning) { return warning.kind == WarningKind::reoriented_faces; });
    add_input_warnings(input.mesh, input.warnings);
    return input;
}

nlohmann::ordered_json report(const TransferRequest& request, const MappedInput& a, const MappedInput& b,
                              const Correspondence& found, std::size_t landmark_count,
                              const std::vector<Warning>& warnings)
{
    const auto name = [](const std::string& path) { return std::filesystem::path(path).filename().string(); };
    // How far each hole misses its target, as a share of its radius on A.
    std::vector<double> in_radii = found.alignment.misses;
    for (std::size_t k = 0; k < in_radii.size(); ++k) in_radii[k] /= a.surface.loops[k].circle.radius;
    // Where each vertex of A lies on B: a triangle, and weights of its corners.
    nlohmann::ordered_json places = nlohmann::ordered_json::array();
    for (Eigen::Index v = 0; v < found.places.face.size(); ++v) {
        const auto corners = b.surface.triangles.row(found.places.face[v]);
        const auto weights = found.places.weights.row(v);
        places.push_back(
            {{"triangle", {corners[0], corners[1], corners[2]}}, {"weights", {weights[0], weights[1], weights[2]}}});
    }
    return {{"version", KOEBE_VERSION},
            {"a", name(request.first)},
            {"b", name(request.second)},
            {"converged", a.converged && b.converged},
            {"match", found.alignment.match},
            {"residual", found.alignment.residual},
            {"misses", found.alignment.misses},
            {"misses_in_radii", in_radii},
            {"fitted", found.fitted},
            {"landmarks", landmark_count},
            {"beltrami", {{"mean", found.beltrami.mean}, {"max", found.beltrami.max}}},
            {"flipped", found.folded},
            {"largest_distance", found.places.distance.maxCoeff()},
            {"warnings", to_json(warnings)},
            {"places", std::move(places)}};
}

std::string result_line(const TransferRequest& request, const MappedInput& a, const MappedInput& b,
                        const Correspondence& found, const std::vector<Warning>& warnings)
{
    double worst = 0.0;
    for (std::size_t k = 1; k < found.alignment.misses.size(); ++k)
        worst = std::max(worst, found.alignment.misses[k] / a.surface.loops[k].circle.radius);
    char text[128];
    std::snprintf(text, sizeof text, ": %lld points, holes miss by up to %.2g radii%s, |mu| %.2g, at most %.2g",
                  static_cast<long long>(found.points.rows()), worst, found.fitted ? ", fitted" : ", not fitted",
                  found.beltrami.mean, found.beltrami.max);
    return one_line(request.output) + text + (a.converged && b.converged ? "" : ", not converged") +
           warning_count(warnings) + "\n";
}

Correspondence found_correspondence(const std::shared_ptr<const MappedInput>& a,
                                    const std::shared_ptr<const MappedInput>& b, const CorrespondenceOptions& options,
                                    bool quiet, const CancelToken& token)
{
    ProgressLine progress(quiet);
    ExecutionContext context(progress.callback(), token);
    return run_detachable<Correspondence>(
        context, [options, a, b](ExecutionContext& own) { return correspond(a->surface, b->surface, options, own); });
}

int run_transfer(const TransferRequest& request)
{
    const CancelToken token = cancel_on_signal();
    require_writable_files(request.files(), !request.quiet);
    NamedLandmarks named = request.landmarks.empty() ? NamedLandmarks{} : read_landmarks(request.landmarks);
    const auto a = std::make_shared<const MappedInput>(read_and_map(request.first, request, token));
    const auto b = std::make_shared<const MappedInput>(read_and_map(request.second, request, token));
    const ExecutionContext context({}, token);
    // Landmarks as points of the mapped surfaces.
    CorrespondenceOptions options{
        .match = {}, .fit_holes = !request.aligned_only, .landmarks = {}, .extremal = request.extremal};
    for (NamedPoint& point : named.on_a) point.vertex = a->mesh.mapped(point.vertex);
    for (NamedPoint& point : named.on_b) point.vertex = b->mesh.mapped(point.vertex);
    if (!request.landmarks.empty()) {
        const auto on_a = surface_points(a->surface.vertices, a->surface.triangles, named.on_a);
        const auto on_b = surface_points(b->surface.vertices, b->surface.triangles, named.on_b);
        for (std::size_t i = 0; i < on_a.size(); ++i) options.landmarks.push_back({on_b[i], on_a[i]});
    }
    const Correspondence found = found_correspondence(a, b, options, request.quiet, token);
    // A with its points on B, and the report.
    std::vector<AtomicFile> files;
    PolygonMesh moved = a->mesh.polygons;
    moved.vertices = found.points;
    std::vector<Warning> warnings = found.warnings;
    add_losses("A: ", a->warnings, warnings);
    add_losses("B: ", b->warnings, warnings);
    std::ranges::move(
        write_with_uvs(files.emplace_back(request.output), *request.format, moved, a->surface.uv, {a->mesh.file, true}),
        std::back_inserter(warnings));
    if (!request.json.empty())
        files.emplace_back(request.json)
            .write(json_text(report(request, *a, *b, found, options.landmarks.size(), warnings)));
    context.checkpoint();
    for (AtomicFile& file : files) file.commit();
    if (!request.quiet) {
        print(result_line(request, *a, *b, found, warnings), "; the files are written");
        show_warnings(warnings);
    }
    return a->converged && b->converged ? done : not_converged;
}

}  // namespace

Subcommand add_transfer(CLI::App& app)
{
    auto request = std::make_shared<TransferRequest>();
    CLI::App* options =
        app.add_subcommand("transfer", "the points of surface A on surface B, through the two circle domains");
    add_input(*options, request->first, "surface with holes", "A");
    options->add_option("B", request->second, "surface with the same number of holes")->required();
    add_output(*options, request->output,
               io::listed_formats(io::FormatName::word, true) + " to write: A's faces, with A's vertices moved onto B");
    // How points correspond: by circles, by bent holes, by landmarks.
    options->add_flag("--no-fit", request->aligned_only,
                      "only lay the domains over each other: bend no hole onto another hole");
    options
        ->add_option(
            "--landmarks", request->landmarks,
            "points that correspond exactly, a line each: two vertices, counted from 0, or x y z on A and x y z "
            "on B")
        ->type_name("FILE");
    options
        ->add_flag("--extremal", request->extremal,
                   "with landmarks: the largest |mu| becomes nearly as small as it can be. Takes longer")
        ->needs("--landmarks");
    add_options(*options, "shapes", request->options);
    add_options(*options, "shapes", request->of_files);
    options
        ->add_option("--json", request->json,
                     "write there in which triangle of B each point lies, and how far the holes miss")
        ->type_name("FILE");
    options->add_flag("--quiet", request->quiet, "no progress and no result line");
    // No file may be read and written.
    options->callback([request] {
        request->format = required_format(request->output);
        require_different_files(request->files(), {request->first, request->second, request->landmarks},
                                !request->quiet);
    });
    return {options, [request] { return run_transfer(*request); }};
}

}  // namespace koebe::cli
