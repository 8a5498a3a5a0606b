#include "svg/svg_document.h"

#include "core/errors.h"
#include "svg/svg_shown.h"
#include "svg/svg_styles.h"
#include "svg/svg_viewport.h"
#include "svg/svg_words.h"

#include <algorithm>
#include <array>
#include <optional>
#include <string>
#include <string_view>
#include <unordered_map>
#include <utility>
#include <vector>

namespace koebe::detail {
namespace {

constexpr std::size_t most_elements = 200000;  // with what uses and clip paths bring in: a drawing has no more corners
constexpr std::string_view svg_uri = "http://www.w3.org/2000/svg";

class Resolving {
public:
    Resolving(SvgDocument& document, SvgNode& root) : document_(document), root_(root) {}

    void run()
    {
        for (SvgNode* node = &root_; node; node = next_of(node)) {
            if (node->namespace_uri_size() == 0) node->namespace_uri(svg_uri.data(), svg_uri.size());
            if (name_of(*node) != "style") continue;
            for (const SvgNode* text = node->first_node(); text; text = text->next_sibling())
                sheet_.read({text->value(), text->value_size()});
        }
        for (SvgNode* node = &root_; node; node = next_of(node)) {
            take_styles(*node);
            if (const std::string_view id = value_of(*node, "id"); !id.empty()) by_id_.emplace(id, node);
        }
        // a copy is resolved, as uses copy elements that are as they were
        SvgNode* group = copy_of_children(root_);
        const std::optional<ViewBox> box = view_box_of(root_);
        const Size page{pixels_of(value_of(root_, "width"), 100.0).value_or(box ? box->width : 100.0),
                        pixels_of(value_of(root_, "height"), 100.0).value_or(box ? box->height : 100.0)};
        for (const char* name : {"clip-path", "mask"}) {
            set(*group, name, value_of(root_, name));
            set(root_, name, "");
        }
        elements_ = 0;
        Shown shown;
        const bool drawn = inherit(root_, shown);
        if (drawn) resolve_group(*group, shown, box ? Size{box->width, box->height} : page, 1);
        root_.remove_all_nodes();
        if (drawn) root_.append_node(group);
        if (box && value_of(root_, "preserveAspectRatio").starts_with("none"))
            set(*group, "transform", viewport_transform(*box, "none", {0.0, 0.0, page.width, page.height}));
    }

private:
    SvgNode* next_of(SvgNode* node) const
    {
        const auto element = [](SvgNode* one) {
            while (one && one->type() != rapidxml_ns::node_element) one = one->next_sibling();
            return one;
        };
        if (SvgNode* child = element(node->first_node())) return child;
        for (; node != &root_; node = node->parent())
            if (SvgNode* next = element(node->next_sibling())) return next;
        return nullptr;
    }

    void set(SvgNode& node, std::string_view name, std::string_view value)
    {
        for (auto* one = node.first_attribute(); one;) {
            auto* const next = one->next_attribute();
            if (std::string_view(one->local_name(), one->local_name_size()) == name) node.remove_attribute(one);
            one = next;
        }
        const auto stored = [&](std::string_view text) {
            return document_.allocate_string(text.empty() ? "" : text.data(), text.size());
        };
        if (!value.empty())
            node.append_attribute(document_.allocate_attribute(stored(name), stored(value), name.size(), value.size()));
    }

    /// The properties of rules and of `style` as attributes.
    void take_styles(SvgNode& node)
    {
        for (auto& [property, value] : sheet_.properties_of(node)) {
            if (property == "transform" && value == "none") value.clear();
            if (property == "transform")  // CSS has units where SVG has none
                for (const std::string_view unit : {"px", "deg"})
                    for (std::size_t at = value.find(unit); at != std::string::npos; at = value.find(unit))
                        value.erase(at, unit.size());
            set(node, property, value);
        }
        set(node, "style", "");
    }

    SvgNode* new_group(const char* name = "g")
    {
        SvgNode* group = document_.allocate_node(rapidxml_ns::node_element, name);
        group->namespace_uri(svg_uri.data(), svg_uri.size());
        return group;
    }

    /// A group with copies of an element's children.
    SvgNode* copy_of_children(const SvgNode& node)
    {
        SvgNode* group = new_group();
        for (const SvgNode* child = node.first_node(); child; child = child->next_sibling())
            if (child->type() == rapidxml_ns::node_element) group->append_node(copy_of(*child));
        return group;
    }

    SvgNode* copy_of(const SvgNode& node)
    {
        if (++elements_ > most_elements)
            throw InputError("with what its uses bring in the SVG has over 200,000 elements");
        SvgNode* copy = document_.allocate_node(rapidxml_ns::node_element);
        copy->qname(node.name(), node.name_size(), node.local_name());
        copy->namespace_uri(node.namespace_uri(), node.namespace_uri_size());
        for (const auto* one = node.first_attribute(); one; one = one->next_attribute()) {
            auto* attribute = document_.allocate_attribute();
            attribute->qname(one->name(), one->name_size(), one->local_name());
            attribute->namespace_uri(one->namespace_uri(), one->namespace_uri_size());
            attribute->value(one->value(), one->value_size());
            copy->append_attribute(attribute);
        }
        for (const SvgNode* child = node.first_node(); child; child = child->next_sibling())
            if (child->type() == rapidxml_ns::node_element) copy->append_node(copy_of(*child));
        return copy;
    }

    /// A group in place of an <svg>, or of a <symbol> for a use that may give its size. @param size of the viewport
    /// around, replaced by the one inside
    SvgNode* viewport_group(const SvgNode& node, const SvgNode* use, Size& size)
    {
        const auto length = [&](std::string_view name, double whole, double otherwise) {
            if (use && name.size() > 1)  // width and height: x and y of a use move its group
                if (const auto given = pixels_of(value_of(*use, name), whole)) return *given;
            return pixels_of(value_of(node, name), whole).value_or(otherwise);
        };
        const bool is_symbol = name_of(node) == "symbol";
        const ViewBox port{is_symbol ? 0.0 : length("x", size.width, 0.0),
                           is_symbol ? 0.0 : length("y", size.height, 0.0), length("width", size.width, size.width),
                           length("height", size.height, size.height)};
        SvgNode* group = copy_of_children(node);
        for (const char* name : drawn_properties)
            if (std::string_view(name) != "transform") set(*group, name, value_of(node, name));
        const std::optional<ViewBox> box = view_box_of(node);
        if (!(port.width > 0.0 && port.height > 0.0)) set(*group, "display", "none");
        const ViewBox inside = box.value_or(ViewBox{0.0, 0.0, port.width, port.height});
        // the viewport cuts in the coordinates around it, where a clip path of the element lies too
        SvgNode* outer = new_group();
        for (const char* name : drawn_properties) set(*outer, name, value_of(*group, name));
        for (const char* name : {"clip-path", "mask", "opacity"}) set(*group, name, "");
        set(*outer, "transform", value_of(node, "transform"));
        if (port.width > 0.0 && port.height > 0.0)
            set(*group, "transform", viewport_transform(inside, value_of(node, "preserveAspectRatio"), port));
        if (const std::string_view over = value_of(node, "overflow"); over != "visible" && over != "auto")
            ports_.emplace(outer, port);
        outer->append_node(group);
        size = {inside.width, inside.height};
        return outer;
    }

    /// The element that "#name" means, if there is one.
    SvgNode* element_of(std::string_view link) const
    {
        const auto found = link.starts_with('#') ? by_id_.find(std::string(link.substr(1))) : by_id_.end();
        return found == by_id_.end() ? nullptr : found->second;
    }

    /// A group in place of a <use>. @return none if there is no such element
    SvgNode* used_group(const SvgNode& use, Size& size)
    {
        const SvgNode* target = element_of(value_of(use, "href"));
        if (!target) return nullptr;
        SvgNode* group = new_group();
        for (const char* name : drawn_properties) set(*group, name, value_of(use, name));
        const double x = pixels_of(value_of(use, "x"), size.width).value_or(0.0);
        const double y = pixels_of(value_of(use, "y"), size.height).value_or(0.0);
        set(*group, "transform",
            std::string(value_of(use, "transform")) + " translate(" + number_text(x) + " " + number_text(y) + ")");
        const std::string_view name = name_of(*target);
        group->append_node(name == "symbol" || name == "svg" ? viewport_group(*target, &use, size) : copy_of(*target));
        return group;
    }

    void resolve_children(SvgNode& parent, const Shown& shown, const Size& size, int depth)
    {
        if (depth > deepest_level)
            throw InputError("elements of the SVG are nested more than " + std::to_string(deepest_level) +
                             " deep, or a use or a clip path contains itself");
        const bool is_switch = name_of(parent) == "switch";
        bool chosen = false;
        for (SvgNode* child = parent.first_node(); child;) {
            SvgNode* const next = child->next_sibling();
            const bool is_element = child->type() == rapidxml_ns::node_element;
            const bool stays = is_element && conditions_hold(*child) && !(is_switch && chosen);
            chosen = chosen || stays;
            if (is_element && (!stays || !resolve_element(parent, child, shown, size, depth)))
                parent.remove_node(child);
            child = next;
        }
        if (is_switch) parent.name("g", 1);
    }

    /// Lengths of a shape in percent of the viewport become pixels.
    void take_percentages(SvgNode& node, const Size& size)
    {
        std::vector<std::pair<std::string, double>> lengths;
        for (const auto* one = node.first_attribute(); one; one = one->next_attribute()) {
            const std::string name(one->local_name(), one->local_name_size());
            const auto length = percentage_of(name, trimmed({one->value(), one->value_size()}), size);
            if (length) lengths.emplace_back(name, *length);
        }
        for (const auto& [name, length] : lengths) set(node, name, number_text(length));
    }

    /// A group around a shape that is cut, as clip paths lie in groups.
    SvgNode* cut_group(SvgNode& shape)
    {
        SvgNode* group = new_group();
        for (const char* name : {"transform", "clip-path", "mask"}) {
            set(*group, name, value_of(shape, name));
            set(shape, name, "");
        }
        group->append_node(copy_of(shape));
        return group;
    }

    /// A group of which nothing is drawn: its shape only counts in bounding boxes (SVG 2, 8.10).
    SvgNode* measured_group(const SvgNode& shape)
    {
        SvgNode* group = new_group();
        group->append_node(copy_of(shape));
        group->append_node(new_clip(new_group(), ""));
        return group;
    }

    /// @return false if the element goes
    bool resolve_element(SvgNode& parent, SvgNode* child, Shown shown, Size size, int depth)
    {
        const std::string_view name = name_of(*child);
        if (draws_nothing(name)) return false;
        if (!inherit(*child, shown)) return false;
        if (shown.role == Role::clip) set(*child, "fill-rule", value_of(*child, "clip-rule"));
        const Size around = size;
        const bool is_group = name == "g" || name == "a" || name == "switch";
        if (shown.role == Role::clip && (is_group || name == "svg"))
            return false;  // not in clip paths (SVG 1.1, 14.3.5)
        SvgNode* group = nullptr;
        if (name == "use") {
            group = used_group(*child, size);
        } else if (name == "svg") {
            group = viewport_group(*child, nullptr, size);
        } else if (!is_group && (is_cut_by(*child, "clip-path") || is_cut_by(*child, "mask"))) {
            group = cut_group(*child);
        }
        if (group) {
            parent.insert_node(child, group);
            resolve_children(*group, shown, size, depth + 1);
            add_clips(*group, around, depth);
            return false;
        }
        take_percentages(*child, size);
        if (is_group) {
            resolve_group(*child, shown, size, depth + 1);
            return true;
        }
        // a mask of plain white shapes cuts as a clip path does
        constexpr std::array shapes{"path", "rect", "circle", "ellipse", "polyline", "polygon", "line"};
        const bool is_shape = std::ranges::find(shapes, name) != shapes.end();
        const bool is_painted = shown.role == Role::clip || shown.filled || shown.stroked;
        if (!shown.visible || !shown.opaque || (is_shape && !is_painted)) {
            if (is_shape && shown.measured) parent.insert_node(child, measured_group(*child));
            return false;
        }
        if (!is_shape || (shown.role == Role::mask && (shown.coloured || shown.stroked || shown.translucent)))
            plain_ = false;
        return true;
    }

    // ---- clip paths and masks

    void resolve_group(SvgNode& group, const Shown& shown, const Size& size, int depth)
    {
        resolve_children(group, shown, size, depth);
        add_clips(group, size, depth);
    }

    /// Appends to a group the clips that cut it. A clip that cannot be drawn stays an attribute, which is reported.
    void add_clips(SvgNode& group, const Size& size, int depth)
    {
        if (const auto port = ports_.find(&group); port != ports_.end())
            group.append_node(rectangle_clip(port->second, "userSpaceOnUse"));
        for (const char* name : {"clip-path", "mask"}) {
            if (!is_cut_by(group, name)) continue;
            std::string_view link = value_of(group, name);
            if (!link.starts_with("url(") || !link.ends_with(')')) continue;
            link = trimmed(link.substr(4, link.size() - 5));
            if (link.size() > 1 && (link[0] == '"' || link[0] == '\'')) link = link.substr(1, link.size() - 2);
            const SvgNode* source = element_of(link);
            const bool is_mask = std::string_view(name) == "mask";
            if (!source ? link.starts_with('#')  // what is not there cuts nothing
                        : name_of(*source) == (is_mask ? "mask" : "clipPath") &&
                              append_clip(group, *source, is_mask ? Role::mask : Role::clip, size, depth))
                set(group, name, "");
        }
    }

    /// A <mask> as svg_drawing.cpp reads it: its shapes, united, cut the rest of the element around.
    SvgNode* new_clip(SvgNode* group, std::string_view units)
    {
        SvgNode* clip = new_group("mask");
        if (!units.empty()) set(*clip, "maskContentUnits", units);
        clip->append_node(group);
        return clip;
    }

    SvgNode* rectangle_clip(const ViewBox& box, std::string_view units)
    {
        SvgNode* group = new_group();
        SvgNode* rectangle = new_group("rect");
        for (const auto& [name, length] : {std::pair{"x", box.x}, {"y", box.y}, {"width", box.width}})
            set(*rectangle, name, number_text(length));
        set(*rectangle, "height", number_text(box.height));
        group->append_node(rectangle);
        return new_clip(group, units);
    }

    /// @return false if the clip path or mask holds more than shapes, or the mask is not plain white
    bool append_clip(SvgNode& to, const SvgNode& source, Role role, const Size& size, int depth)
    {
        // what the clip inherits where it stands
        const bool is_mask = role == Role::mask;
        Shown shown{role};
        std::string_view rule;
        std::vector<const SvgNode*> above;
        for (const SvgNode* node = &source; node && node->type() == rapidxml_ns::node_element; node = node->parent()) {
            above.push_back(node);
            if (rule.empty()) rule = value_of(*node, is_mask ? "fill-rule" : "clip-rule");
        }
        for (auto node = above.rbegin(); node != above.rend(); ++node) inherit(**node, shown);

        SvgNode* group = copy_of_children(source);
        set(*group, "fill-rule", rule.empty() ? "nonzero" : rule);
        set(*group, "clip-path", value_of(source, "clip-path"));
        set(*group, is_mask ? "mask" : "transform", value_of(source, is_mask ? "mask" : "transform"));
        const bool plain_around = std::exchange(plain_, !is_mask || value_of(source, "mask-type") != "alpha");
        resolve_group(*group, shown, size, depth + 1);
        if (!std::exchange(plain_, plain_around)) return false;
        to.append_node(new_clip(group, value_of(source, is_mask ? "maskContentUnits" : "clipPathUnits")));

        // the region of a mask; by default it lies round all that is cut (SVG 1.1, 14.4)
        constexpr std::array sides{"x", "y", "width", "height"};
        if (!is_mask || std::ranges::all_of(sides, [&](const char* one) { return value_of(source, one).empty(); }))
            return true;
        const bool of_page = value_of(source, "maskUnits") == "userSpaceOnUse";
        const auto length = [&](const char* name, double whole, double otherwise) {
            return pixels_of(value_of(source, name), of_page ? whole : 1.0)
                .value_or(otherwise * (of_page ? whole : 1.0));
        };
        to.append_node(rectangle_clip({length("x", size.width, -0.1), length("y", size.height, -0.1),
                                       length("width", size.width, 1.2), length("height", size.height, 1.2)},
                                      of_page ? "userSpaceOnUse" : "objectBoundingBox"));
        return true;
    }

    SvgDocument& document_;
    SvgNode& root_;
    StyleSheet sheet_;
    std::unordered_map<std::string, SvgNode*> by_id_;
    std::unordered_map<const SvgNode*, ViewBox> ports_;  // of groups in place of elements with a viewport
    std::size_t elements_ = 0;
    bool plain_ = true;  // the clip at hand holds shapes only, a mask white ones
};

}  // namespace

void resolve(SvgDocument& document, SvgNode& root) { Resolving(document, root).run(); }

}  // namespace koebe::detail
