#include "linear/dissection.h"

#include "core/thread_share.h"

#include <algorithm>
#include <numeric>
#include <utility>

namespace koebe::detail {
namespace {

/// Neighbours of each row, itself left out.
class RowGraph {
public:
    explicit RowGraph(const SparseMatrix& matrix)
        : begin_(matrix.outerIndexPtr()), neighbours_(matrix.innerIndexPtr()), size_(static_cast<Index>(matrix.cols()))
    {
        for (Index c = 0; c < size_; ++c)
            if (begin_[c] < begin_[c + 1] && neighbours_[begin_[c]] < c) return;  // both triangles
        own_begin_.assign(size_ + 2, 0);
        for (Index c = 0; c < size_; ++c)
            for (Index e = begin_[c]; e < begin_[c + 1]; ++e) {
                ++own_begin_[c + 2];
                if (neighbours_[e] != c) ++own_begin_[neighbours_[e] + 2];
            }
        std::partial_sum(own_begin_.begin(), own_begin_.end(), own_begin_.begin());
        own_neighbours_.resize(own_begin_.back());
        for (Index c = 0; c < size_; ++c)
            for (Index e = begin_[c]; e < begin_[c + 1]; ++e) {
                own_neighbours_[own_begin_[c + 1]++] = neighbours_[e];
                if (neighbours_[e] != c) own_neighbours_[own_begin_[neighbours_[e] + 1]++] = c;
            }
        begin_ = own_begin_.data();
        neighbours_ = own_neighbours_.data();
    }

    Index size() const { return size_; }
    const Index* begin(Index row) const { return neighbours_ + begin_[row]; }
    const Index* end(Index row) const { return neighbours_ + begin_[row + 1]; }

private:
    const Index* begin_;
    const Index* neighbours_;
    Index size_;
    std::vector<Index> own_begin_, own_neighbours_;
};

/// Marks of rows: of each set three, its own and those of the two searches through it.
struct Marks {
    Index own, there, back;
    explicit Marks(Index set) : own(3 * set), there(3 * set + 1), back(3 * set + 2) {}
};
constexpr Index left_out = -1, in_separator = -2;

struct PartedSet {
    std::vector<Index> rows;    // of a separator once it is parted
    Index children[2]{-1, -1};  // sets, if it is parted
};

class Dissector {
public:
    Dissector(const RowGraph& graph, std::vector<Index> mark, std::vector<Index> rows, Index most_rows)
        : graph_(graph), mark_(std::move(mark)), level_(graph.size()), most_rows_(most_rows)
    {
        sets_.emplace_back().rows = std::move(rows);
    }

    Dissection run()
    {
        // The sets of one depth side by side: no row of one is a neighbour of a row of another.
        for (std::size_t begin = 0; begin < sets_.size();) {
            const std::size_t end = sets_.size();
            std::vector<std::vector<Index>> halves(2 * (end - begin));
            each_beside(end - begin, [&](std::size_t i) {
                if (static_cast<Index>(sets_[begin + i].rows.size()) > most_rows_)
                    part(static_cast<Index>(begin + i), static_cast<Index>(end + 2 * i), &halves[2 * i]);
            });
            if (std::ranges::all_of(halves, [](const auto& half) { return half.empty(); })) break;
            for (std::size_t i = 0; i < halves.size(); ++i) {
                if (!halves[i].empty()) sets_[begin + i / 2].children[i % 2] = static_cast<Index>(end + i);
                sets_.emplace_back().rows = std::move(halves[i]);
            }
            begin = end;
        }
        Dissection result;
        add(0, result);
        return result;
    }

private:
    void part(Index set, Index first_child, std::vector<Index>* halves)
    {
        std::vector<Index>& rows = sets_[set].rows;
        const std::vector<Index> order = levels(rows, Marks(set));
        const auto [begin, end] = middle_level(order);
        if (8 * (end - begin) > order.size()) return;
        halves[1].assign(order.begin() + static_cast<std::ptrdiff_t>(end), order.end());
        const Index beyond = Marks(first_child + 1).own;
        for (const Index v : halves[1]) mark_[v] = beyond;
        rows.clear();
        for (std::size_t i = 0; i < end; ++i) {
            const Index v = order[i];
            const bool needed =
                i >= begin && std::any_of(graph_.begin(v), graph_.end(v), [&](Index w) { return mark_[w] == beyond; });
            (needed ? rows : halves[0]).push_back(v);
        }
        for (const Index v : rows) mark_[v] = in_separator;
        for (const Index v : halves[0]) mark_[v] = Marks(first_child).own;
        rows.shrink_to_fit();
        for (const int side : {0, 1}) std::sort(halves[side].begin(), halves[side].end());
    }

    /// Appends what can be reached of a set, by rising distance; the levels go on from what was there.
    void search(std::vector<Index>& order, Index start, Index from, Index to)
    {
        std::size_t head = order.size();
        level_[start] = order.empty() ? 0 : level_[order.back()] + 1;
        mark_[start] = to;
        order.push_back(start);
        for (; head < order.size(); ++head)
            for (const Index* w = graph_.begin(order[head]); w != graph_.end(order[head]); ++w)
                if (mark_[*w] == from) {
                    mark_[*w] = to;
                    level_[*w] = level_[order[head]] + 1;
                    order.push_back(*w);
                }
    }

    /// The rows by their distance from one that is far from another, component after component.
    std::vector<Index> levels(const std::vector<Index>& rows, const Marks& marks)
    {
        std::vector<Index> order;
        order.reserve(rows.size());
        for (const Index v : rows) {
            if (mark_[v] != marks.own) continue;
            const std::size_t first = order.size();
            search(order, v, marks.own, marks.there);
            const Index far = order.back();
            order.resize(first);
            search(order, far, marks.there, marks.back);
        }
        return order;
    }

    /// The least level between two and three fifths of the rows.
    std::pair<std::size_t, std::size_t> middle_level(const std::vector<Index>& order) const
    {
        const std::size_t from = 2 * order.size() / 5, until = 3 * order.size() / 5;
        std::pair<std::size_t, std::size_t> best{0, order.size()};
        for (std::size_t begin = 0; begin < until;) {
            std::size_t end = begin;
            while (end < order.size() && level_[order[end]] == level_[order[begin]]) ++end;
            if (begin > 0 && end > from && end < order.size() && end - begin < best.second - best.first)
                best = {begin, end};
            begin = end;
        }
        return best;
    }

    /// Appends a subtree in postorder. @return its root
    Index add(Index set, Dissection& result)
    {
        const bool is_piece = sets_[set].children[0] < 0;
        Index children[2]{-1, -1};
        if (!is_piece)
            for (const int side : {0, 1}) children[side] = add(sets_[set].children[side], result);
        const Index node = static_cast<Index>(result.nodes.size());
        result.nodes.push_back({std::move(sets_[set].rows), -1, is_piece});
        if (!is_piece)
            for (const Index child : children) result.nodes[child].parent = node;
        return node;
    }

    const RowGraph& graph_;
    std::vector<Index> mark_, level_;
    std::vector<PartedSet> sets_;
    Index most_rows_;
};

}  // namespace

Dissection dissect(const SparseMatrix& matrix, const std::vector<Index>& last, Index most_rows)
{
    const RowGraph graph(matrix);
    std::vector<Index> mark(graph.size(), Marks(0).own), rows;
    for (const Index v : last) mark[v] = left_out;
    rows.reserve(mark.size() - last.size());
    for (Index v = 0; v < graph.size(); ++v)
        if (mark[v] != left_out) rows.push_back(v);
    return Dissector(graph, std::move(mark), std::move(rows), most_rows).run();
}

}  // namespace koebe::detail
