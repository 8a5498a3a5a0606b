// Many shapes as a table: their modules in one order of the loops, or the distances of all pairs.
#pragma once

#include "cli/commands/shape_input.h"

#include <CLI/CLI.hpp>

#include <functional>
#include <string>
#include <vector>

namespace koebe::cli {

/// What is asked for of many shapes.
struct FamilyRequest {
    std::string csv;          ///< where the table is written; empty: there is none
    std::string reference;    ///< the name of one of the files, whose loops the others' correspond to; empty: the first
                              ///< that can be mapped
    bool with_error = false;  ///< bars of the numbers, each from a map of a finer mesh
    UniformizeOptions options;
};

/// --csv, --reference, --error. @param table what is written for --csv @param bars what --error adds
void add_family_options(CLI::App& app, FamilyRequest& request, const std::string& table, const std::string& bars);

/// @throws CLI::ValidationError an option of a table where none is asked for
void require_csv(const FamilyRequest& request);

struct FamilyRow {
    std::string label;   ///< the file's name
    bool known = false;  ///< whether there is a module
    VectorXd module;     ///< in the common order
    VectorXd error;      ///< bars (module_error), if asked for
    std::string note;    ///< why there is none, or that the map has not converged
};

struct ShapeFamily {
    std::vector<std::string> columns;  ///< names of the module's numbers
    std::vector<FamilyRow> rows;       ///< in the order of the files
    bool converged = true;             ///< all that have one
};

/// The mesh files of a folder, by name; a file stands for itself.
/// @throws InputError a folder without any; FileError it cannot be read
std::vector<std::string> mesh_files(const std::vector<std::string>& paths);

/// Maps all shapes, one after the other; the loops of each correspond to those of the reference (match_loops).
/// @param order chooses the order of the reference's loops @throws what read_shape throws for the reference; Cancelled
ShapeFamily read_family(const FamilyRequest& request, const std::vector<std::string>& files,
                        const std::function<std::vector<int>(const ShapeInput&)>& order, const CancelToken& token);

/// Writes a table of the family to a file; a line on stderr if shapes have no module. @return what the command ends
/// with
int write_table(const ShapeFamily& family, const std::string& table, const std::string& path, const CancelToken& token);

/// A row a shape: label, the module, its bars if there are, note. RFC 4180, NA where there is no number: as R's
/// read.csv and pandas read it.
std::string module_table(const ShapeFamily& family);

/// A row a pair: a, b, L2 distance, its bar if there are any.
std::string distance_table(const ShapeFamily& family);

}  // namespace koebe::cli
