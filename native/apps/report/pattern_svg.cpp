#include "report/pattern_svg.h"

#include "files/text_writer.h"

#include <algorithm>

namespace koebe {
namespace {

constexpr double bar_length = 50.0, page_text = 3.0, cross_arm = 5.0, joint = 3.0;  // mm

std::string number(double value)
{
    char text[32];
    return {text, io::write_number(text, value + 0.0)};
}

std::string attribute(const char* name, const std::string& value)
{
    return ' ' + std::string(name) + "=\"" + value + "\"";
}

/// A page of a sheet.
class PageDrawing {
public:
    PageDrawing(const Pattern& pattern, const PatternSheet& sheet, int column, int row, int first)
        : page_(pattern.page), sheet_(sheet), column_(column), row_(row), first_(first), all_(pattern.pages())
    {
    }

    std::string text() const
    {
        const std::string w = number(width()), h = number(height());
        std::string svg = "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<svg xmlns=\"http://www.w3.org/2000/svg\"" +
                          attribute("width", w + "mm") + attribute("height", h + "mm") +
                          attribute("viewBox", "0 0 " + w + " " + h) +
                          ">\n<style>path,rect{fill:none;stroke:#000;stroke-width:.3}.seam{stroke:#555;"
                          "stroke-dasharray:2 1}.mark{stroke-width:.2}.page{stroke:#999;stroke-width:.2;"
                          "stroke-dasharray:1 1}.solid{stroke-dasharray:none}text{font-family:sans-serif;"
                          "text-anchor:middle;fill:#000}.note{text-anchor:start;fill:#666}</style>\n";
        if (page_.any()) svg += frame();
        for (const PatternLine& line : sheet_.lines)
            if (shows(line.points)) svg += path(line);
        for (const PatternLabel& label : sheet_.labels)
            if (shows(PlanarPoints(label.at))) svg += text_of(label);
        return svg + "</svg>\n";
    }

private:
    double width() const { return page_.any() ? page_.width : sheet_.width; }
    double height() const { return page_.any() ? page_.height : sheet_.height; }
    double frame_width() const { return width() - 2.0 * page_.margin; }
    double frame_height() const { return height() - 2.0 * page_.margin; }
    int page_number(int column, int row) const { return first_ + row * sheet_.columns + column; }

    double x(double on_sheet) const { return page_.margin + (on_sheet - column_ * frame_width()); }
    double y(double on_sheet) const { return page_.margin + (sheet_.height - row_ * frame_height() - on_sheet); }

    bool shows(const PlanarPoints& points) const
    {
        const Eigen::RowVector2d low = points.colwise().minCoeff(), high = points.colwise().maxCoeff();
        return x(high[0]) >= 0.0 && x(low[0]) <= width() && y(low[1]) >= 0.0 && y(high[1]) <= height();
    }

    std::string path(const PatternLine& line) const
    {
        const char* const kinds[] = {"cut", "seam", "mark"};
        std::string steps;
        for (const auto& point : line.points.rowwise())
            steps += (steps.empty() ? 'M' : 'L') + number(x(point[0])) + " " + number(y(point[1]));
        return "<path" + attribute("class", kinds[static_cast<int>(line.kind)]) +
               attribute("data-piece", std::to_string(line.piece)) + attribute("d", steps + (line.closed ? "Z" : "")) +
               "/>\n";
    }

    std::string text_of(const PatternLabel& label) const
    {
        const std::string at = number(x(label.at[0])) + " " + number(y(label.at[1]));
        return "<text" + attribute("data-piece", std::to_string(label.piece)) +
               attribute("font-size", number(1.4 * label.height)) +
               attribute("transform", "translate(" + at + ") rotate(" + number(-label.angle_deg) + ")") +
               attribute("y", number(0.5 * label.height)) + ">" + label.text + "</text>\n";
    }

    static std::string note(double x, double y, const std::string& text, const char* anchor = "start")
    {
        return "<text class=\"note\"" + attribute("style", std::string("text-anchor:") + anchor) +
               attribute("font-size", number(page_text)) + attribute("x", number(x)) + attribute("y", number(y)) + ">" +
               text + "</text>\n";
    }

    static std::string strokes(const std::string& steps)
    {
        return "<path class=\"page solid\"" + attribute("d", steps) + "/>\n";
    }

    std::string frame() const
    {
        const double m = page_.margin, right = m + frame_width(), low = m + frame_height();
        // The page's frame, and a bar under it by which the print's scale is checked.
        std::string svg = "<rect class=\"page\"" + attribute("x", number(m)) + attribute("y", number(m)) +
                          attribute("width", number(frame_width())) + attribute("height", number(frame_height())) +
                          "/>\n";
        const double bar = frame_width() > 3.0 * bar_length ? bar_length : 10.0, under = low + 0.5 * m;
        svg += strokes('M' + number(m) + " " + number(under - 1.0) + "v2M" + number(m) + " " + number(under) + "h" +
                       number(bar) + "m0 -1v2");
        // Which page it is.
        std::string words =
            number(bar) + " mm · page " + std::to_string(page_number(column_, row_)) + " of " + std::to_string(all_);
        if (sheet_.pages() > 1)
            words += " · column " + std::to_string(column_ + 1) + " of " + std::to_string(sheet_.columns) + ", row " +
                     std::to_string(row_ + 1) + " of " + std::to_string(sheet_.rows);
        svg += note(m + bar + 2.0, under + 0.35 * page_text, words);
        if (sheet_.pages() == 1) return svg;
        // For a sheet of several pages: crosses at the corners, and a mark at each joint.
        for (const double px : {m, right})
            for (const double py : {m, low})
                svg += strokes('M' + number(px - cross_arm) + " " + number(py) + "h" + number(2.0 * cross_arm) + "M" +
                               number(px) + " " + number(py - cross_arm) + "v" + number(2.0 * cross_arm));
        const double middle_x = 0.5 * (m + right), middle_y = 0.5 * (m + low);
        if (column_ > 0) svg += joint_at(m, middle_y, 1.0, 0.0, column_ - 1, row_);
        if (column_ + 1 < sheet_.columns) svg += joint_at(right, middle_y, -1.0, 0.0, column_ + 1, row_);
        if (row_ > 0) svg += joint_at(middle_x, m, 0.0, 1.0, column_, row_ - 1);
        if (row_ + 1 < sheet_.rows) svg += joint_at(middle_x, low, 0.0, -1.0, column_, row_ + 1);
        return svg;
    }

    /// A diamond over the frame, and the pages that it joins, inside.
    std::string joint_at(double px, double py, double inwards_x, double inwards_y, int column, int row) const
    {
        const int own = page_number(column_, row_), other = page_number(column, row);
        const std::string r = number(joint), back = number(-joint);
        return strokes('M' + number(px - joint) + " " + number(py) + "l" + r + " " + back + "l" + r + " " + r + "l" +
                       back + " " + r + "z") +
               note(px + 3.0 * joint * inwards_x, py + 2.0 * joint * inwards_y + 0.35 * page_text,
                    std::to_string(std::min(own, other)) + "–" + std::to_string(std::max(own, other)), "middle");
    }

    const Page& page_;
    const PatternSheet& sheet_;
    int column_, row_, first_, all_;
};

}  // namespace

std::vector<std::string> pattern_svg(const Pattern& pattern)
{
    std::vector<std::string> pages;
    for (const PatternSheet& sheet : pattern.sheets) {
        const int first = static_cast<int>(pages.size()) + 1;
        for (int row = 0; row < sheet.rows; ++row)
            for (int column = 0; column < sheet.columns; ++column)
                pages.push_back(PageDrawing(pattern, sheet, column, row, first).text());
    }
    return pages;
}

}  // namespace koebe
