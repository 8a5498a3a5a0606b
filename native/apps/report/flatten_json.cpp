#include "report/flatten_json.h"

#include "report/json.h"

namespace koebe {
namespace {

nlohmann::ordered_json stretch_json(const Stretch& stretch) { return {{"mean", stretch.mean}, {"max", stretch.max}}; }

}  // namespace

nlohmann::ordered_json to_json(const FlattenResult& result)
{
    using Json = nlohmann::ordered_json;
    Json pieces = Json::array(), seams = Json::array(), sheets = Json::array();
    // Lengths are in mm, as they are printed.
    for (const PatternPiece& piece : result.pieces)
        pieces.push_back({{"kind", to_string(piece.kind)},
                          {"faces", piece.faces},
                          {"size_mm", {piece.width, piece.height}},
                          {"outline_mm", piece.outline},
                          {"darts", piece.darts},
                          {"sheet", piece.sheet},
                          {"stretch_percent", stretch_json(piece.stretch)}});
    for (const PatternSeam& seam : result.seams)
        seams.push_back({{"pieces", seam.pieces},
                         {"length_mm", seam.length},
                         {"lengths_mm", seam.lengths},
                         {"closed", seam.closed}});
    // Sheets of pages, with the places of all labels.
    for (const PatternSheet& sheet : result.pattern.sheets) {
        Json labels = Json::array();
        for (const PatternLabel& label : sheet.labels)
            labels.push_back({{"text", label.text},
                              {"piece", label.piece},
                              {"at_mm", {label.at[0], label.at[1]}},
                              {"height_mm", label.height},
                              {"angle_deg", label.angle_deg}});
        sheets.push_back({{"size_mm", {sheet.width, sheet.height}},
                          {"columns", sheet.columns},
                          {"rows", sheet.rows},
                          {"labels", std::move(labels)}});
    }
    return report_json(result, {{"pieces", std::move(pieces)},
                                {"seams", std::move(seams)},
                                {"stretch_percent", stretch_json(result.stretch)},
                                {"cut_length_mm", result.cut_length},
                                {"darts", result.darts},
                                {"pages", result.pattern.pages()},
                                {"page_mm", {result.pattern.page.width, result.pattern.page.height}},
                                {"sheets", std::move(sheets)}});
}

}  // namespace koebe
