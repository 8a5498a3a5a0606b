#include "linear/factor/dissection.h"

#include "core/prefetch.h"
#include "execution/thread_share.h"

#include <algorithm>
#include <numeric>
#include <utility>

namespace koebe::detail {
namespace {

/// The neighbours of each row, without the row itself.
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
    const Index* begin_of(Index row) const { return begin_ + row; }
    const Index* begin(Index row) const { return neighbours_ + begin_[row]; }
    const Index* end(Index row) const { return neighbours_ + begin_[row + 1]; }

private:
    const Index* begin_;
    const Index* neighbours_;
    Index size_;
    std::vector<Index> own_begin_, own_neighbours_;
};

/// Marks of rows: each set has four marks, its own and three for the searches through it.
struct Marks {
    Index own, first, second, third;
    explicit Marks(Index set) : own(4 * set), first(4 * set + 1), second(4 * set + 2), third(4 * set + 3) {}
};
constexpr Index left_out = -1, in_separator = -2;

struct PartedSet {
    std::vector<Index> rows;    // rows of a separator once the set is cut
    Index children[2]{-1, -1};  // the two sets it is cut into, if any
    Index end = -1;             // a row far from the others
};

class Dissector {
public:
    Dissector(const RowGraph& graph, std::vector<Index> mark, std::vector<Index> rows, Index most_rows)
        : graph_(graph), mark_(std::move(mark)), distance_(graph.size()), between_(graph.size()), most_rows_(most_rows)
    {
        sets_.emplace_back().rows = std::move(rows);
    }

    Dissection run()
    {
        // Treat the sets of one depth side by side: no row of a set is a neighbour of a row of another.
        for (std::size_t begin = 0; begin < sets_.size();) {
            const std::size_t end = sets_.size();
            std::vector<std::vector<Index>> halves(2 * (end - begin));
            std::vector<Index> ends(halves.size(), -1);
            each_beside(end - begin, [&](std::size_t i) {
                if (static_cast<Index>(sets_[begin + i].rows.size()) > most_rows_)
                    part(static_cast<Index>(begin + i), static_cast<Index>(end + 2 * i), &halves[2 * i], &ends[2 * i]);
            });
            if (std::ranges::all_of(halves, [](const auto& half) { return half.empty(); })) break;
            for (std::size_t i = 0; i < halves.size(); ++i) {
                if (!halves[i].empty()) sets_[begin + i / 2].children[i % 2] = static_cast<Index>(end + i);
                sets_.push_back({std::move(halves[i]), {-1, -1}, ends[i]});
            }
            begin = end;
        }
        Dissection result;
        add(0, result);
        return result;
    }

private:
    /// A cut: rows whose number is below `below` on one side, and `size` of them next to the other side.
    struct Cut {
        const std::vector<Index>* number = nullptr;
        Index below = 0;
        std::size_t size = 0;
    };

    void part(Index set, Index first_child, std::vector<Index>* halves, Index* ends)
    {
        std::vector<Index>& rows = sets_[set].rows;
        measure(rows, sets_[set].end, Marks(set));
        const Index searched = Marks(set).third;
        Cut cuts[2];
        each_beside(2, [&](std::size_t i) { cuts[i] = least_cut(rows, i == 0 ? distance_ : between_, searched); });
        const Cut& cut = cuts[cuts[1].size < cuts[0].size ? 1 : 0];
        if (8 * cut.size > rows.size()) return;
        const std::vector<Index>& number = *cut.number;
        std::vector<Index> separator;
        for (const Index v : rows)
            (number[v] >= cut.below                                           ? halves[1]
             : highest_neighbour(v, number, searched, cut.below) >= cut.below ? separator
                                                                              : halves[0])
                .push_back(v);
        rows = std::move(separator);
        for (const Index v : rows) mark_[v] = in_separator;
        for (const int side : {0, 1}) {
            for (const Index v : halves[side]) mark_[v] = Marks(first_child + side).own;
            const auto [low, high] = std::ranges::minmax_element(halves[side], {}, [&](Index v) { return number[v]; });
            ends[side] = side == 0 ? *low : *high;
        }
    }

    /// Appends the rows of a set that can be reached, by rising distance, and writes the distances.
    void search(std::vector<Index>& order, Index start, Index from, Index to, std::vector<Index>& distance)
    {
        std::size_t head = order.size();
        distance[start] = 0;
        mark_[start] = to;
        order.push_back(start);
        for (; head < order.size(); ++head) {
            if (head + 2 * steps_ahead < order.size()) {
                prefetch(graph_.begin_of(order[head + 2 * steps_ahead]));
                prefetch(graph_.begin(order[head + steps_ahead]));
            }
            for (const Index* w = graph_.begin(order[head]); w != graph_.end(order[head]); ++w)
                if (mark_[*w] == from) {
                    mark_[*w] = to;
                    distance[*w] = distance[order[head]] + 1;
                    order.push_back(*w);
                }
        }
    }

    /// The distances from one end of each component, and d1 - d2, the difference of the distances from its two ends.
    /// The numbers of a component are above those of the component before.
    void measure(const std::vector<Index>& rows, Index known_end, const Marks& marks)
    {
        std::vector<Index> order;
        order.reserve(rows.size());
        Index base = 0;
        const auto measure_component = [&](Index end, Index mark) {
            order.clear();
            search(order, end, mark, marks.second, distance_);
            const Index other_end = order.back(), length = distance_[other_end];
            order.clear();
            search(order, other_end, marks.second, marks.third, between_);
            for (const Index w : order) {
                between_[w] = base + distance_[w] - between_[w] + length;
                distance_[w] += base;
            }
            base += 2 * length + 1;
        };
        if (known_end >= 0) measure_component(known_end, marks.own);
        for (const Index v : rows) {
            if (mark_[v] != marks.own) continue;
            order.clear();
            search(order, v, marks.own, marks.first, distance_);
            measure_component(order.back(), marks.first);
        }
    }

    Index highest_neighbour(Index row, const std::vector<Index>& number, Index mark, Index enough) const
    {
        Index highest = number[row];
        for (const Index* w = graph_.begin(row); w != graph_.end(row) && highest < enough; ++w)
            if (mark_[*w] == mark) highest = std::max(highest, number[*w]);
        return highest;
    }

    /// The cut with the fewest rows in its separator, among the cuts that leave two fifths on each side.
    Cut least_cut(const std::vector<Index>& rows, const std::vector<Index>& number, Index mark) const
    {
        Index most = 0;
        for (const Index v : rows) most = std::max(most, number[v]);
        // For each number: how many rows have it, and by how many the separator grows from the cut below the number
        // before.
        std::vector<Index> count(most + 2, 0), change(most + 2, 0);
        for (const Index v : rows) {
            ++count[number[v]];
            ++change[number[v] + 1];
            --change[highest_neighbour(v, number, mark, most) + 1];
        }
        Cut best{&number, 0, rows.size()};
        std::size_t under = 0, next_to = 0;
        for (Index below = 1; below <= most; ++below) {
            under += count[below - 1];
            next_to += change[below];
            if (5 * under >= 2 * rows.size() && 5 * under <= 3 * rows.size() && next_to < best.size)
                best = {&number, below, next_to};
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
    std::vector<Index> mark_, distance_, between_;
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
