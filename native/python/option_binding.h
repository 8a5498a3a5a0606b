// Binds the struct of a map's options as a Python class, and the enumerations of choices.
#pragma once

#include "each_option.h"

#include <pybind11/pybind11.h>
#include <pybind11/stl.h>  // of options that need not be set

#include <initializer_list>

namespace koebe::python {

/// Binds each option by its name.
template <typename Options>
pybind11::class_<Options> bind_options(pybind11::module_& m, const char* name)
{
    pybind11::class_<Options> bound(m, name);
    bound.def(pybind11::init<>());
    each_option<Options>([&](const char* option, auto member) { bound.def_readwrite(option, member); });
    return bound;
}

/// Binds an enumeration under the words that reports have.
template <typename Enum>
void bind_words(pybind11::module_& m, const char* name, std::initializer_list<Enum> values)
{
    pybind11::enum_<Enum> bound(m, name);
    for (const Enum value : values) bound.value(to_string(value), value);
}

}  // namespace koebe::python
