// In place of GCC's header, whose attributes clang does not take: what is called of its OpenMP.
#pragma once

extern "C" {
int omp_get_max_active_levels() noexcept;
void omp_set_max_active_levels(int levels) noexcept;
}
