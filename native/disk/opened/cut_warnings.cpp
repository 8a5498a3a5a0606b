#include "opened/cut_warnings.h"

#include "core/counted.h"
#include "core/sort_unique.h"
#include "quality/shared_warnings.h"

#include <algorithm>
#include <array>
#include <iterator>
#include <map>

namespace koebe {
namespace {

constexpr std::array kinds{CutKind::crowded_edge, CutKind::orientation, CutKind::bow_tie, CutKind::handle,
                           CutKind::opening};

std::vector<Index> sorted(std::vector<Index> numbers)
{
    sort_unique(numbers);
    return numbers;
}

/// "2 loops through handles", for all cuts of a kind.
std::string of_kind(CutKind kind, const std::vector<const SurfaceCut*>& cuts)
{
    switch (kind) {
    case CutKind::crowded_edge: return counted(cuts.size(), "seam") + " along edges of three or more faces";
    case CutKind::orientation: return counted(cuts.size(), "seam") + " where the surface changes its side";
    case CutKind::bow_tie: return "fans of faces separated at " + counted(cuts.front()->vertices.size(), "vertex");
    case CutKind::handle: return counted(cuts.size(), "handle") + " cut";
    case CutKind::opening: return counted(cuts.size(), "slit") + " that open a closed surface";
    }
    return {};
}

Warning warning_of_cuts(const std::vector<SurfaceCut>& cuts)
{
    Warning warning{WarningKind::cut, "cut in the UVs: "};
    bool first = true;
    for (const CutKind kind : kinds) {
        std::vector<const SurfaceCut*> own;
        for (const SurfaceCut& cut : cuts)
            if (cut.kind == kind) own.push_back(&cut);
        if (own.empty()) continue;
        if (!std::exchange(first, false)) warning.sentence += ", ";
        warning.sentence += of_kind(kind, own);
        for (const SurfaceCut* cut : own)
            warning.elements.insert(warning.elements.end(), cut->vertices.begin(), cut->vertices.end());
    }
    warning.elements = sorted(std::move(warning.elements));
    return warning;
}

Warning left_out_warning(const std::vector<LeftOutFace>& left_out)
{
    Warning warning{WarningKind::left_out, ""};
    std::size_t degenerate = 0;
    for (const LeftOutFace& out : left_out) {
        warning.elements.push_back(out.face);
        degenerate += out.degenerate ? 1 : 0;
    }
    if (degenerate > 0) warning.sentence = counted(degenerate, "face") + " with fewer than three different vertices";
    if (const std::size_t twice = left_out.size() - degenerate; twice > 0) {
        if (degenerate > 0) warning.sentence += " and ";
        warning.sentence += counted(twice, "face") + " with the vertices of another face";
    }
    warning.sentence += " left out of the map, and drawn on their neighbours";
    return warning;
}

/// Merges warnings of one kind. Places of loops make sense only within their piece.
std::vector<Warning> merged(const std::vector<MappedPiece>& pieces)
{
    std::map<WarningKind, std::vector<const Warning*>> by_kind;
    std::map<WarningKind, std::size_t> pieces_with;
    for (const MappedPiece& piece : pieces) {
        std::map<WarningKind, bool> met;
        for (const Warning& warning : piece.map.warnings) {
            by_kind[warning.kind].push_back(&warning);
            if (!std::exchange(met[warning.kind], true)) ++pieces_with[warning.kind];
        }
    }
    // A sentence for each kind, with the elements of all pieces. Numbers of loops mean nothing without their piece.
    std::vector<Warning> result;
    for (const auto& [kind, own] : by_kind) {
        if (pieces.size() == 1) {
            for (const Warning* warning : own) result.push_back(*warning);
            continue;
        }
        Warning all{kind, "in " + counted(pieces_with[kind], "piece") + " of " + std::to_string(pieces.size()) + ": " +
                              own.front()->sentence};
        if (own.size() > 1) all.sentence += ", and similar warnings";
        all.advice = own.front()->advice;
        if (elements_of(kind) != ElementKind::loops)
            for (const Warning* warning : own)
                all.elements.insert(all.elements.end(), warning->elements.begin(), warning->elements.end());
        all.elements = sorted(std::move(all.elements));
        result.push_back(std::move(all));
    }
    return result;
}

}  // namespace

std::string cut_text(const SurfaceCut& cut)
{
    const bool closed = cut.vertices.size() > 2 && cut.vertices.front() == cut.vertices.back();
    const std::string along = counted(cut.vertices.size() - 1, "edge");
    switch (cut.kind) {
    case CutKind::crowded_edge: return "seam along edges of three or more faces, " + along;
    case CutKind::orientation: return "seam where the surface changes its side, " + along;
    case CutKind::bow_tie: return "fans of faces separated at " + counted(cut.vertices.size(), "vertex");
    case CutKind::handle: return (closed ? "loop through a handle, " : "part of a loop through a handle, ") + along;
    case CutKind::opening: return "slit that opens a closed surface, " + along;
    }
    return {};
}

std::vector<Warning> cut_warnings(const CutUniformizeResult& result)
{
    std::vector<Warning> warnings;
    if (!result.cuts.empty()) warnings.push_back(warning_of_cuts(result.cuts));
    if (result.pieces.size() > 1)
        warnings.push_back(
            {WarningKind::pieces,
             std::to_string(result.pieces.size()) + " pieces, each with a map of its own, side by side in the square"});
    if (!result.left_out.empty()) warnings.push_back(left_out_warning(result.left_out));
    warn_reoriented(result.turned, warnings);
    for (Warning& warning : merged(result.pieces)) warnings.push_back(std::move(warning));
    // Of the whole sheet: a piece may be right by itself, and flipped where it lies.
    std::vector<Index> flipped;
    const Distortion& distortion = result.distortion;
    std::ranges::set_difference(distortion.flipped, distortion.below_resolution, std::back_inserter(flipped));
    if (!flipped.empty() && result.pieces.size() > 1)
        warnings.push_back(
            {WarningKind::flipped, counted(flipped.size(), "face") + " flipped where the pieces lie", flipped});
    Warning none{WarningKind::not_mapped, ""};
    std::size_t unmapped = 0;
    for (const MappedPiece& piece : result.pieces)
        if (!piece.mapped) {
            ++unmapped;
            none.elements.insert(none.elements.end(), piece.faces.begin(), piece.faces.end());
        }
    if (unmapped > 0) {
        none.sentence = counted(unmapped, "piece") + " of " + counted(none.elements.size(), "face") +
                        " without a map, each drawn as one point";
        none.elements = sorted(std::move(none.elements));
        warnings.push_back(std::move(none));
    }
    return warnings;
}

}  // namespace koebe
