// SPDX-License-Identifier: GPL-3.0-or-later
#include "filter_tracked_mcf/python/parameters.h"

#include <nanobind/stl/string.h>

#include <algorithm>
#include <limits>
#include <regex>
#include <variant>
#include <vector>

#include "filter_tracked_mcf/core/errors.h"
#include "filter_tracked_mcf/core/parameter_table.h"
#include "filter_tracked_mcf/parameters/length.h"

namespace tracked_mcf {

namespace nb = nanobind;

namespace {

/// Returns the value as Python code would write it.
std::string code_of(nb::handle value) {
    return nb::repr(value).c_str();
}

[[noreturn]] void refuse_type(const Parameter& parameter, nb::handle value, const char* wanted) {
    PyErr_Clear();
    throw nb::type_error(
        (parameter.name + " is " + code_of(value) + "; give " + wanted + ".").c_str());
}

bool bool_of(const Parameter& parameter, nb::handle value) {
    if (value.is(Py_True) || value.is(Py_False)) return value.is(Py_True);
    if (!nb::isinstance(value, nb::module_::import_("numpy").attr("bool_")))
        refuse_type(parameter, value, "True or False");
    return nb::cast<bool>(nb::bool_(value));
}

int int_of(const Parameter& parameter, nb::handle value) {
    const nb::object number = nb::steal(PyNumber_Index(value.ptr()));
    if (!number.is_valid()) refuse_type(parameter, value, "an integer");
    int overflow = 0;
    const long long exact = PyLong_AsLongLongAndOverflow(number.ptr(), &overflow);
    using Limits = std::numeric_limits<int>;
    if (overflow != 0) return overflow > 0 ? Limits::max() : Limits::min();
    return static_cast<int>(std::clamp<long long>(exact, Limits::min(), Limits::max()));
}

double double_of(const Parameter& parameter, nb::handle value, const char* wanted = "a number") {
    const double number = PyFloat_AsDouble(value.ptr());
    if (PyErr_Occurred() != nullptr) refuse_type(parameter, value, wanted);
    return number;
}

Length length_of(const Parameter& parameter, nb::handle value) {
    if (!nb::isinstance<nb::str>(value)) {
        return {double_of(parameter, value, "a number, or a string such as '1%'"), false};
    }
    std::string text = nb::cast<std::string>(value);
    if (!text.empty() && text.back() == '%') {
        text.pop_back();
        const nb::object number = nb::steal(PyFloat_FromString(nb::str(text.c_str()).ptr()));
        if (number.is_valid()) return {PyFloat_AsDouble(number.ptr()), true};
        PyErr_Clear();
    }
    throw InvalidParameter(parameter.name + " is " + code_of(value) +
                           "; give a number in units of the mesh, or a string such as '1%', in per "
                           "cent of the diagonal of its bounding box.");
}

bool is_number(const std::string& name) {
    return std::all_of(name.begin(), name.end(),
                       [](char letter) { return letter >= '0' && letter <= '9'; });
}

/// Returns the name of a choice as Python's code.
std::string literal(const NamedChoice& choice) {
    return is_number(choice.name) ? choice.name : "'" + choice.name + "'";
}

std::string literals(const Parameter& parameter) {
    std::string text;
    for (const NamedChoice& choice : parameter.choices) {
        text += (text.empty() ? "" : ", ") + literal(choice);
    }
    return text;
}

int choice_of(const Parameter& parameter, nb::handle value) {
    const std::string given = code_of(value);
    for (std::size_t i = 0; i < parameter.choices.size(); ++i) {
        if (literal(parameter.choices[i]) == given) return static_cast<int>(i);
    }
    throw InvalidParameter(parameter.name + " is " + given + "; give one of " +
                           literals(parameter) + ".");
}

const Parameter& parameter_of(const std::string& name) {
    std::string names;
    for (const Parameter& parameter : parameter_table()) {
        if (parameter.name == name) return parameter;
        names += (names.empty() ? "" : ", ") + parameter.name;
    }
    throw nb::type_error(
        ("There is no parameter '" + name + "'; the parameters are " + names + ".").c_str());
}

/// Returns the type and the default as Python's code.
std::string python_type(const Parameter& parameter) {
    const ParameterValue value = parameter.get({});
    const auto as_python = [](auto held) { return code_of(nb::cast(held)); };
    switch (parameter.type) {
        case Parameter::Type::Switch:
            return "bool = " + std::visit(as_python, value);
        case Parameter::Type::Selected:
        case Parameter::Type::Strength:
            return "numpy.typing.ArrayLike | None = None";
        case Parameter::Type::Integer:
            return "int = " + std::visit(as_python, value);
        case Parameter::Type::Real:
            return "float = " + std::visit(as_python, value);
        case Parameter::Type::Length:
            return "float | str = " + std::visit(as_python, value);
        case Parameter::Type::Choice:
            break;
    }
    return "typing.Literal[" + literals(parameter) +
           "] = " + literal(parameter.choices.at(static_cast<std::size_t>(std::get<int>(value))));
}

/// Returns the kinds of values that PyMeshLab and smooth() write in different ways as a word.
const char* type_name(Parameter::Type type) {
    if (type == Parameter::Type::Real) return "real";
    if (type == Parameter::Type::Length) return "length";
    return type == Parameter::Type::Choice ? "choice" : "other";
}

}  // namespace

FlowParameters flow_parameters(const nb::kwargs& given, const TriangleMesh& mesh) {
    FlowParameters parameters;
    for (const auto [key, value] : given) {
        const Parameter& parameter = parameter_of(nb::cast<std::string>(key));
        const auto set = [&](const ParameterValue& taken) { parameter.set(parameters, taken); };
        switch (parameter.type) {
            case Parameter::Type::Switch:
                set(bool_of(parameter, value));
                break;
            case Parameter::Type::Selected:
            case Parameter::Type::Strength:
                break;  // an argument of its own
            case Parameter::Type::Integer:
                set(int_of(parameter, value));
                break;
            case Parameter::Type::Real:
                set(double_of(parameter, value));
                break;
            case Parameter::Type::Length: {
                const Length length = length_of(parameter, value);
                set(length.value);
                validate(parameters);  // before a negative percentage becomes another number
                set(in_mesh_units(length, mesh));
                break;
            }
            case Parameter::Type::Choice:
                set(choice_of(parameter, value));
        }
    }
    validate(parameters);
    return parameters;
}

std::string signature_of_smooth() {
    std::string text =
        "def smooth(vertices: numpy.typing.ArrayLike, faces: numpy.typing.ArrayLike, *, ";
    for (const Parameter& parameter : parameter_table()) {
        text += parameter.name + ": " + python_type(parameter) + ", ";
    }
    return text +
           "progress: collections.abc.Callable[[float, str], object] | None = None) -> "
           "tuple[numpy.typing.NDArray[typing.Any], dict[str, typing.Any]]";
}

std::string help_of_parameters() {
    static const std::regex modules("(numpy\\.)?typing\\.");  // which help need not name
    std::string text;
    for (const Parameter& parameter : parameter_table()) {
        const std::string type = std::regex_replace(python_type(parameter), modules, "");
        text += "    " + parameter.name + ": " + type + "\n        ";
        if (parameter.type == Parameter::Type::Selected)
            text += "An array of shape (m,) of bools: only these faces move. ";
        if (parameter.type == Parameter::Type::Strength) text += "An array of shape (n,). ";
        if (parameter.type == Parameter::Type::Length)
            text += "In units of the mesh, or as '1%' of its bounding box's diagonal. ";
        text += parameter.help + "\n";
    }
    return text;
}

nb::list pymeshlab_parameters() {
    nb::list list;
    for (const Parameter& parameter : parameter_table()) {
        if (parameter.label.empty()) continue;
        nb::dict values, choices;
        for (const NamedChoice& choice : parameter.choices)
            choices[choice.label.c_str()] = choice.name;
        values["name"] = parameter.name;
        values["type"] = type_name(parameter.type);
        values["choices"] = choices;
        list.append(values);
    }
    return list;
}

}  // namespace tracked_mcf
