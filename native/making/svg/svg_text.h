// The text of an SVG before it is parsed as XML.
#pragma once

#include <string>
#include <string_view>

namespace koebe::detail {

/// The text with the entities that its DOCTYPE declares in their places, and without the DOCTYPE, which Illustrator
/// writes with all namespaces as entities.
/// @throws InputError entities that grow to over 64 MB
std::string with_entities(std::string text);

/// Refuses deep nesting before the parser, which calls itself for each level.
/// @throws InputError naming the byte where the nesting is too deep
void require_shallow(std::string_view text);

}  // namespace koebe::detail
