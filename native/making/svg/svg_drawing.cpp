#include "svg/svg_drawing.h"

#include "core/errors.h"
#include "planar/plane_box.h"
#include "svg/svg_document.h"
#include "svg/svg_text.h"

// svgpp's arcs seem uninitialized to gcc.
#if defined(__GNUC__) && !defined(__clang__)
#pragma GCC diagnostic ignored "-Wmaybe-uninitialized"
#endif
#include <boost/mpl/insert.hpp>
#include <boost/mpl/set.hpp>
#include <rapidxml_ns/rapidxml_ns.hpp>
#include <svgpp/policy/xml/rapidxml_ns.hpp>
// first, before svgpp
#include <svgpp/svgpp.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <exception>
#include <new>
#include <optional>
#include <set>
#include <string_view>
#include <type_traits>
#include <utility>

namespace koebe {
namespace {

using XmlNode = rapidxml_ns::xml_node<>;

constexpr std::size_t most_pieces = 1000000;  // curve segments
constexpr double closed_within = 1e-9;        // of a curve's size, between its ends
constexpr double box_tolerance = 1e-5;        // of bounding boxes, of their size

/// What the elements of the drawing add to.
struct DrawingSink {
    SvgDrawing drawing;
    std::size_t pieces = 0;

    /// The paths of the drawing (-1), or of a clip.
    std::vector<SvgPath>& paths_of(Index clip)
    {
        return clip < 0 ? drawing.paths : drawing.clips[static_cast<std::size_t>(clip)];
    }
};

/// The state inside an element; a child begins with a copy. svgpp calls its functions by these names.
class SvgElement {
public:
    explicit SvgElement(DrawingSink& sink) : sink_(&sink) {}
    SvgElement(const SvgElement& around)
        : sink_(around.sink_),
          transform_(around.transform_),
          even_odd_(around.even_odd_),
          clip_(around.clip_),
          first_(sink_->paths_of(clip_).size())
    {
    }
    SvgElement& operator=(const SvgElement&) = delete;
    ~SvgElement() = default;

    std::size_t first_inside() const { return first_; }

    void transform_matrix(const boost::array<double, 6>& m)
    {
        const std::array<double, 6> outer = transform_;
        for (int k = 0; k < 3; ++k) {
            const double x = m[2 * k], y = m[2 * k + 1];
            transform_[2 * k] = outer[0] * x + outer[2] * y + (k == 2 ? outer[4] : 0.0);
            transform_[2 * k + 1] = outer[1] * x + outer[3] * y + (k == 2 ? outer[5] : 0.0);
        }
    }

    void set(svgpp::tag::attribute::fill_rule, svgpp::tag::value::evenodd) { even_odd_ = true; }
    void set(svgpp::tag::attribute::fill_rule, svgpp::tag::value::nonzero) { even_odd_ = false; }
    void set(svgpp::tag::attribute::fill_rule, svgpp::tag::value::inherit) {}
    /// Takes the curves over. By now all attributes are known: they may come in any order.
    void on_exit_element()
    {
        if (clip_ < 0) sink_->drawing.open += open_;
        for (std::vector<Complex>& curve : path_.curves)
            for (Complex& z : curve) z = moved(z);
        path_.even_odd = even_odd_;
        if (!path_.curves.empty()) sink_->paths_of(clip_).push_back(std::move(path_));
        path_ = {};
    }

    void path_move_to(double x, double y, svgpp::tag::coordinate::absolute)
    {
        end_curve(false);
        curve_.assign(1, {x, y});
    }

    void path_line_to(double x, double y, svgpp::tag::coordinate::absolute) { line_to({x, y}); }

    void path_cubic_bezier_to(double x1, double y1, double x2, double y2, double x, double y,
                              svgpp::tag::coordinate::absolute)
    {
        add({Complex(x1, y1), Complex(x2, y2), Complex(x, y)});
    }

    void path_close_subpath()
    {
        if (curve_.empty()) return;
        const Complex first = curve_.front();
        end_curve(true);
        curve_.assign(1, first);
    }

    void path_exit()
    {
        end_curve(false);
        curve_.clear();
    }

private:
    Complex moved(Complex given) const
    {
        const double x = given.real(), y = given.imag();
        const Complex z{transform_[0] * x + transform_[2] * y + transform_[4],
                        -(transform_[1] * x + transform_[3] * y + transform_[5])};
        if (!std::isfinite(z.real()) || !std::isfinite(z.imag()))
            throw InputError("a number of the SVG is not finite, or too large");
        return z;
    }

    void line_to(Complex z)
    {
        if (!curve_.empty()) add({curve_.back() + (z - curve_.back()) / 3.0, z + (curve_.back() - z) / 3.0, z});
    }

    void add(std::array<Complex, 3> piece)
    {
        if (curve_.empty()) return;
        if (++sink_->pieces > most_pieces) throw InputError("the SVG has over a million curve segments");
        curve_.insert(curve_.end(), piece.begin(), piece.end());
    }

    void end_curve(bool close)
    {
        if (curve_.size() < 2) return;
        double size = 0.0;
        for (const Complex z : curve_) size = std::max(size, std::abs(z - curve_.front()));
        if (size == 0.0) return;
        const bool closes = std::abs(curve_.back() - curve_.front()) <= closed_within * size;
        if (!close && !closes && clip_ < 0) {  // a clip is filled, which closes
            ++open_;
            return;
        }
        if (!closes) line_to(curve_.front());
        curve_.back() = curve_.front();
        path_.curves.push_back(std::move(curve_));
    }

protected:
    /// Takes the bounding box of paths, from the one with this number on, for the unit square (SVG 1.1, 7.11).
    void enter_bounding_box(const std::vector<SvgPath>& paths, std::size_t first)
    {
        const auto& m = transform_;
        const double det = m[0] * m[3] - m[1] * m[2];
        std::vector<Complex> points;
        for (std::size_t k = first; k < paths.size() && det != 0.0; ++k) {
            SvgPath path = paths[k];
            double size = 0.0;
            for (auto& curve : path.curves)
                for (Complex& z : curve) {
                    const double x = z.real() - m[4], y = -z.imag() - m[5];
                    z = {(m[3] * x - m[2] * y) / det, (m[0] * y - m[1] * x) / det};
                    size = std::max(size, std::abs(z - path.curves[0][0]));
                }
            for (const auto& polygon : flattened(path, box_tolerance * size))
                points.insert(points.end(), polygon.begin(), polygon.end());
        }
        const PlaneBox box = points.empty() ? PlaneBox{} : box_around(points);
        const Complex size = points.empty() ? Complex() : box.size();
        transform_matrix({{size.real(), 0.0, 0.0, size.imag(), box.low.real(), box.low.imag()}});
    }

    DrawingSink* sink_;
    std::array<double, 6> transform_{1.0, 0.0, 0.0, 1.0, 0.0, 0.0};
    bool even_odd_ = false;
    Index clip_ = -1;        // what the paths are of: the drawing, or this clip
    std::size_t first_ = 0;  // path inside the element

private:
    int open_ = 0;
    std::vector<Complex> curve_;
    SvgPath path_;
};

/// A clip, which cuts all paths of the element around: it comes last there (svg_document.h).
class SvgClip : public SvgElement {
public:
    explicit SvgClip(const SvgElement& around) : SvgElement(around), cut_(clip_), first_cut_(around.first_inside())
    {
        clip_ = static_cast<Index>(sink_->drawing.clips.size());
        sink_->drawing.clips.emplace_back();
    }

    using SvgElement::set;
    void set(svgpp::tag::attribute::maskContentUnits, svgpp::tag::value::userSpaceOnUse) {}
    void set(svgpp::tag::attribute::maskContentUnits, svgpp::tag::value::objectBoundingBox)
    {
        enter_bounding_box(sink_->paths_of(cut_), first_cut_);
    }

    void on_exit_element()
    {
        std::vector<std::vector<SvgPath>>& clips = sink_->drawing.clips;
        Index clip = clip_;
        // a neighbour with the same clip is cut together with this element (planar/filled_paths.h)
        if (clip > 0 && clip + 1 == static_cast<Index>(clips.size()) && clips[clips.size() - 2] == clips.back()) {
            clips.pop_back();
            --clip;
        }
        std::vector<SvgPath>& paths = sink_->paths_of(cut_);
        for (std::size_t k = first_cut_; k < paths.size(); ++k) paths[k].clips.push_back(clip);
    }

private:
    Index cut_;
    std::size_t first_cut_;
};

struct SvgElementFactories {
    template <class Parent, class Tag>
    struct apply {  // NOLINT(readability-identifier-naming): SVG++ asks for it by this name
        using type = svgpp::factory::context::on_stack<
            std::conditional_t<std::is_same_v<Tag, svgpp::tag::element::mask>, SvgClip, SvgElement>>;
    };
};

/// Passes over what has no outlines; a damaged attribute of a shape is an error.
struct SvgErrors : svgpp::policy::error::raise_exception<SvgElement> {
    static constexpr auto unknown_element = [](const SvgElement&, auto&&...) { return true; };
    static constexpr auto unknown_attribute = unknown_element, unexpected_attribute = unknown_element,
                          unexpected_element = unknown_element, required_attribute_not_found = unknown_element;
};

namespace element = svgpp::tag::element;
namespace attribute = svgpp::tag::attribute;

using SvgElements = boost::mpl::set<element::svg, element::g, element::a, element::path, element::rect, element::circle,
                                    element::ellipse, element::polyline, element::polygon, element::mask>::type;
using SvgAttributes = boost::mpl::insert<
    boost::mpl::insert<boost::mpl::insert<svgpp::traits::shapes_attributes_by_element, attribute::transform>::type,
                       attribute::fill_rule>::type,
    attribute::maskContentUnits>::type;

using SvgTraversal =
    svgpp::document_traversal<svgpp::processed_elements<SvgElements>, svgpp::processed_attributes<SvgAttributes>,
                              svgpp::context_factories<SvgElementFactories>, svgpp::error_policy<SvgErrors>,
                              svgpp::path_policy<svgpp::policy::path::minimal>>;

const XmlNode* next_in_document(const XmlNode* node, const XmlNode* root)
{
    if (node->first_node()) return node->first_node();
    while (node != root && !node->next_sibling()) node = node->parent();
    return node == root ? nullptr : node->next_sibling();
}

std::vector<std::string> not_drawn_in(const XmlNode* root)
{
    std::set<std::string> names;
    for (const XmlNode* node = root; node; node = next_in_document(node, root)) {
        if (const std::string name(node->local_name(), node->local_name_size());
            name == "text" || name == "use" || name == "image")
            names.insert(name);
        for (const auto* one = node->first_attribute(); one; one = one->next_attribute()) {
            const std::string_view name(one->local_name(), one->local_name_size());
            if ((name == "clip-path" || name == "mask") && std::string_view(one->value(), one->value_size()) != "none")
                names.insert(name == "mask" ? "mask" : "clipPath");
        }
    }
    return {names.begin(), names.end()};
}

/// A box around the control points of paths, cut by the boxes of their clips. Empty: no value
std::optional<PlaneBox> box_of(const SvgDrawing& drawing, const std::vector<SvgPath>& paths,
                               std::vector<std::optional<std::optional<PlaneBox>>>& known)
{
    std::optional<PlaneBox> all;
    const auto low = [](Complex a, Complex b) {
        return Complex(std::min(a.real(), b.real()), std::min(a.imag(), b.imag()));
    };
    const auto high = [](Complex a, Complex b) {
        return Complex(std::max(a.real(), b.real()), std::max(a.imag(), b.imag()));
    };
    for (const SvgPath& path : paths) {
        std::vector<Complex> points;
        for (const auto& curve : path.curves) points.insert(points.end(), curve.begin(), curve.end());
        std::optional<PlaneBox> box = box_around(points);
        for (const Index clip : path.clips) {
            std::optional<std::optional<PlaneBox>>& other = known[clip];
            if (!other) other = box_of(drawing, drawing.clips[clip], known);
            if (box && *other) *box = {high(box->low, (*other)->low), low(box->high, (*other)->high)};
            const bool meet = box && *other && box->size().real() > 0.0 && box->size().imag() > 0.0;
            if (!meet) box.reset();
        }
        if (box) all = all ? PlaneBox{low(all->low, box->low), high(all->high, box->high)} : *box;
    }
    return all;
}

void measure_box(SvgDrawing& drawing)
{
    std::vector<std::optional<std::optional<PlaneBox>>> known(drawing.clips.size());
    const std::optional<PlaneBox> box = box_of(drawing, drawing.paths, known);
    if (!box) throw InputError("the clip paths and masks of the drawing leave nothing of it");
    const Complex size = box->size();
    if (!(std::isfinite(size.real()) && std::isfinite(size.imag()) && size.real() > 0.0 && size.imag() > 0.0))
        throw InputError("the drawing has no width or no height, or is too large");
    drawing.low = box->low;
    drawing.high = box->high;
}

std::string listed(const std::vector<std::string>& names)
{
    std::string text;
    for (const std::string& name : names) text += (text.empty() ? "" : ", ") + name;
    return text;
}

/// The start of a text that may hold any bytes.
std::string printable(const std::string& text)
{
    std::string start = text.substr(0, 200);
    for (char& c : start)
        if (c < ' ' || c > '~') c = '?';
    return start;
}

SvgDrawing traversed(std::string& bytes)
{
    rapidxml_ns::xml_document<> document;
    document.parse<rapidxml_ns::parse_no_string_terminators>(bytes.data());
    XmlNode* root = document.first_node();
    while (root && root->type() != rapidxml_ns::node_element) root = root->next_sibling();
    if (!root || std::string_view(root->local_name(), root->local_name_size()) != "svg")
        throw InputError("the file holds no svg element");
    detail::resolve(document, *root);
    DrawingSink sink;
    SvgElement outermost(sink);
    SvgTraversal::load_document(root, outermost);
    sink.drawing.not_drawn = not_drawn_in(root);
    return std::move(sink.drawing);
}

}  // namespace

SvgDrawing parse_svg(std::string bytes)
{
    if (bytes.find('\0') != std::string::npos) throw InputError("the SVG holds a zero byte: it is no text in UTF-8");
    bytes = detail::with_entities(std::move(bytes));
    detail::require_shallow(bytes);
    SvgDrawing drawing;
    try {
        drawing = traversed(bytes);
    } catch (const KoebeError&) {
        throw;
    } catch (const std::bad_alloc&) {
        throw;
    } catch (const rapidxml_ns::parse_error& error) {
        throw InputError(std::string("the SVG is damaged: ") + error.what() + " at byte " +
                         std::to_string(error.where<char>() - bytes.data()));
    } catch (const std::exception& error) {
        throw InputError("the SVG is damaged: " + printable(error.what()));
    }
    if (drawing.paths.empty())
        throw InputError("the SVG has no closed path" +
                         (drawing.not_drawn.empty() ? std::string() : "; it has " + listed(drawing.not_drawn)) +
                         ": convert text and strokes to paths first");
    measure_box(drawing);
    return drawing;
}

std::vector<std::vector<Complex>> flattened(const SvgPath& path, double tolerance)
{
    constexpr double most = 1000.0;  // points of one segment
    std::vector<std::vector<Complex>> polygons;
    for (const std::vector<Complex>& curve : path.curves) {
        std::vector<Complex>& polygon = polygons.emplace_back();
        for (std::size_t i = 0; i + 3 < curve.size(); i += 3) {
            const Complex a = curve[i], b = curve[i + 1], c = curve[i + 2], d = curve[i + 3];
            const double bend = std::max(std::abs(a - 2.0 * b + c), std::abs(b - 2.0 * c + d));
            const double count = std::clamp(std::ceil(std::sqrt(0.75 * bend / tolerance)), 1.0, most);
            for (double k = 0.0; k < count; ++k) {
                const double t = k / count, s = 1.0 - t;
                polygon.push_back(s * s * s * a + 3.0 * s * s * t * b + 3.0 * s * t * t * c + t * t * t * d);
            }
        }
    }
    return polygons;
}

}  // namespace koebe
