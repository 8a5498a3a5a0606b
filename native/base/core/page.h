// Sizes of pages and units of length, in millimetres.
#pragma once

#include "core/api.h"

#include <optional>
#include <string>

namespace koebe {

enum class LengthUnit { mm, cm, m, in };

double millimetres(LengthUnit unit);

struct Page {
    double width = 0.0, height = 0.0;  ///< mm; 0: one sheet, as large as the pattern needs
    double margin = 0.0;               ///< mm at each edge, where printers print little and pages overlap

    bool any() const { return width > 0.0; }
};

/// @param name none, A0 to A4, letter, legal, tabloid, or WIDTHxHEIGHT in mm, each from 20 to 100,000
/// @return none if the name is none of these
KOEBE_API std::optional<Page> page_named(const std::string& name);

/// For an error's message.
KOEBE_API std::string page_help(const std::string& name);

}  // namespace koebe
