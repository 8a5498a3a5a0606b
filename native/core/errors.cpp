#include "core/errors.h"

namespace koebe {

const char* to_string(TopologyKind kind) noexcept
{
    switch (kind) {
    case TopologyKind::closed: return "closed";
    case TopologyKind::genus: return "genus";
    case TopologyKind::nonmanifold_edge: return "nonmanifold_edge";
    case TopologyKind::nonmanifold_vertex: return "nonmanifold_vertex";
    case TopologyKind::nonorientable: return "nonorientable";
    case TopologyKind::disconnected: return "disconnected";
    }
    return "unknown";
}

ElementKind elements_of(TopologyKind kind) noexcept
{
    switch (kind) {
    case TopologyKind::closed: return ElementKind::none;
    case TopologyKind::genus:
    case TopologyKind::nonmanifold_vertex: return ElementKind::vertices;
    case TopologyKind::nonmanifold_edge:
    case TopologyKind::nonorientable: return ElementKind::edges;
    case TopologyKind::disconnected: return ElementKind::faces;
    }
    return ElementKind::none;
}

}  // namespace koebe
