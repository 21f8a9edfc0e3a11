// SPDX-License-Identifier: GPL-3.0-or-later
/// The command-line program: reads a mesh, runs a filter on it and writes it. `tracked_mcf --help`
/// explains it.

#include <algorithm>
#include <iostream>
#include <new>
#include <optional>
#include <type_traits>

#include "filter_tracked_mcf/core/parameter_table.h"
#include "filter_tracked_mcf/hosts/cli/command_line.h"
#include "filter_tracked_mcf/hosts/cli/documents/file_document.h"
#include "filter_tracked_mcf/hosts/cli/file_error.h"
#include "filter_tracked_mcf/hosts/cli/interrupts.h"
#include "filter_tracked_mcf/hosts/cli/mesh_file.h"
#include "filter_tracked_mcf/hosts/cli/output_file.h"
#include "filter_tracked_mcf/hosts/cli/progress_bar.h"
#include "filter_tracked_mcf/hosts/cli/report_json.h"
#include "filter_tracked_mcf/hosts/cli/step_files.h"
#include "filter_tracked_mcf/hosts/cli/system.h"
#include "filter_tracked_mcf/presentation/fair_warnings.h"
#include "filter_tracked_mcf/presentation/flow_warnings.h"
#include "filter_tracked_mcf/presentation/length.h"
#include "filter_tracked_mcf/presentation/noise_warnings.h"
#include "filter_tracked_mcf/presentation/run.h"
#include "filter_tracked_mcf/presentation/summary.h"

namespace {

using namespace tracked_mcf;

enum ExitCode {
    Done = 0,
    BadMesh = 1,
    BadUsage = 2,
    Unwritable = 3,
    TooLittleMemory = 4,
    Unexpected = 5
};

/// Shows a progress bar on a terminal. An interrupt cancels the filter and wipes the bar.
template <class Parameters>
auto run_with_progress(TriangleMesh& mesh, const Inputs& inputs,
                       const CommandLineOf<Parameters>& line, const StepObserver& on_step) {
    const InterruptHold hold;
    std::optional<ProgressBar> bar;
    if (!line.quiet && writes_to_terminal()) bar.emplace(std::cerr);
    return tracked_mcf::run(
        mesh, inputs, line.parameters,
        [&bar](double fraction, std::string_view phase) {
            if (bar) bar->show(fraction, phase);
            return !interrupted();
        },
        on_step);
}

/// Prints one line. Messages quote files, and control characters of a damaged file must not reach
/// the terminal.
void complain(std::string message) {
    const auto is_control = [](unsigned char c) { return c < ' ' || c == 127; };
    std::replace_if(message.begin(), message.end(), is_control, ' ');
    std::cerr << "tracked_mcf: " << message << '\n';
}

/// Sets the lengths, or those in units of the mesh if there is a mesh.
template <class Parameters>
void set_lengths(CommandLineOf<Parameters>& line, const TriangleMesh* mesh) {
    for (const auto& row : parameter_table<Parameters>()) {
        const auto length = line.lengths.find(row.name);
        if (length == line.lengths.end()) continue;
        row.set(line.parameters,
                mesh == nullptr ? length->second.value : in_mesh_units(length->second, *mesh));
    }
}

/// Throws InvalidParameter if OUTPUT is a mesh that INPUT, smoothed, cannot be a new version of: it
/// was probably meant as a second input, as in `tracked_mcf *.ply`.
void refuse_another_mesh(const std::filesystem::path& output, const MeshFile& input) {
    std::error_code ignored;
    if (!std::filesystem::is_regular_file(output, ignored)) return;
    std::optional<MeshFile> old;
    try {
        old.emplace(output);
    } catch (const UnreadableFile&) {
        return;
    }
    if (input.is_as_large_as(*old)) return;
    throw InvalidParameter(output.u8string() + " exists and is another mesh, of " + old->size() +
                           " where INPUT has " + input.size() +
                           "; give OUTPUT another name, or --overwrite.");
}

/// Reads the mesh, runs the filter, and writes what the command line asks for.
template <class Parameters>
void filter_file(CommandLineOf<Parameters> line) {
    set_lengths(line, nullptr);
    validate(line.parameters);
    // A file that cannot be written is reported before the long work begins.
    OutputFile output(line.output);
    std::optional<OutputFile> report_file;
    if (!line.report.empty()) report_file.emplace(line.report);

    MeshFile file(line.input);
    if (!line.overwrites) refuse_another_mesh(line.output, file);
    TriangleMesh mesh = file.triangle_mesh();
    if (line.doubles) file.write_doubles();
    mesh.single_precision = file.writes_floats(line.output);
    set_lengths(line, &mesh);
    Inputs inputs;
    for (const Input& input : input_table<Parameters>()) {
        const std::string& property = line.properties[input.name];
        if (property.empty()) continue;
        if (input.of_faces)
            inputs.*input.of_faces = file.selection_by(property);
        else
            inputs.*input.of_vertices = file.numbers_by(property);
    }
    StepFiles step_files(line.output, line.every);
    StepObserver on_step;
    if (line.every > 0) {
        on_step = [&](int step, const std::vector<Eigen::Vector3d>& positions) {
            step_files.write(step, [&](std::ostream& out) {
                file.write({positions, {}}, out, line.output);
            });
        };
    }
    const auto report = run_with_progress(mesh, inputs, line, on_step);
    if constexpr (std::is_same_v<Parameters, FlowParameters>)
        step_files.remove_after(static_cast<int>(report.steps.size()));

    file.set_quality(report.quality);
    output.write([&](std::ostream& out) { file.write(mesh, out, line.output); });
    std::vector<std::string> all_warnings = warnings_of(line.parameters, report);
    const std::string conversion = file.conversion_warning(line.output);
    if (!conversion.empty()) all_warnings.push_back(conversion);
    if (report_file) {
        report_file->write(
            [&](std::ostream& out) { out << report_json(line, report, all_warnings); });
    }
    if (interrupted()) return;  // the end of the last temporary file ends the program
    output.commit();
    if (report_file) report_file->commit();
    if (!line.quiet) {
        std::cout << summary(line.parameters, report) << '\n';
        if (line.verbose) std::cout << solver_details(line.parameters, report);
        std::cout << line.output.u8string() << " was written.\n" << std::flush;
    }
    for (const std::string& warning : all_warnings) complain("warning: " + warning);
}

/// Does what the arguments ask of the filter of these parameters.
template <class Parameters>
void answer_or_filter(std::vector<std::string> arguments) {
    const auto line = parse_command_line<Parameters>(std::move(arguments));
    if (line.answer.empty())
        filter_file(line);
    else
        std::cout << line.answer << std::flush;
}

/// Throws InvalidParameter if a word is nearly a command, and is no mesh file.
void refuse_misspelt_command(const std::string& word) {
    if (word.front() == '-' || format_of(std::filesystem::u8path(word)) != nullptr) return;
    std::vector<std::string> names;
    names.reserve(kCommands.size());
    for (const Command& command : kCommands) names.emplace_back(command.name);
    const std::string nearest = nearest_name(word, names);
    if (nearest.empty()) return;
    throw InvalidParameter("unknown command " + word + "; did you mean " + nearest + "?");
}

/// Does what the arguments ask.
void run_command(std::vector<std::string> arguments) {
    const std::string first = arguments.empty() ? "" : arguments.front();
    const auto* const command =
        std::find_if(kCommands.begin(), kCommands.end(),
                     [&](const Command& each) { return each.name == first; });
    if (command != kCommands.end()) {
        arguments.erase(arguments.begin());
    } else if (!first.empty()) {
        refuse_misspelt_command(first);
    }
    switch (command - kCommands.begin()) {
        case 1:
            return answer_or_filter<NoiseParameters>(std::move(arguments));
        case 2:
            return answer_or_filter<FairParameters>(std::move(arguments));
        default:
            return answer_or_filter<FlowParameters>(std::move(arguments));
    }
}

int fail(ExitCode code, std::string message) {
    complain(std::move(message));
    return code;
}

}  // namespace

int main(int argc, char** argv) {
    let_writes_fail_at_file_limits();
    handle_interrupts();
    try {
        run_command(utf8_arguments(argc, argv));
        if (!std::cout) {
            throw UnwritableFile("cannot write to the standard output; the disk may be full.");
        }
        return Done;
    } catch (const InvalidParameter& error) {
        return fail(BadUsage, error.name.empty() ? error.what()
                                                 : option_of(error.name) + ' ' + error.problem);
    } catch (const UnwritableFile& error) {
        return fail(Unwritable, error.what());
    } catch (const UnreadableFile& error) {
        return fail(BadMesh, error.what());
    } catch (const NotEnoughMemory& error) {
        return fail(TooLittleMemory, error.what());
    } catch (const Error& error) {
        return fail(BadMesh, error.what());
    } catch (const std::bad_alloc&) {
        // If a smaller depth can help, NotEnoughMemory has said so.
        return fail(TooLittleMemory,
                    "there is not enough memory; simplify the mesh, free memory, or raise the "
                    "memory limit of this process.");
    } catch (const std::exception& error) {
        return fail(Unexpected, std::string("unexpected error: ") + error.what() + ".");
    }
}
