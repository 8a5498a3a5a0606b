// Precompiled header of all sources of the library: Eigen takes half of the compile time of most of them.
#pragma once

#include "core/types.h"

#include <Eigen/Dense>

#include <algorithm>
#include <cmath>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>
