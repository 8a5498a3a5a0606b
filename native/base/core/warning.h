// Warnings about a result.
#pragma once

#include "core/api.h"
#include "core/elements.h"
#include "core/types.h"
#include "core/warning_kind.h"

#include <string>
#include <vector>

namespace koebe {

/// The enumerator's name, as in the JSON report.
KOEBE_API const char* to_string(WarningKind kind) noexcept;
/// The kind of elements that a warning lists.
KOEBE_API ElementKind elements_of(WarningKind kind) noexcept;

struct Warning {
    WarningKind kind;
    std::string sentence;              ///< without a full stop
    std::vector<Index> elements = {};  ///< ascending; loops by their place in the report
    std::string advice = {};           ///< a further sentence, or empty

    /// The sentence, then the first elements, then the advice.
    std::string text() const;
    bool operator==(const Warning&) const = default;
};

}  // namespace koebe
