#include "report/cut_json.h"

#include "opened/cut_warnings.h"
#include "report/json.h"

namespace koebe {
namespace {

using Json = nlohmann::ordered_json;

/// The entries of a piece's report that the mesh's report does not have, or has for the whole.
Json piece_json(const MappedPiece& piece)
{
    Json report{{"faces", piece.faces},
                {"mapped", piece.mapped},
                {"place",
                 {{"center", {0.5 * (1.0 + piece.place.center.real()), 0.5 * (1.0 + piece.place.center.imag())}},
                  {"radius", 0.5 * piece.place.radius}}}};
    const Json own = to_json(piece.map);
    for (const char* key : {"outer_loop", "center", "point", "converged", "sweeps", "steps", "history", "loops",
                            "mean_roundness", "angle_error_deg", "beltrami", "area_distortion", "conformal_energy",
                            "flipped", "below_resolution", "even", "overlaps", "seconds", "warnings"})
        if (own.contains(key)) report[key] = own[key];
    return report;
}

Json cuts_json(const std::vector<SurfaceCut>& cuts)
{
    Json array = Json::array();
    for (const SurfaceCut& cut : cuts)
        array.push_back({{"kind", to_string(cut.kind)}, {"elements", cut.vertices}, {"text", cut_text(cut)}});
    return array;
}

Json left_out_json(const std::vector<LeftOutFace>& left_out)
{
    Json array = Json::array();
    for (const LeftOutFace& out : left_out)
        array.push_back({{"face", out.face}, {"like", out.like < 0 ? Json() : Json(out.like)}});
    return array;
}

}  // namespace

Json to_json(const CutUniformizeResult& result)
{
    Json pieces = Json::array();
    for (const MappedPiece& piece : result.pieces) pieces.push_back(piece_json(piece));
    return report_json(result, {{"method", to_string(result.method)},
                                {"engine", to_string(result.engine)},
                                {"cut", true},
                                {"converged", result.converged},
                                {"cuts", cuts_json(result.cuts)},
                                {"handles_cut", result.handles},
                                {"left_out", left_out_json(result.left_out)},
                                {"turned", result.turned},
                                {"pieces", std::move(pieces)}});
}

}  // namespace koebe
