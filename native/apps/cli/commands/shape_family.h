// Tables over many shapes: their modules in a common order of loops, or the distances of all pairs.
#pragma once

#include "cli/commands/shape_input.h"

#include <CLI/CLI.hpp>

#include <functional>
#include <string>
#include <vector>

namespace koebe::cli {

/// The options for many shapes.
struct FamilyRequest {
    std::string csv;        ///< where the table is written; empty: no table
    std::string reference;  ///< the name of one of the files, whose loops set the order; empty: the first that can be
                            ///< mapped
    ShapeOptions options;
};

/// Adds --csv, --reference, --error, --rims. @param table what --csv writes @param bars what --error adds
void add_family_options(CLI::App& app, FamilyRequest& request, const std::string& table, const std::string& bars);

/// @throws CLI::ValidationError --reference without --csv
void require_csv(const FamilyRequest& request);

struct FamilyRow {
    std::string label;   ///< the file's name
    bool known = false;  ///< whether there is a module
    VectorXd module;     ///< in the common order
    VectorXd error;      ///< bars (module_error), if asked for
    std::string note;    ///< why there is no module, or that the map has not converged
};

struct ShapeFamily {
    std::vector<std::string> columns;  ///< names of the module's numbers
    std::vector<FamilyRow> rows;       ///< in the order of the files
    bool converged = true;             ///< of all shapes with a module
};

/// The mesh files of a folder, by name; a file gives itself.
/// @throws InputError a folder without mesh files; FileError it cannot be read
std::vector<std::string> mesh_files(const std::vector<std::string>& paths);

/// Maps all shapes, one after another. Their loops are matched to those of the reference (match_loops).
/// @param order chooses the order of the reference's loops @throws errors of read_shape for the reference; Cancelled
ShapeFamily read_family(const FamilyRequest& request, const std::vector<std::string>& files,
                        const std::function<std::vector<int>(const ShapeInput&)>& order, const CancelToken& token);

/// Writes a table of the family to a file, and a line on stderr if shapes have no module. @return the command's exit
/// code
int write_table(const ShapeFamily& family, const std::string& table, const std::string& path, const CancelToken& token);

/// One row per shape: label, module, error bars if any, note. RFC 4180, with NA for missing numbers, as R's read.csv
/// and pandas read it.
std::string module_table(const ShapeFamily& family);

/// One row per pair: a, b, L2 distance, error bar if any.
std::string distance_table(const ShapeFamily& family);

}  // namespace koebe::cli
