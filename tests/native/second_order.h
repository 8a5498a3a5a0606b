// Maps of finer and finer round annuli, whose error falls with the square of the edges.
#pragma once

#include "circle_domain.h"

#include <gtest/gtest.h>

#include <cmath>

namespace koebe::test {

/// @param error_of of the map of an annulus, 0.3 inside @param most error of the finest one
template <class ErrorOf>
void expect_second_order(double most, const ErrorOf& error_of)
{
    double last = 0.0;
    for (const Index sectors : {32, 64, 128}) {
        const double error = error_of(make_round_annulus(0.3, sectors, sectors / 5));
        if (last > 0.0) {
            EXPECT_GT(std::log2(last / error), 1.85) << error;
        }
        last = error;
    }
    EXPECT_LT(last, most);
}

}  // namespace koebe::test
