// SPDX-License-Identifier: GPL-3.0-or-later
#include "filter_tracked_mcf/hosts/cli/report_json.h"

#include <nlohmann/json.hpp>
#include <variant>

#include "filter_tracked_mcf/core/parameter_table.h"
#include "filter_tracked_mcf/presentation/report_table.h"

namespace tracked_mcf {

namespace {

using Json = nlohmann::ordered_json;

Json as_json(const ReportValue& value);

Json as_json(std::monostate) {
    return {};
}

template <class Scalar>
Json as_json(const Scalar& scalar) {
    return scalar;
}

Json as_json(const ReportList& list) {
    Json json = Json::array();
    for (const ReportValue& value : list) json.push_back(as_json(value));
    return json;
}

Json as_json(const ReportObject& object) {
    Json json = Json::object();
    for (const auto& [name, value] : object) json[name] = as_json(value);
    return json;
}

Json as_json(const ReportValue& value) {
    return std::visit([](const auto& held) { return as_json(held); }, value.value);
}

template <class Parameters, class Report>
std::string json_of(const CommandLineOf<Parameters>& line, const Report& report,
                    const std::vector<std::string>& warnings) {
    ReportObject inputs;
    for (const Input& input : input_table<Parameters>()) {
        const auto property = line.properties.find(input.name);
        const bool is_given = property != line.properties.end() && !property->second.empty();
        inputs.emplace_back(input.name, is_given ? ReportValue{property->second} : ReportValue());
    }
    Json json = {{"program", "tracked_mcf"},
                 {"version", TRACKED_MCF_VERSION},
                 {"input", line.input.u8string()},
                 {"output", line.output.u8string()}};
    json.update(as_json(report_values(line.parameters, inputs, report, warnings)));
    // JSON must be UTF-8; file names need not be.
    return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace

std::string report_json(const CommandLineOf<FlowParameters>& line, const FlowReport& report,
                        const std::vector<std::string>& warnings) {
    return json_of(line, report, warnings);
}

std::string report_json(const CommandLineOf<NoiseParameters>& line, const NoiseReport& report,
                        const std::vector<std::string>& warnings) {
    return json_of(line, report, warnings);
}

std::string report_json(const CommandLineOf<FairParameters>& line, const FairReport& report,
                        const std::vector<std::string>& warnings) {
    return json_of(line, report, warnings);
}

}  // namespace tracked_mcf
