// The Python module. koebe/_arrays.py has checked all arrays, and each call copies them.
#include "bindings.h"
#include "error_translation.h"
#include "native_call.h"

#include "core/tolerances.h"

#include <pybind11/numpy.h>

using namespace koebe::python;

PYBIND11_MODULE(_koebe, m)
{
    m.attr("__version__") = KOEBE_VERSION;
    m.attr("uv_resolution") = koebe::uv_resolution;
    m.attr("circle_tolerance") = koebe::circle_tolerance;

    translate_errors();
    watch_interpreter();
    // The first array imports NumPy's functions. On a thread that would end the process if the interpreter ends
    // meanwhile.
    const pybind11::array_t<double> first(0);

    bind_uniformize(m);
    bind_shared(m);
    bind_domains(m);
    bind_steps(m);
#ifdef KOEBE_MAKING
    bind_lift(m);
    bind_flatten(m);
#endif
#ifdef KOEBE_LABS
    bind_shapes(m);
    bind_fit(m);
    bind_planar(m);
#endif
}
