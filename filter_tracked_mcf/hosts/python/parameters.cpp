// SPDX-License-Identifier: GPL-3.0-or-later
#include "filter_tracked_mcf/hosts/python/parameters.h"

#include <nanobind/stl/string.h>

#include <algorithm>
#include <limits>
#include <string>
#include <variant>

#include "filter_tracked_mcf/core/errors.h"
#include "filter_tracked_mcf/core/parameter_table.h"
#include "filter_tracked_mcf/presentation/length.h"

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
    throw InvalidParameter(
        parameter.name,
        "is " + code_of(value) +
            "; give a number in units of the mesh, or a string such as '1%', in per "
            "cent of the diagonal of its bounding box.");
}

/// Returns a choice's name as a string of Python.
std::string literal(const NamedChoice& choice) {
    return code_of(nb::str(choice.name.c_str()));
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
    throw InvalidParameter(parameter.name,
                           "is " + given + "; give one of " + literals(parameter) + ".");
}

/// Returns the type as in the function's signature.
template <class Parameters>
std::string annotation(const ParameterOf<Parameters>& parameter) {
    switch (parameter.type) {
        case Parameter::Type::Switch:
            return "bool";
        case Parameter::Type::Integer:
            return "int";
        case Parameter::Type::Real:
            return "float";
        case Parameter::Type::Length:
            return "float | str";
        case Parameter::Type::Choice:
            break;
    }
    return "Literal[" + literals(parameter) + "]";
}

/// Returns the function's default.
template <class Parameters>
nb::object default_of(const ParameterOf<Parameters>& parameter) {
    const ParameterValue value = parameter.initial;
    if (parameter.type == Parameter::Type::Choice)
        return nb::str(
            parameter.choices.at(static_cast<std::size_t>(std::get<int>(value))).name.c_str());
    return std::visit([](auto held) { return nb::cast(held); }, value);
}

}  // namespace

template <class Parameters>
Parameters parameters_of(const nb::dict& given, const TriangleMesh& mesh) {
    Parameters parameters;
    for (const auto& parameter : parameter_table<Parameters>()) {
        const nb::object value = given[parameter.name.c_str()];
        if (value.is_none()) continue;
        const auto set = [&](const ParameterValue& taken) { parameter.set(parameters, taken); };
        switch (parameter.type) {
            case Parameter::Type::Switch:
                set(bool_of(parameter, value));
                break;
            case Parameter::Type::Integer:
                set(int_of(parameter, value));
                break;
            case Parameter::Type::Real:
                set(double_of(parameter, value));
                break;
            case Parameter::Type::Length: {
                const Length length = length_of(parameter, value);
                set(length.value);
                validate(parameters);  // now, while the message can show what the user typed
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

template <class Parameters>
nb::list described_parameters() {
    nb::list list;
    for (const auto& parameter : parameter_table<Parameters>()) {
        nb::list choices;
        for (const NamedChoice& choice : parameter.choices)
            choices.append(nb::make_tuple(choice.label, choice.name));
        nb::dict values;
        values["name"] = parameter.name;
        values["type"] = annotation(parameter);
        values["default"] = default_of(parameter);
        values["choices"] = choices;
        values["label"] = parameter.label;
        values["help"] = parameter.help;
        list.append(values);
    }
    for (const Input& input : input_table<Parameters>()) {
        nb::dict values;
        values["name"] = input.name;
        values["type"] = "ArrayLike | None";
        values["default"] = nb::none();
        values["choices"] = nb::list();
        values["label"] = input.label;
        values["of_faces"] = input.of_faces != nullptr;
        values["help"] = input.help;
        list.append(values);
    }
    return list;
}

template FlowParameters parameters_of(const nb::dict&, const TriangleMesh&);
template NoiseParameters parameters_of(const nb::dict&, const TriangleMesh&);
template FairParameters parameters_of(const nb::dict&, const TriangleMesh&);
template nb::list described_parameters<FlowParameters>();
template nb::list described_parameters<NoiseParameters>();
template nb::list described_parameters<FairParameters>();

}  // namespace tracked_mcf
