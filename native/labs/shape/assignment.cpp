#include "shape/assignment.h"

#include "core/sort_unique.h"

#define LEMON_ONLY_TEMPLATES  // header-only
#include <lemon/network_simplex.h>
#include <lemon/smart_graph.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <numeric>
#include <stdexcept>

namespace koebe {
namespace {

using Price = std::int64_t;
using Prices = Eigen::Matrix<Price, Eigen::Dynamic, Eigen::Dynamic>;
using Graph = lemon::SmartDigraph;

constexpr int few = 16;         // pairs of each row and column at the start
constexpr int price_bits = 54;  // of a sum of n costs, so that no sum in the simplex method overflows

/// The costs as whole numbers, with the least cost 0.
Prices whole_costs(const MatrixXd& cost)
{
    const double least = cost.minCoeff(), range = cost.maxCoeff() - least;
    const int bits = std::min(40, price_bits - static_cast<int>(std::bit_width(static_cast<std::size_t>(cost.rows()))));
    const double scale = range > 0.0 ? std::ldexp(1.0, bits) / range : 0.0;
    return ((cost.array() - least) * scale).round().cast<Price>();
}

/// Marks the cheapest few rows of each column.
void mark_cheap(const Prices& cost, std::vector<std::vector<int>>& rows_of)
{
    const int n = static_cast<int>(cost.rows()), count = std::min(few, n);
    std::vector<int> rows(n);
    for (int j = 0; j < n; ++j) {
        std::iota(rows.begin(), rows.end(), 0);
        const Price* column = cost.col(j).data();
        std::nth_element(rows.begin(), rows.begin() + count - 1, rows.end(),
                         [column](int a, int b) { return column[a] < column[b]; });
        rows_of[j].assign(rows.begin(), rows.begin() + count);
    }
}

/// For each column the rows it may go with at first: a few, among them a full assignment.
std::vector<std::vector<int>> first_pairs(const Prices& cost)
{
    const int n = static_cast<int>(cost.rows());
    std::vector<std::vector<int>> rows_of(n), columns_of(n);
    mark_cheap(cost, rows_of);
    mark_cheap(cost.transpose(), columns_of);
    for (int i = 0; i < n; ++i)
        for (const int j : columns_of[i]) rows_of[j].push_back(i);
    for (int j = 0; j < n; ++j) {
        rows_of[j].push_back(j);
        sort_unique(rows_of[j]);
    }
    return rows_of;
}

/// The best permutation over some of the pairs, and the prices that prove it: no cost is below its column's price minus
/// its row's.
struct Solution {
    std::vector<int> column;
    Eigen::Matrix<Price, Eigen::Dynamic, 1> row_price, column_price;
};

Solution solve(const Prices& cost, const std::vector<std::vector<int>>& rows_of)
{
    const int n = static_cast<int>(cost.rows());
    Graph graph;
    graph.reserveNode(2 * n);
    for (int i = 0; i < 2 * n; ++i) graph.addNode();  // rows, then columns
    const auto row = [&graph](int i) { return graph.nodeFromId(i); };
    const auto column = [&graph, n](int j) { return graph.nodeFromId(n + j); };
    for (int j = 0; j < n; ++j)
        for (const int i : rows_of[j]) graph.addArc(row(i), column(j));
    Graph::ArcMap<Price> price(graph);
    for (Graph::ArcIt arc(graph); arc != lemon::INVALID; ++arc)
        price[arc] = cost(graph.id(graph.source(arc)), graph.id(graph.target(arc)) - n);
    Graph::NodeMap<Price> supply(graph);
    for (int i = 0; i < n; ++i) {
        supply[row(i)] = 1;
        supply[column(i)] = -1;
    }

    lemon::NetworkSimplex<Graph, Price, Price> simplex(graph);
    if (simplex.costMap(price).supplyMap(supply).run() != simplex.OPTIMAL)
        throw std::logic_error("the assignment problem has no solution");  // cannot happen: row j may go with column j
    Solution solution{std::vector<int>(n), {}, {}};
    solution.row_price.resize(n);
    solution.column_price.resize(n);
    for (Graph::ArcIt arc(graph); arc != lemon::INVALID; ++arc)
        if (simplex.flow(arc) > 0) solution.column[graph.id(graph.source(arc))] = graph.id(graph.target(arc)) - n;
    for (int i = 0; i < n; ++i) {
        solution.row_price[i] = simplex.potential(row(i));
        solution.column_price[i] = simplex.potential(column(i));
    }
    return solution;
}

/// Adds the pairs that could lower the sum. Returns false if there are none.
bool add_cheaper(const Prices& cost, const Solution& solution, std::vector<std::vector<int>>& rows_of)
{
    const int n = static_cast<int>(cost.rows());
    bool added = false;
    for (int j = 0; j < n; ++j)
        for (int i = 0; i < n; ++i)
            if (cost(i, j) + solution.row_price[i] < solution.column_price[j]) {
                rows_of[j].push_back(i);
                added = true;
            }
    return added;
}

}  // namespace

std::vector<int> least_cost_assignment(const MatrixXd& cost, const ExecutionContext& context)
{
    if (cost.rows() == 0) return {};
    const Prices whole = whole_costs(cost);
    std::vector<std::vector<int>> rows_of = first_pairs(whole);
    for (;;) {
        context.checkpoint();
        Solution solution = solve(whole, rows_of);
        if (!add_cheaper(whole, solution, rows_of)) return std::move(solution.column);
    }
}

}  // namespace koebe
