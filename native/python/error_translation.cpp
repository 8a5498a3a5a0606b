#include "error_translation.h"

#include "core/errors.h"

#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <exception>
#include <new>
#include <stdexcept>
#include <string>
#include <system_error>

namespace py = pybind11;

namespace koebe::python {
namespace {

void raise(const char* name, const std::string& message, const KoebeError* error = nullptr)
{
    const py::object type = py::module_::import("koebe.errors").attr(name);
    py::object instance = type(message);
    if (error) {
        instance.attr("elements") = py::cast(error->elements());
        instance.attr("of") = to_string(error->elements_of());
    }
    if (const auto* topology = dynamic_cast<const TopologyError*>(error))
        instance.attr("kind") = to_string(topology->kind());
    PyErr_SetObject(type.ptr(), instance.ptr());
}

void raise_memory_error() { PyErr_SetString(PyExc_MemoryError, "the mesh needs more memory than there is"); }

void translate(std::exception_ptr pointer)  // NOLINT(performance-unnecessary-value-param): pybind11 asks for this type
{
    try {
        if (pointer) std::rethrow_exception(pointer);
    } catch (const KoebeError& error) {
        raise(error.name(), error.what(), &error);
    } catch (const py::builtin_exception&) {
        throw;
    } catch (const py::error_already_set&) {
        throw;
    } catch (const std::bad_alloc&) {
        raise_memory_error();
    } catch (const std::length_error&) {  // a container beyond what can be addressed
        raise_memory_error();
    } catch (const std::system_error&) {  // no thread
        raise_memory_error();
    } catch (const std::exception& error) {
        raise("SolverError", std::string("internal error: ") + error.what());
    }
}

}  // namespace

void translate_errors() { py::register_local_exception_translator(&translate); }

}  // namespace koebe::python
