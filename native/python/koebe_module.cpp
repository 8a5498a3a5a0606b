// The Python module. koebe/_arrays.py has checked all arrays, and each call copies them.
#include "bindings.h"
#include "error_translation.h"
#include "native_call.h"

#include "core/tolerances.h"

using namespace koebe::python;

PYBIND11_MODULE(_koebe, m)
{
    m.attr("__version__") = KOEBE_VERSION;
    m.attr("uv_resolution") = koebe::uv_resolution;
    m.attr("circle_tolerance") = koebe::circle_tolerance;

    translate_errors();
    watch_interpreter();

    bind_uniformize(m);
    bind_surface(m);
    bind_even_dial(m);
    bind_domains(m);
    bind_fit(m);
    bind_lift(m);
    bind_steps(m);
    bind_shapes(m);
}
