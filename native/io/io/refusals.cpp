#include "io/refusals.h"

#include "core/errors.h"

namespace koebe::io {

void refuse_size() { throw InputError("the mesh is too large for 32-bit indices"); }

void refuse(const std::string& element, std::size_t number, const char* complaint)
{
    throw InputError(element + ' ' + std::to_string(number) + ' ' + complaint,
                     element == "vertex" ? ElementKind::vertices : ElementKind::faces, {static_cast<Index>(number)});
}

void require_count_fits(std::size_t count, const std::string& element, std::size_t bytes)
{
    if (count > bytes) throw InputError("the header's count of " + element + " elements does not fit the file");
}

}  // namespace koebe::io
