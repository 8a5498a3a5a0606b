// The Python module. koebe/_arrays.py has checked all arrays, and each call copies them.
#include "bindings.h"
#include "native_call.h"

#include "core/error_description.h"
#include "core/uv_resolution.h"

#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <exception>
#include <optional>

using namespace koebe::python;
namespace py = pybind11;

namespace {

void raise(const koebe::ErrorDescription& error)
{
    if (error.name == "MemoryError") {
        PyErr_SetString(PyExc_MemoryError, error.message.c_str());
        return;
    }
    const py::object type = py::module_::import("koebe.errors").attr(error.name.c_str());
    py::object instance = type(error.message);
    if (error.is_koebe_error) {
        instance.attr("elements") = py::cast(error.elements);
        instance.attr("of") = error.elements_of;
    }
    if (error.topology_kind) instance.attr("kind") = error.topology_kind;
    PyErr_SetObject(type.ptr(), instance.ptr());
}

/// A KoebeError becomes the class of the same name in koebe.errors, with .elements and, for TopologyError, .kind.
/// Missing memory or a missing thread becomes MemoryError; any other exception becomes SolverError.
void translate(std::exception_ptr pointer)  // NOLINT(performance-unnecessary-value-param): pybind11 asks for this type
{
    try {
        if (pointer) std::rethrow_exception(pointer);
    } catch (const py::builtin_exception&) {
        throw;
    } catch (const py::error_already_set&) {
        throw;
    } catch (...) {
        std::optional<koebe::ErrorDescription> error = koebe::describe_error_of_library(pointer);
        if (!error) error = koebe::describe_error(pointer);  // thrown on this side
        if (!error) throw;
        in_python([&error] { raise(*error); });
    }
}

}  // namespace

PYBIND11_MODULE(_koebe, m)
{
    m.attr("__version__") = KOEBE_VERSION;
    m.attr("uv_resolution") = koebe::uv_resolution;
    m.attr("circle_tolerance") = koebe::circle_tolerance;

    py::register_local_exception_translator(&translate);
    watch_interpreter();
    // The first array imports NumPy's functions. On a thread that would end the process if the interpreter ends
    // meanwhile.
    const py::array_t<double> first(0);

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
