#include "report_object.h"

#include <cmath>
#include <string>

namespace py = pybind11;

namespace koebe::python {

py::object to_object(const nlohmann::ordered_json& report)
{
    using Type = nlohmann::ordered_json::value_t;
    switch (report.type()) {
    case Type::object: {
        py::dict dict;
        for (const auto& [key, value] : report.items()) dict[py::str(key)] = to_object(value);
        return dict;
    }
    case Type::array: {
        py::list list(report.size());
        for (std::size_t i = 0; i < report.size(); ++i) list[i] = to_object(report[i]);
        return list;
    }
    case Type::string: return py::str(report.get_ref<const std::string&>());
    case Type::boolean: return py::bool_(report.get<bool>());
    case Type::number_integer: return py::int_(report.get<std::int64_t>());
    case Type::number_unsigned: return py::int_(report.get<std::uint64_t>());
    case Type::number_float:
        if (const double number = report.get<double>(); std::isfinite(number)) return py::float_(number);
        return py::none();
    default: return py::none();
    }
}

}  // namespace koebe::python
