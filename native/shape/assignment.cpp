#include "shape/assignment.h"

#include <limits>

namespace koebe {

std::vector<int> least_cost_assignment(const MatrixXd& cost)
{
    constexpr int nobody = -1;
    const int n = static_cast<int>(cost.rows());
    VectorXd row_price = VectorXd::Zero(n), column_price = VectorXd::Zero(n);
    std::vector<int> row_of(n, nobody);
    for (int first = 0; first < n; ++first) {
        // Dijkstra's algorithm on reduced costs, from this row to the nearest free column.
        VectorXd distance = VectorXd::Constant(n, std::numeric_limits<double>::infinity());
        std::vector<int> before(n, nobody);
        std::vector<char> done(n, 0);
        int row = first, column = nobody, last = nobody;
        double reached = 0.0;
        do {
            for (int j = 0; j < n; ++j) {
                const double way = reached + cost(row, j) - row_price[row] - column_price[j];
                if (!done[j] && way < distance[j]) {
                    distance[j] = way;
                    before[j] = last;
                }
            }
            column = nobody;
            for (int j = 0; j < n; ++j)
                if (!done[j] && (column == nobody || distance[j] < distance[column])) column = j;
            done[column] = 1;
            reached = distance[column];
            last = column;
            row = row_of[column];
        } while (row != nobody);

        row_price[first] += reached;
        for (int j = 0; j < n; ++j)
            if (done[j]) {
                column_price[j] += distance[j] - reached;
                if (row_of[j] != nobody) row_price[row_of[j]] += reached - distance[j];
            }
        for (int j = column; j != nobody; j = before[j]) row_of[j] = before[j] == nobody ? first : row_of[before[j]];
    }
    std::vector<int> assigned(n);
    for (int j = 0; j < n; ++j) assigned[row_of[j]] = j;
    return assigned;
}

}  // namespace koebe
