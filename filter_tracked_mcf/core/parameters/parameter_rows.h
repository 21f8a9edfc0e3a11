// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <type_traits>
#include <utility>
#include <variant>
#include <vector>

#include "filter_tracked_mcf/core/parameter_table.h"

/// What the tables of parameters are written with.
namespace tracked_mcf::parameter_rows {

template <class Member>
struct ClassOf;
template <class Value, class Class>
struct ClassOf<Value Class::*> {
    using Type = Class;
};

/// The class of which `member` is a member.
template <auto member>
using Owner = typename ClassOf<decltype(member)>::Type;

/// A row without its texts, for a member that is a bool, a number or an enumeration. `P` has the
/// member, or inherits it.
template <auto member, class P = Owner<member>>
ParameterOf<P> access(Parameter::Type type, Range range) {
    using Value = std::decay_t<decltype(std::declval<P>().*member)>;
    using Stored = std::conditional_t<std::is_enum_v<Value>, int, Value>;
    ParameterOf<P> row;
    row.type = type;
    row.range = std::move(range);
    row.get = [](const P& p) -> ParameterValue { return static_cast<Stored>(p.*member); };
    row.set = [](P& p, const ParameterValue& value) {
        p.*member = static_cast<Value>(std::get<Stored>(value));
    };
    return row;
}

template <auto member>
ParameterOf<Owner<member>> toggle() {
    return access<member>(Parameter::Type::Switch, {0, 1, ""});
}

template <auto member, class P = Owner<member>>
ParameterOf<P> integer(int smallest, int largest, const char* advice = "") {
    return access<member, P>(Parameter::Type::Integer, {double(smallest), double(largest), advice});
}

/// An enumeration, whose enumerators count from 0.
template <auto member, class P = Owner<member>>
ParameterOf<P> choice(std::vector<NamedChoice> choices) {
    Range range = {0, static_cast<double>(choices.size() - 1), ":"};
    for (const auto& [label, name] : choices) {
        range.advice += ' ' + (label.empty() ? name : label) + ',';
    }
    range.advice.pop_back();
    ParameterOf<P> row = access<member, P>(Parameter::Type::Choice, range);
    row.choices = std::move(choices);
    return row;
}

/// Completes a row.
template <class P>
ParameterOf<P> named(ParameterOf<P> row, std::string name, std::string label, std::string help) {
    row.name = std::move(name);
    row.label = std::move(label);
    row.help = std::move(help);
    row.initial = row.get(P());
    return row;
}

inline constexpr int kMaximumThreads = 1024;

inline constexpr const char* kThreadsHelp =
    "Threads, up to 1024; 0 takes OMP_NUM_THREADS or, unless that is set, one for each processor "
    "that the program may use. The result does not depend on it; only processors with other vector "
    "instructions round differently.";

/// The row of the number of threads, for the program alone.
template <auto member>
ParameterOf<Owner<member>> threads() {
    return named(integer<member>(0, kMaximumThreads, ", where 0 takes one for each processor"),
                 "threads", "", kThreadsHelp);
}

/// The row of a quality that is none or the displacement.
template <auto member>
ParameterOf<Owner<member>> displacement() {
    return named(choice<member>({{"Unchanged", "none"}, {"Displacement", "displacement"}}),
                 "quality", "Vertex quality",
                 "For colours: how far the vertex moved along its normal.");
}

/// A row of the table of inputs, without its member.
inline Input input(std::string name, std::string label, std::string help) {
    Input row;
    row.type = Parameter::Type::Switch;
    row.range = {0, 1, ""};
    row.name = std::move(name);
    row.label = std::move(label);
    row.help = std::move(help);
    row.initial = false;
    return row;
}

/// The row of Inputs::selection.
inline Input selected(std::string help) {
    Input row = input("selected", "Affect only selected faces", std::move(help));
    row.of_faces = &Inputs::selection;
    return row;
}

/// The row of Inputs::strength.
inline Input strength(std::string help) {
    Input row = input("strength", "Strength from vertex quality", std::move(help));
    row.of_vertices = &Inputs::strength;
    return row;
}

}  // namespace tracked_mcf::parameter_rows
