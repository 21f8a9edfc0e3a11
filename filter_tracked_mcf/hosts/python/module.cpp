// SPDX-License-Identifier: GPL-3.0-or-later
// The extension module of the Python package tracked_mcf.

#include <nanobind/nanobind.h>
#include <nanobind/ndarray.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/string_view.h>

#include <cstdint>
#include <cstring>
#include <string>
#include <variant>
#include <vector>

#include "filter_tracked_mcf/core/errors.h"
#include "filter_tracked_mcf/core/evolve.h"
#include "filter_tracked_mcf/core/parameter_table.h"
#include "filter_tracked_mcf/hosts/python/parameters.h"
#include "filter_tracked_mcf/presentation/fair_warnings.h"
#include "filter_tracked_mcf/presentation/filter_names.h"
#include "filter_tracked_mcf/presentation/flow_warnings.h"
#include "filter_tracked_mcf/presentation/noise_warnings.h"
#include "filter_tracked_mcf/presentation/report_table.h"
#include "filter_tracked_mcf/presentation/run.h"

namespace tracked_mcf {

namespace nb = nanobind;
using namespace nb::literals;

namespace {

nb::module_ numpy() {
    return nb::module_::import_("numpy");
}

/// Returns the array's shape and type in words, to say what is wrong with it.
std::string description(const char* name, const nb::object& array) {
    const nb::object shape = array.attr("shape"), type = array.attr("dtype");
    return std::string(name) + " has the shape " + nb::str(shape).c_str() + " and the type " +
           nb::str(type).c_str();
}

bool has_kind(nb::handle array, const char* kinds) {
    const auto kind = nb::cast<std::string>(array.attr("dtype").attr("kind"));
    return std::strchr(kinds, kind[0]) != nullptr;
}

/// Converts `given` to an array of shape (n, 3) whose dtype.kind is one of `kinds`. Throws
/// InvalidMesh, which says what is `wanted`.
nb::object three_columns(const char* name, nb::handle given, const char* kinds,
                         const char* wanted) {
    nb::object array = numpy().attr("asarray")(given);
    const nb::object shape = array.attr("shape");
    if (nb::len(shape) != 2 || nb::cast<std::int64_t>(shape[1]) != 3 || !has_kind(array, kinds))
        throw InvalidMesh(description(name, array) + "; give " + wanted + ".");
    return array;
}

/// Copies the rows of an array with three columns, whose memory may have any order.
template <class Number, class Row>
std::vector<Row> rows_of(nb::handle array, const char* type) {
    static_assert(sizeof(Row) == 3 * sizeof(Number));
    using Array = nb::ndarray<const Number, nb::shape<-1, 3>, nb::c_contig, nb::device::cpu>;
    const auto numbers = nb::cast<Array>(numpy().attr("ascontiguousarray")(array, type));
    std::vector<Row> rows(numbers.shape(0));
    if (!rows.empty()) std::memcpy(rows[0].data(), numbers.data(), rows.size() * sizeof(Row));
    return rows;
}

void check_indices(nb::handle faces, std::int64_t vertices) {
    if (nb::cast<std::int64_t>(faces.attr("size")) == 0) return;
    for (const char* extreme : {"min", "max"}) {
        const nb::object index = nb::int_(faces.attr(extreme)());
        if (index >= nb::int_(0) && index < nb::int_(vertices)) continue;
        throw InvalidMesh(std::string("faces refers to vertex ") + nb::str(index).c_str() +
                          ", which does not exist: vertices has " + std::to_string(vertices) +
                          " rows, counted from 0.");
    }
}

TriangleMesh mesh_of(nb::handle vertices, nb::handle faces) {
    const nb::object positions = three_columns(
        "vertices", vertices, "fiu", "an array of shape (n, 3) of real numbers, a row per vertex");
    const nb::object triangles = three_columns(
        "faces", faces, "iu",
        "an array of shape (m, 3) of integers, a triangle per row; split larger faces first");
    TriangleMesh mesh;
    mesh.positions = rows_of<double, Eigen::Vector3d>(positions, "float64");
    check_indices(triangles, static_cast<std::int64_t>(mesh.positions.size()));
    mesh.triangles = rows_of<std::int32_t, Triangle>(triangles, "int32");
    mesh.single_precision = positions.attr("dtype").equal(numpy().attr("float32"));
    return mesh;
}

/// What an argument with a number for each face or vertex must be.
struct ArrayKind {
    const char* kinds;   ///< the values of dtype.kind that are accepted, one letter each
    const char* type;    ///< to which the numbers are converted
    const char* wanted;  ///< in words
};

/// Copies the numbers of an input of `count` faces or vertices. Returns an empty vector for None.
template <class Number>
std::vector<Number> numbers_of(const nb::kwargs& arguments, const Input& input,
                               const ArrayKind& kind, std::size_t count) {
    const nb::object given = arguments[input.name.c_str()];
    if (given.is_none()) return {};
    const nb::object array = numpy().attr("asarray")(given);
    if (!has_kind(array, kind.kinds) || !array.attr("shape").equal(nb::make_tuple(count))) {
        throw InvalidParameter(description(input.name.c_str(), array) + "; give an array of " +
                               kind.wanted + ", one for each of the " + std::to_string(count) +
                               (input.of_faces ? " faces." : " vertices."));
    }
    const auto numbers = nb::cast<nb::ndarray<const Number, nb::ndim<1>, nb::c_contig>>(
        numpy().attr("ascontiguousarray")(array, kind.type));
    return {numbers.data(), numbers.data() + count};
}

template <class Parameters>
Inputs inputs_of(const nb::kwargs& arguments, const TriangleMesh& mesh) {
    Inputs inputs;
    for (const Input& input : input_table<Parameters>()) {
        if (input.of_faces) {
            inputs.*input.of_faces = numbers_of<std::uint8_t>(
                arguments, input, {"b", "uint8", "bools"}, mesh.triangles.size());
        } else {
            inputs.*input.of_vertices = numbers_of<double>(
                arguments, input, {"fiu", "float64", "real numbers"}, mesh.positions.size());
        }
    }
    return inputs;
}

/// Moves numbers into an array of this shape, without a copy.
template <class Number>
nb::object array_of(std::vector<Number>&& values, std::initializer_list<std::size_t> shape) {
    using Vector = std::vector<Number>;
    auto* const kept = new Vector(std::move(values));
    const nb::capsule owner(kept, [](void* held) noexcept { delete static_cast<Vector*>(held); });
    auto* const numbers = reinterpret_cast<double*>(kept->data());
    return nb::cast(nb::ndarray<nb::numpy, double>(numbers, shape, owner));
}

nb::object as_python(const ReportValue& value);

nb::object as_python(std::monostate) {
    return nb::none();
}

template <class Scalar>
nb::object as_python(const Scalar& scalar) {
    return nb::cast(scalar);
}

nb::object as_python(const ReportList& list) {
    nb::list values;
    for (const ReportValue& value : list) values.append(as_python(value));
    return values;
}

nb::object as_python(const ReportObject& object) {
    nb::dict values;
    for (const auto& [name, value] : object) values[name.c_str()] = as_python(value);
    return values;
}

nb::object as_python(const ReportValue& value) {
    return std::visit([](const auto& held) { return as_python(held); }, value.value);
}

/// Runs signal handlers, of which Ctrl-C's raises KeyboardInterrupt, then calls the user's
/// function.
Progress progress_by(const nb::object& callback) {
    return [&callback](double fraction, std::string_view phase) {
        const nb::gil_scoped_acquire acquired;
        if (PyErr_CheckSignals() != 0) throw nb::python_error();
        if (callback.is_none()) return true;
        const nb::object answer = callback(fraction, phase);
        return answer.is_none() || nb::cast<bool>(nb::bool_(answer));
    };
}

/// Moves positions into an array of float32 or float64.
nb::object vertices_of(std::vector<Eigen::Vector3d>&& positions, bool single_precision) {
    const std::size_t count = positions.size();
    const nb::object moved = array_of(std::move(positions), {count, 3});
    return single_precision ? moved.attr("astype")("float32") : moved;
}

StepObserver observer_by(const nb::object& on_step, bool single_precision) {
    if (on_step.is_none()) return {};
    return [&on_step, single_precision](int step, const std::vector<Eigen::Vector3d>& positions) {
        const nb::gil_scoped_acquire acquired;
        on_step(step, vertices_of(std::vector<Eigen::Vector3d>(positions), single_precision));
    };
}

/// Applies the filter of these parameters. Calls on_step, unless it is None, with the number and
/// the vertices of each step of a flow.
template <class Parameters>
nb::tuple filtered(nb::handle vertices, nb::handle faces, const nb::object& on_step,
                   const nb::object& progress, const nb::kwargs& given) {
    TriangleMesh mesh = mesh_of(vertices, faces);
    const Inputs inputs = inputs_of<Parameters>(given, mesh);
    const auto parameters = parameters_of<Parameters>(given, mesh);
    auto report = [&] {
        const nb::gil_scoped_release released;
        return run(mesh, inputs, parameters, progress_by(progress),
                   observer_by(on_step, mesh.single_precision));
    }();
    const std::vector<std::string> warnings = warnings_of(parameters, report);

    ReportObject given_inputs;
    for (const Input& input : input_table<Parameters>()) {
        given_inputs.emplace_back(input.name, ReportValue{!given[input.name.c_str()].is_none()});
    }
    nb::dict values;
    values["version"] = TRACKED_MCF_VERSION;
    values.update(
        nb::borrow<nb::dict>(as_python(report_values(parameters, given_inputs, report, warnings))));
    if (!report.quality.empty()) {
        const std::size_t count = report.quality.size();
        values["quality"] = array_of(std::move(report.quality), {count});
    }
    return nb::make_tuple(vertices_of(std::move(mesh.positions), mesh.single_precision), values);
}

double default_detail_size_of(nb::handle vertices, nb::handle faces, const nb::kwargs& given) {
    const TriangleMesh mesh = mesh_of(vertices, faces);
    return default_detail_size(mesh, inputs_of<FlowParameters>(given, mesh).selection);
}

/// Raises the error's class of the package, which Python code defines.
void translate(const std::exception_ptr& exception, void*) {
    const auto raise = [](const char* name, const Error& error) {
        PyErr_SetString(nb::module_::import_("tracked_mcf").attr(name).ptr(), error.what());
    };
    try {
        std::rethrow_exception(exception);
    } catch (const InvalidMesh& error) {
        raise("InvalidMesh", error);
    } catch (const InvalidParameter& error) {
        raise("InvalidParameter", error);
    } catch (const NotEnoughMemory& error) {
        raise("NotEnoughMemory", error);
    } catch (const Cancelled& error) {
        raise("Cancelled", error);
    } catch (const Error& error) {
        raise("Error", error);
    }
}

/// Returns the keys of a report, for the package's types.
template <class Report>
nb::list described_report() {
    nb::list keys;
    for (const ReportRow<Report>& row : report_table<Report>()) {
        nb::dict key;
        key["name"] = row.name;
        key["type"] = row.type;
        key["meaning"] = row.meaning;
        key["unit"] = unit_in_words(row.unit);
        keys.append(key);
    }
    return keys;
}

/// Adds the function of the filter to the module, and describes the filter under that name in
/// module.filters.
template <class Parameters, class Report>
void add_filter(nb::module_& module, const char* name) {
    module.def(name, filtered<Parameters>, "vertices"_a.none(), "faces"_a.none(),
               "on_step"_a = nb::none(), "progress"_a.none(), "parameters"_a);
    nb::dict filter;
    filter["method"] = kNames<Parameters>.python;
    filter["help"] = kNames<Parameters>.help;
    filter["parameters"] = described_parameters<Parameters>();
    filter["report"] = described_report<Report>();
    module.attr("filters")[name] = filter;
}

}  // namespace

}  // namespace tracked_mcf

NB_MODULE(_core, module) {
    using namespace tracked_mcf;
    module.attr("version") = TRACKED_MCF_VERSION;
    module.attr("no_quality") = kNoQuality;
    module.attr("filters") = nb::dict();
    module.attr("step_report") = described_report<StepReport>();
    nb::register_exception_translator(translate);
    add_filter<FairParameters, FairReport>(module, "fair");
    add_filter<NoiseParameters, NoiseReport>(module, "remove_noise");
    add_filter<FlowParameters, FlowReport>(module, "smooth");
    module.def("default_detail_size", default_detail_size_of, "vertices"_a.none(), "faces"_a.none(),
               "inputs"_a);
}
