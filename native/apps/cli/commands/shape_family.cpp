#include "cli/commands/shape_family.h"

#include "batch/summary.h"
#include "cli/options/option_table.h"
#include "cli/process/error_line.h"
#include "core/counted.h"
#include "execution/detachable_run.h"
#include "exit_code.h"
#include "files/atomic_file.h"
#include "files/extension.h"
#include "files/file_error.h"
#include "io/mesh_formats.h"
#include "shape/conformal_module.h"
#include "shape/loop_matching.h"
#include "shape/module_error.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <utility>

namespace koebe::cli {
namespace {

namespace fs = std::filesystem;

/// The shape's loops that correspond to the reference's, in the wanted order.
std::vector<int> corresponding_loops(const ShapeInput& reference, const ShapeInput& shape,
                                     const std::vector<int>& wanted, const CancelToken& token)
{
    ExecutionContext context({}, token);
    const LoopMatch match =
        run_detachable<LoopMatch>(context, [a = reference.circles, b = shape.circles](ExecutionContext& own) {
            return match_loops(a, b, false, own);
        });
    std::vector<int> partner(wanted.size()), order;
    for (std::size_t i = 0; i < wanted.size(); ++i) partner[match.order_a[i]] = match.order_b[i];
    for (const int loop : wanted) order.push_back(partner[loop]);
    return order;
}

std::string number(double value) { return formatted("%.17g", value); }

void append(std::string& line, const VectorXd& values, std::size_t count)
{
    for (std::size_t i = 0; i < count; ++i)
        line += ',' + (values.size() > 0 ? number(values[static_cast<Eigen::Index>(i)]) : std::string("NA"));
}

bool has_errors(const ShapeFamily& family)
{
    return std::ranges::any_of(family.rows, [](const FamilyRow& row) { return row.error.size() > 0; });
}

}  // namespace

std::vector<std::string> mesh_files(const std::vector<std::string>& paths)
{
    std::vector<std::string> files;
    for (const std::string& path : paths) {
        std::error_code failed;
        if (!fs::is_directory(path, failed)) {
            files.push_back(path);
            continue;
        }
        std::vector<std::string> found;
        for (fs::directory_iterator entry(path, failed), end; !failed && entry != end; entry.increment(failed))
            if (io::is_mesh_file(entry->path()) && !entry->is_directory()) found.push_back(entry->path().string());
        if (failed) io::fail("cannot read " + path, failed);
        if (found.empty())
            throw InputError("the folder " + path + " holds no " + io::listed_formats(io::FormatName::word) + " file");
        std::ranges::sort(found);
        files.insert(files.end(), found.begin(), found.end());
    }
    return files;
}

void add_family_options(CLI::App& app, FamilyRequest& request, const std::string& table, const std::string& bars)
{
    app.add_option("--csv", request.csv, table)->type_name("FILE");
    app.add_option("--reference", request.reference,
                   "with --csv: the file whose loops are matched to those of all other files, by default the first")
        ->type_name("NAME");
    app.add_flag("--error", request.options.with_error, "also bars of the error that " + bars);
    add_options(app, "shapes", request.options.of_files);
    add_choice(app, *find_row("module", "rims"), static_cast<int>(request.options.rims),
               [&request](int k) { request.options.rims = static_cast<RimKind>(k); });
}

void require_csv(const FamilyRequest& request)
{
    if (request.csv.empty() && !request.reference.empty()) throw CLI::ValidationError("--reference", "needs --csv");
}

std::string name_of(const std::string& path) { return fs::path(path).filename().string(); }

/// The place of the named reference, or of the first file that can be mapped, and its shape.
std::pair<std::size_t, ShapeInput> reference_of(const FamilyRequest& request, const std::vector<std::string>& files,
                                                const CancelToken& token)
{
    if (!request.reference.empty()) {
        const auto found = std::ranges::find(files, request.reference, name_of);
        if (found == files.end()) throw InputError("the reference " + request.reference + " is not among the files");
        return {static_cast<std::size_t>(found - files.begin()), read_shape(*found, request.options, token)};
    }
    for (std::size_t first = 0;; ++first) try {
            return {first, read_shape(files[first], request.options, token)};
        } catch (const Cancelled&) {
            throw;
        } catch (const KoebeError&) {
            if (first + 1 == files.size()) throw;
        }
}

FamilyRow row_of(const std::string& file, const ShapeInput& shape, const std::vector<int>& order,
                 const ShapeOptions& options)
{
    FamilyRow row{name_of(file), true, conformal_module(shape.circles, order), {}, {}};
    if (options.with_error) row.error = module_error(row.module, conformal_module(shape.refined, order));
    if (options.rims != RimKind::smooth) row.note = std::string(to_string(options.rims)) + " rims";
    if (!shape.converged) row.note = "not converged";
    for (const Warning& warning : shape.warnings)
        if (warning.kind == WarningKind::reoriented_faces)
            row.note += (row.note.empty() ? "" : "; ") + warning.sentence;
    return row;
}

ShapeFamily read_family(const FamilyRequest& request, const std::vector<std::string>& files,
                        const std::function<std::vector<int>(const ShapeInput&)>& order, const CancelToken& token)
{
    const auto [first, reference] = reference_of(request, files, token);
    const std::vector<int> wanted = order(reference);
    ShapeFamily family{module_names(wanted.size()), {}, true};
    for (std::size_t i = 0; i < files.size(); ++i) {
        FamilyRow row;
        try {
            const ShapeInput shape = i == first ? reference : read_shape(files[i], request.options, token);
            row = row_of(files[i], shape, i == first ? wanted : corresponding_loops(reference, shape, wanted, token),
                         request.options);
            family.converged = family.converged && shape.converged;
        } catch (const Cancelled&) {
            throw;
        } catch (const OutOfMemory&) {
            throw;
        } catch (const KoebeError& error) {
            row = {name_of(files[i]), false, {}, {}, error_line(error)};
        }
        family.rows.push_back(std::move(row));
    }
    return family;
}

int write_table(const ShapeFamily& family, const std::string& table, const std::string& path, const CancelToken& token)
{
    AtomicFile file(path);
    file.write(table);
    ExecutionContext({}, token).checkpoint();
    file.commit();
    const auto missing = std::ranges::count_if(family.rows, [](const FamilyRow& row) { return !row.known; });
    if (missing > 0)
        std::fprintf(stderr, "InputError: %d of %d shapes have no module, as their notes say; the table is written\n",
                     static_cast<int>(missing), static_cast<int>(family.rows.size()));
    return missing > 0 ? cannot_be_mapped : family.converged ? done : not_converged;
}

std::string module_table(const ShapeFamily& family)
{
    const bool errors = has_errors(family);
    std::string text = "label";
    for (const std::string& column : family.columns) text += ',' + column;
    if (errors)
        for (const std::string& column : family.columns) text += ',' + column + "_error";
    text += ",note\n";
    for (const FamilyRow& row : family.rows) {
        text += batch::csv_field(row.label);
        append(text, row.module, family.columns.size());
        if (errors) append(text, row.error, family.columns.size());
        text += ',' + batch::csv_field(row.note) + '\n';
    }
    return text;
}

std::string distance_table(const ShapeFamily& family)
{
    const bool errors = has_errors(family);
    std::string text = errors ? "a,b,distance,distance_error\n" : "a,b,distance\n";
    for (std::size_t i = 0; i < family.rows.size(); ++i)
        for (std::size_t j = i + 1; j < family.rows.size(); ++j) {
            const FamilyRow &a = family.rows[i], &b = family.rows[j];
            const bool known = a.known && b.known;
            text += batch::csv_field(a.label) + ',' + batch::csv_field(b.label) + ',' +
                    (known ? number((a.module - b.module).norm()) : "NA");
            if (errors) text += ',' + (known ? number(std::hypot(a.error.norm(), b.error.norm())) : "NA");
            text += '\n';
        }
    return text;
}

}  // namespace koebe::cli
