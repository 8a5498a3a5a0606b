#include "core/errors.h"

#include "core/enum_words.h"

#include <array>

namespace koebe {

const char* to_string(TopologyKind kind) noexcept
{
    return word_of(
        kind, std::array{"closed", "genus", "nonmanifold_edge", "nonmanifold_vertex", "nonorientable", "disconnected"});
}

ElementKind elements_of(TopologyKind kind) noexcept
{
    switch (kind) {
    case TopologyKind::genus:
    case TopologyKind::nonmanifold_vertex: return ElementKind::vertices;
    case TopologyKind::nonmanifold_edge:
    case TopologyKind::nonorientable: return ElementKind::edges;
    case TopologyKind::closed:
    case TopologyKind::disconnected: return ElementKind::faces;
    }
    return ElementKind::none;
}

}  // namespace koebe
