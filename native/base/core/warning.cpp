#include "core/warning.h"

namespace koebe {

const char* to_string(WarningKind kind) noexcept
{
    switch (kind) {
    case WarningKind::collapsed_faces: return "collapsed_faces";
    case WarningKind::unused_vertices: return "unused_vertices";
    case WarningKind::coincident: return "coincident";
    case WarningKind::reoriented_faces: return "reoriented_faces";
    case WarningKind::thin_faces: return "thin_faces";
    case WarningKind::coarse_mesh: return "coarse_mesh";
    case WarningKind::no_flux: return "no_flux";
    case WarningKind::not_converged: return "not_converged";
    case WarningKind::no_circles: return "no_circles";
    case WarningKind::lost_circles: return "lost_circles";
    case WarningKind::shrunk_circles: return "shrunk_circles";
    case WarningKind::replaced_circles: return "replaced_circles";
    case WarningKind::flaps: return "flaps";
    case WarningKind::off_circle: return "off_circle";
    case WarningKind::below_resolution: return "below_resolution";
    case WarningKind::flipped: return "flipped";
    case WarningKind::not_one_to_one: return "not_one_to_one";
    case WarningKind::out_of_place: return "out_of_place";
    case WarningKind::packing: return "packing";
    case WarningKind::closing_gap: return "closing_gap";
    case WarningKind::flow_flips: return "flow_flips";
    case WarningKind::no_hole: return "no_hole";
    case WarningKind::not_fitted: return "not_fitted";
    case WarningKind::replaced_uvs: return "replaced_uvs";
    case WarningKind::not_kept: return "not_kept";
    case WarningKind::cut: return "cut";
    case WarningKind::pieces: return "pieces";
    case WarningKind::left_out: return "left_out";
    case WarningKind::not_even: return "not_even";
    case WarningKind::not_enclosed: return "not_enclosed";
    case WarningKind::crossings: return "crossings";
    case WarningKind::thin_bridges: return "thin_bridges";
    case WarningKind::lost_area: return "lost_area";
    case WarningKind::concave_polygons: return "concave_polygons";
    case WarningKind::not_mapped: return "not_mapped";
    }
    return "unknown";
}

ElementKind elements_of(WarningKind kind) noexcept
{
    switch (kind) {
    case WarningKind::unused_vertices:
    case WarningKind::coincident:
    case WarningKind::off_circle:
    case WarningKind::cut:
    case WarningKind::out_of_place: return ElementKind::vertices;
    case WarningKind::collapsed_faces:
    case WarningKind::reoriented_faces:
    case WarningKind::flaps:
    case WarningKind::below_resolution:
    case WarningKind::flipped:
    case WarningKind::left_out:
    case WarningKind::not_even:
    case WarningKind::crossings:
    case WarningKind::thin_bridges:
    case WarningKind::lost_area:
    case WarningKind::concave_polygons:
    case WarningKind::not_mapped:
    case WarningKind::not_one_to_one: return ElementKind::faces;
    case WarningKind::lost_circles:
    case WarningKind::shrunk_circles:
    case WarningKind::replaced_circles:
    case WarningKind::not_fitted: return ElementKind::loops;
    default: return ElementKind::none;
    }
}

std::string Warning::text() const
{
    std::string result = sentence;
    if (!elements.empty()) {
        const ElementKind of = elements_of(kind);
        const char* noun = of == ElementKind::vertices ? "vertex" : of == ElementKind::loops ? "loop" : "face";
        result += std::string("; the first ") + noun + " is " + std::to_string(elements.front());
    }
    if (!advice.empty()) result += ". " + advice;
    return result;
}

}  // namespace koebe
