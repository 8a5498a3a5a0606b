#include "io/obj_text.h"

#include "execution/thread_share.h"
#include "files/text_lines.h"

#include <algorithm>
#include <array>
#include <numeric>

namespace koebe::io {
namespace {

constexpr std::string_view own_comment = "# Koebe UV ";  // from an earlier run; the writer adds its own

/// The contents of a statement, as bits.
enum Content : unsigned {
    nothing = 0,
    groups = 1,
    materials = 2,
    smoothing = 4,
    normals = 8,
    colours = 16,
    lines = 32,
    others = 64
};
constexpr std::array<const char*, 7> content_names{"groups",         "materials",        "smoothing groups", "normals",
                                                   "vertex colours", "lines and points", "other statements"};

Content content_of(std::string_view keyword)
{
    if (keyword == "g" || keyword == "o") return groups;
    if (keyword == "usemtl" || keyword == "mtllib") return materials;
    if (keyword == "s") return smoothing;
    if (keyword == "l" || keyword == "p") return lines;
    return keyword.empty() ? nothing : others;
}

/// Pieces of whole statements.
std::vector<std::string_view> pieces_of_text(std::string_view text)
{
    constexpr std::size_t least_bytes = std::size_t{1} << 20;
    std::vector<std::string_view> pieces;
    while (!text.empty()) {
        std::size_t end = std::min(least_bytes, text.size());
        for (bool joined = true; joined && end < text.size();) {
            const std::size_t begin = text.rfind('\n', end - 1) + 1;
            end = std::min(text.find('\n', end), text.size() - 1) + 1;
            joined = joins_next_line(text.substr(begin, end - 1 - begin));
        }
        pieces.push_back(text.substr(0, end));
        text.remove_prefix(end);
    }
    return pieces;
}

/// The vertex of a corner and its normal, as they stand in "v/vt/vn"; empty if missing.
struct Corner {
    explicit Corner(std::string_view word) : vertex(word.substr(0, word.find('/')))
    {
        word.remove_prefix(std::min(vertex.size() + 1, word.size()));
        word.remove_prefix(std::min(word.find('/'), word.size()));
        normal = word.substr(std::min<std::size_t>(1, word.size()));
    }
    std::string_view vertex, normal;
};

}  // namespace

void add_obj_corner(TextWriter& text, Index vertex, Index texture)
{
    if (vertex == texture) return text.add_twice(vertex + 1, '/');
    text.add_number(vertex + 1);
    text.add('/');
    text.add_number(texture + 1);
}

/// Counts the statements of a piece.
class ObjText::Scan {
public:
    Scan() = default;
    explicit Scan(std::string_view piece)
    {
        TextLines text(piece);
        while (text.next_statement()) {
            const char* const begin = text.here();
            const std::string_view keyword = text.next_word_of_joined_lines();
            if (keyword == "v") {
                ++counts.vertices;
                if (!(contents & colours) && has_colour(text)) contents |= colours;
            } else if (keyword == "f") {
                if (counts.faces == 0) first_face = static_cast<std::size_t>(begin - piece.data());
                if (counts.faces++ == 0) before_faces = {counts.vertices, counts.normals, 0, 0};
            } else if (keyword == "vt") {
                ++counts.texture_coordinates;
            } else if (keyword == "vn") {
                ++counts.normals;
                contents |= Content::normals;
            } else {
                contents |= content_of(keyword);
            }
        }
    }

    Counts counts, before_faces;
    unsigned contents = nothing;
    std::size_t first_face = 0;

private:
    static bool has_colour(TextLines& text)
    {
        double number = 0.0;
        int numbers = 0;
        while (numbers < 6 && (text.next_plain(number) || !text.next_word_of_joined_lines().empty())) ++numbers;
        return numbers == 6;
    }
};

/// Writes a piece again.
class ObjText::Copy {
public:
    Copy(TextWriter& out, const ObjText& whole, const Piece& piece, const ObjChange& change)
        : out_(out),
          whole_(whole),
          change_(change),
          text_(piece.text),
          end_(piece.text.data() + piece.text.size()),
          at_(piece.before)
    {
        while (text_.next_statement()) {
            begin_ = text_.here();
            if (kept_from_ == nullptr) kept_from_ = begin_;
            add_statement(text_.next_word_of_joined_lines());
        }
        if (kept_from_ != nullptr) add_kept(end_);
        if (kept_from_ != nullptr && !piece.text.ends_with('\n')) out_.add(whole_.end_of_line_);
    }

    std::size_t faces_without_normals = 0;

private:
    void add_statement(std::string_view keyword)
    {
        const bool new_texture = !change_.texture.empty();
        if (keyword == "f") {
            add_face(at_.faces++);
        } else if (keyword == "v") {
            if (change_.moved) add_vertex(at_.vertices);
            ++at_.vertices;
        } else if (keyword == "vn") {
            ++at_.normals;
            if (change_.moved) leave_out();
        } else if (keyword == "vt") {
            if (new_texture) leave_out();
        } else if (keyword == "l" || keyword == "surf") {
            if (new_texture) add_references(keyword);
        } else if (keyword.empty() && text_.rest_of_line().starts_with(own_comment)) {
            leave_out();
        }
    }

    void add_kept(const char* end) { out_.add(text_between(kept_from_, end)); }

    void leave_out()
    {
        add_kept(begin_);
        kept_from_ = nullptr;
    }

    void take_words()
    {
        words_.clear();
        for (std::string_view word = text_.next_word_of_joined_lines(); !word.empty();
             word = text_.next_word_of_joined_lines())
            words_.push_back(word);
    }

    /// Ends a statement that is written anew: adds its comment and the end of the line.
    void end_statement()
    {
        const std::string_view rest = text_.rest_of_line();
        const char* const end = text_.here() + rest.size();
        if (!rest.empty()) {
            out_.add(' ');
            out_.add(rest);
        }
        const bool is_last = end == end_;  // the line has no end
        out_.add(is_last ? whole_.end_of_line_ : rest.empty() && end[-1] == '\r' ? "\r\n" : "\n");
    }

    void add_vertex(std::size_t v)
    {
        leave_out();
        take_words();
        out_.add('v');
        for (int axis = 0; axis < 3; ++axis) {
            out_.add(' ');
            out_.add_number(change_.mesh.vertices(static_cast<Eigen::Index>(v), axis));
        }
        for (const std::string_view word : std::span(words_).subspan(3)) {
            out_.add(' ');
            out_.add(word);
        }
        end_statement();
    }

    void add_references(std::string_view keyword)
    {
        leave_out();
        take_words();
        out_.add(keyword);
        for (const std::string_view word : words_) {
            const Corner corner(word);
            out_.add(' ');
            out_.add(corner.vertex);
            if (corner.normal.empty()) continue;
            out_.add("//");
            out_.add(corner.normal);
        }
        end_statement();
    }

    void add_face(std::size_t f)
    {
        if (change_.texture.empty()) return;
        leave_out();
        take_words();
        const bool with_normals = take_normals();
        out_.add('f');
        std::size_t corner = static_cast<std::size_t>(change_.mesh.face_begin[f]);
        for (std::size_t i = 0; i < words_.size(); ++i, ++corner) {
            out_.add(' ');
            add_obj_corner(out_, change_.mesh.corners[corner], change_.texture[corner]);
            if (!with_normals) continue;
            out_.add('/');
            out_.add_number(normals_[i]);
        }
        end_statement();
    }

    /// Takes the normals of the words, counted from 1. @return false if a word has none, or one that is not in the text
    bool take_normals()
    {
        normals_.clear();
        if (change_.moved || words_.empty() || Corner(words_[0]).normal.empty()) return false;
        for (const std::string_view word : words_) {
            Index number = 0;
            if (!to_number(Corner(word).normal, number)) number = 0;
            const std::int64_t normal = number < 0 ? static_cast<std::int64_t>(at_.normals) + 1 + number : number;
            if (normal < 1 || normal > static_cast<std::int64_t>(whole_.total_.normals)) {
                ++faces_without_normals;
                return false;
            }
            normals_.push_back(normal);
        }
        return true;
    }

    TextWriter& out_;
    const ObjText& whole_;
    const ObjChange& change_;
    TextLines text_;
    const char* const end_;
    Counts at_;
    const char *begin_ = nullptr, *kept_from_ = nullptr;  // start of the statement; start of the text to be copied
    std::vector<std::string_view> words_;
    std::vector<std::int64_t> normals_;
};

ObjText::ObjText(std::string_view text)
{
    const std::vector<std::string_view> texts = pieces_of_text(text);
    std::vector<Scan> scans(texts.size());
    in_pieces(texts.size(), 1, [&](std::size_t i, std::size_t) { scans[i] = Scan(texts[i]); });
    unsigned contents = nothing;
    for (std::size_t i = 0; i < texts.size(); ++i) {
        const bool has_first_face = total_.faces == 0 && scans[i].counts.faces > 0;
        const std::size_t head = has_first_face ? scans[i].first_face : texts[i].size();
        if (total_.faces == 0) pieces_.push_back({texts[i].substr(0, head), total_});
        if (has_first_face) first_with_faces_ = pieces_.size();
        if (has_first_face) pieces_.push_back({texts[i].substr(head), total_ + scans[i].before_faces});
        if (total_.faces > 0) pieces_.push_back({texts[i], total_});
        total_ = total_ + scans[i].counts;
        contents |= scans[i].contents;
    }
    for (std::size_t bit = 0; bit < content_names.size(); ++bit)
        if (contents >> bit & 1U) contents_.emplace_back(content_names[bit]);
    if (const std::size_t end = text.find('\n'); end != 0 && end != text.npos && text[end - 1] == '\r')
        end_of_line_ = "\r\n";
}

bool ObjText::holds(std::string_view content) const { return std::ranges::find(contents_, content) != contents_.end(); }

void ObjText::add_head(TextWriter& text, const ObjChange& change) const
{
    add_pieces(text, change, 0, first_with_faces_);
}

std::size_t ObjText::add_rest(TextWriter& text, const ObjChange& change) const
{
    return add_pieces(text, change, first_with_faces_, pieces_.size());
}

std::size_t ObjText::add_pieces(TextWriter& text, const ObjChange& change, std::size_t begin, std::size_t end) const
{
    std::vector<std::size_t> without_normals(end - begin);
    const auto add = [&](TextWriter& part, Index i) {
        const auto piece = static_cast<std::size_t>(i);
        without_normals[piece] = Copy(part, *this, pieces_[begin + piece], change).faces_without_normals;
    };
    text.add_each(static_cast<Index>(end - begin), add, 1);
    return std::accumulate(without_normals.begin(), without_normals.end(), std::size_t{0});
}

}  // namespace koebe::io
