// The kinds of elements that errors and warnings list.
#pragma once

namespace koebe {

enum class ElementKind {
    none,  ///< nothing is listed
    vertices,
    faces,
    edges,      ///< each by the two vertices at its ends
    loops,      ///< or circles, by their place in the list
    points,     ///< points of planar polygons, by their place in all polygons
    landmarks,  ///< points of a correspondence, by their place in the list
};

constexpr const char* to_string(ElementKind kind) noexcept
{
    switch (kind) {
    case ElementKind::none: return "none";
    case ElementKind::vertices: return "vertices";
    case ElementKind::faces: return "faces";
    case ElementKind::edges: return "edges";
    case ElementKind::loops: return "loops";
    case ElementKind::points: return "points";
    case ElementKind::landmarks: return "landmarks";
    }
    return "none";
}

}  // namespace koebe
