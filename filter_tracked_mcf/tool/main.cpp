/// The command-line program: reads a mesh, lets it flow, writes it. `tracked_mcf --help` tells how.

#include <unistd.h>

#include <algorithm>
#include <csignal>
#include <iostream>
#include <memory>
#include <new>
#include <optional>

#include "filter_tracked_mcf/core/evolve.h"
#include "filter_tracked_mcf/tool/command_line.h"
#include "filter_tracked_mcf/tool/file_error.h"
#include "filter_tracked_mcf/tool/mesh_file.h"
#include "filter_tracked_mcf/tool/output_file.h"
#include "filter_tracked_mcf/tool/progress_bar.h"
#include "filter_tracked_mcf/tool/report_json.h"

namespace {

using namespace tracked_mcf;

enum ExitCode { Done = 0, BadMesh = 1, BadUsage = 2, Unwritable = 3 };

FlowReport evolve_with_progress(TriangleMesh& mesh, const Selection& selection,
                                const CommandLine& line) {
    if (line.quiet || !isatty(STDERR_FILENO)) return evolve(mesh, selection, line.parameters);
    ProgressBar bar(std::cerr);
    return evolve(mesh, selection, line.parameters,
                  [&bar](double fraction, std::string_view phase) {
                      bar.show(fraction, phase);
                      return true;
                  });
}

void complain(const std::string& message) {
    std::cerr << "tracked_mcf: " << message << '\n';
}

void run(const CommandLine& line) {
    validate(line.parameters);
    // What cannot be written in the end is said before the long work begins.
    OutputFile output(line.output);
    std::optional<OutputFile> report_file;
    if (!line.report.empty()) report_file.emplace(line.report);

    MeshFile file(line.input);
    TriangleMesh mesh = file.triangle_mesh();
    Selection selection;
    if (!line.selected.empty()) selection = file.selection_by(line.selected);
    const FlowReport report = evolve_with_progress(mesh, selection, line);

    file.write(mesh, output.stage(), output.folder());
    if (report_file) report_file->stage_text(report_json(line, report));
    output.commit();
    if (report_file) report_file->commit();
    if (!line.quiet) std::cout << summary(line, report) << std::flush;
    for (const std::string& shortcoming : warnings(line, report)) {
        complain("warning: " + shortcoming);
    }
}

int fail(ExitCode code, std::string message) {
    // Files are quoted, and what stands in a damaged one must not reach the terminal.
    const auto is_control = [](unsigned char c) { return c < ' ' || c == 127; };
    std::replace_if(message.begin(), message.end(), is_control, ' ');
    complain(message);
    return code;
}

}  // namespace

int main(int argc, char** argv) {
    // A full quota is then an error that can be told, rather than a silent end.
    std::signal(SIGXFSZ, SIG_IGN);
    try {
        const CommandLine line = parse_command_line(argc, argv);
        if (line.answer.empty())
            run(line);
        else
            std::cout << line.answer;
        return Done;
    } catch (const UsageError& error) {
        return fail(BadUsage, error.what());
    } catch (const InvalidParameter& error) {
        return fail(BadUsage, error.what());
    } catch (const UnwritableFile& error) {
        return fail(Unwritable, error.what());
    } catch (const UnreadableFile& error) {
        return fail(BadMesh, error.what());
    } catch (const Error& error) {
        return fail(BadMesh, error.what());
    } catch (const std::bad_alloc&) {
        return fail(BadMesh, "there is not enough memory; choose a smaller --depth or mesh.");
    } catch (const std::exception& error) {
        return fail(BadMesh, std::string("unexpected error: ") + error.what() + ".");
    }
}
