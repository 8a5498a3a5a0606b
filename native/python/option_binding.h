// Binds the struct of a map's options as a Python class.
#pragma once

#include "each_option.h"

#include <pybind11/pybind11.h>
#include <pybind11/stl.h>  // of options that need not be set

#include <type_traits>

namespace koebe::python {

/// Binds each option by its name: a choice as the number of its enumerator, which is its place in the table of options.
template <typename Options>
pybind11::class_<Options> bind_options(pybind11::module_& m, const char* name)
{
    pybind11::class_<Options> bound(m, name);
    bound.def(pybind11::init<>());
    each_option<Options>([&]<typename Field, typename Owner>(const char* option, Field Owner::*member) {
        if constexpr (std::is_enum_v<Field>)
            bound.def_property(
                option, [member](const Options& options) { return static_cast<int>(options.*member); },
                [member](Options& options, int number) { options.*member = static_cast<Field>(number); });
        else
            bound.def_readwrite(option, member);
    });
    return bound;
}

}  // namespace koebe::python
