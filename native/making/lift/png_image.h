// Reads a PNG file as grey (stb_image).
#pragma once

#include "core/api.h"

#include <cstdint>
#include <string>
#include <vector>

namespace koebe {

/// Rows from the top. Black is 0 and white 1, by the numbers in the file; no gamma is applied. Colours are weighted by
/// their luminance. A transparent pixel is black.
struct GreyImage {
    int width = 0, height = 0;
    std::vector<std::uint16_t> grey;  ///< (height x width), 0 to 65535

    double at(int column, int row) const { return grey[static_cast<std::size_t>(row) * width + column] / 65535.0; }
};

/// Of 1 to 16 bits, with or without palette, colours and transparency.
/// @param bytes of the file
/// @throws InputError it is no PNG; it is damaged, by the check sums too; over 64 million pixels
KOEBE_API GreyImage parse_png(const std::string& bytes);

}  // namespace koebe
