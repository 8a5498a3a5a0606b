// The elements of an SVG as they are drawn: styles, switches and uses resolved. For svg_drawing.cpp only.
#pragma once

#include <rapidxml_ns/rapidxml_ns.hpp>

#include <string>

namespace koebe::detail {

using SvgDocument = rapidxml_ns::xml_document<>;
using SvgNode = rapidxml_ns::xml_node<>;

/// The text with the entities that its DOCTYPE declares in their places, and without the DOCTYPE, which Illustrator
/// writes with all namespaces as entities.
/// @throws InputError entities that grow to over 64 MB
std::string with_entities(std::string text);

/// Changes a document so that what is left can be drawn element by element:
/// - The properties that rules of <style> or the attribute `style` give an element become its attributes, by the order
///   of the cascade (W3C, CSS 2.2, 6.4.1). Selectors of types, classes, ids, descendants and children are known.
/// - Elements that are not shown go: by display, visibility, opacity 0, or neither fill nor stroke, of their own or a
///   parent's.
/// - Of a <switch> the first child whose conditions hold stays (SVG 1.1, 5.8).
/// - A <use> becomes a group with a copy of its element. A <symbol> in it and an inner <svg> become groups with their
///   place, viewBox and preserveAspectRatio as a transform.
/// @throws InputError uses that contain themselves, or more than a hundred levels or 200,000 elements
void resolve(SvgDocument& document, SvgNode& root);

}  // namespace koebe::detail
