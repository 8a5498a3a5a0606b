// What the search for flipped faces' places has cost, and may cost.
#pragma once

#include <Eigen/Core>

#include <cstddef>
#include <unordered_set>

namespace koebe {

/// The unit is a face that a Newton step is taken for: so the search ends at the same place on every machine.
class RepairEffort {
public:
    /// As much as 30 steps of the whole surface cost; small ones get `small` besides, or 2,000 steps.
    /// @param faces of the surface
    explicit RepairEffort(Eigen::Index faces, std::size_t small = 100000);

    std::size_t most() const { return most_; }
    std::size_t spent() const { return spent_; }
    std::size_t left() const { return most_ - spent_; }
    /// What follows may bring what is spent to so much.
    void set_limit(std::size_t limit) { limit_ = limit; }

    /// Newton steps that may be taken for so many faces; 0 if they would be too few to lead anywhere.
    int affordable(Eigen::Index faces) const;
    bool exhausted() const { return affordable(0) == 0; }
    void spend(Eigen::Index faces, int steps);

    /// Whether a problem has failed before: it would again.
    bool has_failed(std::size_t problem) const { return failed_.contains(problem); }
    void note_failure(std::size_t problem) { failed_.insert(problem); }

private:
    std::size_t most_, limit_, spent_ = 0;
    std::unordered_set<std::size_t> failed_;
};

}  // namespace koebe
