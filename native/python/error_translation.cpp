#include "error_translation.h"

#include "native_call.h"

#include "core/error_description.h"

#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <exception>
#include <optional>

namespace py = pybind11;

namespace koebe::python {
namespace {

void raise(const ErrorDescription& error)
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

void translate(std::exception_ptr pointer)  // NOLINT(performance-unnecessary-value-param): pybind11 asks for this type
{
    try {
        if (pointer) std::rethrow_exception(pointer);
    } catch (const py::builtin_exception&) {
        throw;
    } catch (const py::error_already_set&) {
        throw;
    } catch (...) {
        std::optional<ErrorDescription> error = describe_error_of_library(pointer);
        if (!error) error = describe_error(pointer);  // thrown on this side
        if (!error) throw;
        in_python([&error] { raise(*error); });
    }
}

}  // namespace

void translate_errors() { py::register_local_exception_translator(&translate); }

}  // namespace koebe::python
