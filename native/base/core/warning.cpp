#include "core/warning.h"

#include <cstddef>

namespace koebe {
namespace {

struct WarningRow {
    const char* name;
    ElementKind elements;
};

constexpr WarningRow warning_rows[] = {
#include "warning_rows.inc"
};

}  // namespace

const char* to_string(WarningKind kind) noexcept { return warning_rows[static_cast<std::size_t>(kind)].name; }

ElementKind elements_of(WarningKind kind) noexcept { return warning_rows[static_cast<std::size_t>(kind)].elements; }

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
