// The file that a written mesh was read from, in the same format.
#pragma once

#include <string_view>

namespace koebe {

/// Its bytes, or none. Writers keep all that they do not replace.
struct FiledText {
    std::string_view bytes = {};
    bool moved = false;  ///< the mesh has other positions: normals are left out
};

}  // namespace koebe
