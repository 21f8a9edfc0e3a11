// SPDX-License-Identifier: GPL-3.0-or-later
#include "filter_tracked_mcf/tool/command_line.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <sstream>

#include "filter_tracked_mcf/core/errors.h"
#include "filter_tracked_mcf/parameters/parameter_table.h"
#include "filter_tracked_mcf/tool/documents/file_document.h"
#include "filter_tracked_mcf/tool/output_file.h"

namespace tracked_mcf {

namespace fs = std::filesystem;

namespace {

const Choices<bool> kSwitches = {{"on", true}, {"off", false}};

constexpr std::size_t kNameColumns = 26, kTextColumns = 70;

const char* const kDescription =
    "Smooths a triangle mesh by mean-curvature flow: every point moves along the normal with the "
    "speed of the mean curvature, so that noise and small detail vanish first and large shapes "
    "last. Closed surfaces shrink, thin parts pinch, and sharp features are smoothed like noise.";

const char* const kExamples =
    "Examples:\n"
    "  tracked_mcf scan.ply smooth.ply\n"
    "      the defaults: removes the finest noise\n"
    "  tracked_mcf scan.ply smooth.ply --detail-size 0.5% --order 2\n"
    "      removes detail smaller than 0.5 % of the model's diagonal and keeps larger shapes\n"
    "  tracked_mcf face.obj face_smooth.obj --depth 8 --boundary free\n"
    "      resolves finer detail, and lets the rim move\n"
    "  tracked_mcf scan.ply smooth.ply --preserve volume\n"
    "      smooths a scan without shrinking it\n"
    "  tracked_mcf scan.ply smooth.ply --selected flags\n"
    "      smooths only the faces that were selected in MeshLab and saved with their flags\n"
    "  tracked_mcf scan.ply smooth.stl --quiet --report smooth.json\n"
    "      in a script: converts, prints no summary, and writes a report\n"
    "\n"
    "Files: PLY, OBJ, OFF and STL, by extension; PLY and STL are written as binary. If OUTPUT has\n"
    "the format of INPUT, only positions and normals change. Another format gets the positions,\n"
    "the faces and the colours of the vertices (STL: triangles without colours), and a warning\n"
    "names everything that is left out. INPUT and OUTPUT may be the same file: it is replaced\n"
    "only after everything has succeeded.\n"
    "\n"
    "Exit codes: 0 done; 1 the mesh cannot be read or smoothed; 2 wrong use of options; 3 a\n"
    "result cannot be written. An interrupt ends the program by its signal, which a shell shows\n"
    "as 129, 130 or 143. An error is one line on the error output. So is a warning, also with\n"
    "--quiet: the flow stopped before its last step, the solver stopped before its tolerance, or\n"
    "OUTPUT does not keep everything of INPUT. Warnings leave the exit code 0.\n"
    "\n"
    "The method is that of M. Chuang and M. Kazhdan, Fast Mean-Curvature Flow via\n"
    "Finite-Elements Tracking, 2011.\n";

std::string wrapped(const std::string& text, std::size_t columns) {
    std::istringstream words(text);
    std::string result, word;
    std::size_t column = 0;
    while (words >> word) {
        if (column > 0 && column + 1 + word.size() > columns) {
            result += '\n';
            column = 0;
        }
        if (column > 0) result += ' ';
        column += (column > 0 ? 1 : 0) + word.size();
        result += word;
    }
    return result;
}

std::string help_of(const std::string& text) {
    return wrapped(text, kTextColumns);
}

std::string tooltip_of(const std::string& name) {
    const auto& table = parameter_table();
    const auto found = std::find_if(table.begin(), table.end(),
                                    [&](const auto& entry) { return entry.name == name; });
    return found == table.end() ? std::string() : found->tooltip;
}

/// Returns the help of a parameter that the plugin has as well, in the plugin's words.
std::string shared_help(const std::string& name) {
    return help_of(tooltip_of(name));
}

/// Adds an option that takes the name of one of the choices, and returns it.
template <class Value>
CLI::Option* add_choice(CLI::App& app, const char* option, Value& value,
                        const Choices<Value>& choices, const std::string& help) {
    std::vector<std::string> names;
    std::string alternatives;
    for (const auto& [name, meaning] : choices) {
        names.push_back(name);
        alternatives += (alternatives.empty() ? "" : "|") + name;
    }
    const auto take = [&value, &choices](const std::string& taken) {
        for (const auto& [name, meaning] : choices) {
            if (name == taken) value = meaning;
        }
    };
    return app.add_option_function<std::string>(option, take, help)
        ->type_name(alternatives)
        ->check(CLI::IsMember(names).description(""))
        ->default_str(name_of(choices, value));
}

/// Returns the length that `text` gives, such as 1.5 or 0.5%.
Length length_of(std::string text) {
    Length length;
    length.in_per_cent = !text.empty() && text.back() == '%';
    if (length.in_per_cent) text.pop_back();
    if (!CLI::detail::lexical_cast(text, length.value)) {
        throw CLI::ValidationError(
            "--detail-size", "give a length such as 1.5, or 0.5% of the bounding box's diagonal");
    }
    return length;
}

void add_steps(CLI::App& app, CommandLine& line) {
    FlowParameters& parameters = line.parameters;
    app.add_option_function<std::string>(
           "--detail-size",
           [&line](const std::string& text) { line.detail_size = length_of(text); },
           help_of("Remove detail smaller than this length, in units of the mesh, or with % of its "
                   "bounding box's diagonal. " +
                   tooltip_of("detail_size")))
        ->type_name("X|X%")
        ->default_str("0");
    app.add_flag("--local-detail-size", parameters.local_detail_size,
                 shared_help("local_detail_size"));
    app.add_option("--order", parameters.order,
                   help_of("1 to 4. " + tooltip_of("order") + " 1 is the flow itself."))
        ->type_name("N")
        ->capture_default_str();
    app.add_option("--depth", parameters.depth, shared_help("depth"))
        ->type_name("N")
        ->capture_default_str();
    app.add_option("--step-size", parameters.step_size, shared_help("step_size"))
        ->type_name("X")
        ->default_str("0");
    app.add_flag("--absolute", parameters.absolute, shared_help("absolute"));
    app.add_option("--iterations", parameters.iterations, shared_help("iterations"))
        ->type_name("N")
        ->capture_default_str();
}

void add_choices(CLI::App& app, CommandLine& line) {
    FlowParameters& parameters = line.parameters;
    add_choice(app, "--flow", parameters.flow, kFlows, shared_help("flow"));
    add_choice(app, "--boundary", parameters.boundary, kBoundaries, shared_help("boundary"));
    app.add_option("--selected", line.selected,
                   help_of("Only selected faces move; vertices of other faces keep their "
                           "positions. PROPERTY is the name of a number that the faces of a PLY "
                           "file have, or else its vertices. A face is selected if its number is "
                           "not 0, or if the numbers of all its vertices are not 0. 'flags' is "
                           "where MeshLab saves a selection: only its bit 32 counts."))
        ->type_name("PROPERTY");
    add_choice(app, "--preserve", parameters.preserve, kPreserves, shared_help("preserve"));
    add_choice(app, "--quality", parameters.quality, kQualities,
               help_of(tooltip_of("quality") +
                       " Written to a PLY file as the property quality of its vertices."));
    add_choice(app, "--separate-sheets", parameters.separate_sheets, kSwitches,
               shared_help("separate_sheets"));
    add_choice(app, "--solver", parameters.solver, kSolvers, shared_help("solver"));
}

void add_solver_numerics(CLI::App& app, FlowParameters& parameters) {
    app.add_option("--tolerance", parameters.tolerance,
                   help_of("With --solver converged: a step is solved when the error estimate, "
                           "relative to the step in the energy norm, is at most this number; "
                           "greater than 0, less than 1. A smaller one takes more iterations. "
                           "With the default, the grid's own error is larger."))
        ->type_name("X")
        ->default_str("1e-3");
    app.add_option("--stabilization", parameters.stabilization,
                   help_of("Weight of the volume stabilisation, without unit, 0 to 1000. The "
                           "stabilisation lets the solver converge; a much larger weight slows "
                           "the surface down. 0 is the paper's system, for which --solver "
                           "converged takes more iterations and may stop short."))
        ->type_name("X")
        ->default_str(CLI::detail::to_string(kDefaultStabilization) + ", with --solver w-cycle 0");
    app.add_option("--cycles", parameters.cycles,
                   help_of("With --solver w-cycle: W-cycles of multigrid in each step, 1 to 1000. "
                           "The paper uses one. More solve the equations more exactly, and the "
                           "time grows in proportion."))
        ->type_name("N")
        ->capture_default_str();
}

void add_numerics(CLI::App& app, FlowParameters& parameters) {
    // Up to version 1.0.0, the rule with 12 samples was called 11, after the paper's 11-point rule.
    const auto rename = [](std::string& name) {
        if (name == "11") name = "12";
        return std::string();
    };
    add_choice(app, "--cubature", parameters.cubature, kCubatures,
               help_of("Samples on each split triangle: 3 as in the paper. Take 1, which is "
                       "inaccurate, or 12, which is slow and exact to degree 6, only to compare."))
        ->transform(CLI::Validator(rename, ""));
    app.add_option("--threads", parameters.threads,
                   help_of("Threads, up to 1024; 0 takes all that OpenMP offers (OMP_NUM_THREADS "
                           "is respected). The result does not depend on it; only processors "
                           "with other vector instructions round differently."))
        ->type_name("N")
        ->capture_default_str();
}

/// Adds an option for a path, which is given in UTF-8.
CLI::Option* add_path(CLI::App& app, const std::string& name, fs::path& path,
                      const std::string& help) {
    const auto set = [&path](const std::string& utf8) { path = fs::u8path(utf8); };
    return app.add_option_function<std::string>(name, set, help)->type_name("");
}

void add_files(CLI::App& app, CommandLine& line) {
    add_path(app, "INPUT", line.input, "The mesh: .ply, .obj, .off or .stl")->required();
    add_path(app, "OUTPUT", line.output, "The smoothed mesh, in the format of its extension")
        ->required();
    add_path(app, "--report", line.report,
             help_of("Write sizes, times, residuals, error estimates and memory to a JSON file."))
        ->type_name("FILE.json");
    app.add_flag("--quiet", line.quiet,
                 help_of("No summary and no progress bar; errors and warnings only."));
}

/// An empty value is a mistake, such as a variable of a script that is not set.
void refuse_empty_values(CLI::App& app) {
    const auto check = [](const std::string& value) { return value.empty() ? "no value" : ""; };
    for (CLI::Option* option : app.get_options()) option->check(CLI::Validator(check, ""));
}

bool is_same_file(const fs::path& a, const fs::path& b) {
    std::error_code ignored;
    return fs::equivalent(a, b, ignored) || follow_links(a, ignored) == follow_links(b, ignored);
}

void check_paths(const CommandLine& line) {
    for (const fs::path& path : {line.input, line.output}) {
        if (format_of(path)) continue;
        throw InvalidParameter(path.u8string() +
                               ": the extension tells the format; give .ply, .obj, .off or .stl.");
    }
    if (!line.selected.empty() && format_of(line.input)->parse != parse_ply) {
        throw InvalidParameter(
            "--selected needs a PLY file as INPUT: only PLY has properties to select by.");
    }
    if (line.parameters.quality != Quality::None && format_of(line.output)->parse != parse_ply) {
        throw InvalidParameter("--quality needs a PLY file as OUTPUT: only PLY can hold it.");
    }
    if (line.report.empty()) return;
    for (const fs::path& path : {line.input, line.output}) {
        if (!is_same_file(line.report, path)) continue;
        throw InvalidParameter("--report would overwrite the mesh " + path.u8string() +
                               "; give it another name.");
    }
}

}  // namespace

CommandLine parse_command_line(std::vector<std::string> arguments) {
    CommandLine line;
    CLI::App app(wrapped(kDescription, kNameColumns + kTextColumns) + "\n", "tracked_mcf");
    app.allow_windows_style_options(false);  // on Windows, "/scan.ply" would be an option
    app.get_formatter()->column_width(kNameColumns);
    app.footer(kExamples);
    app.set_version_flag("--version", "tracked_mcf " TRACKED_MCF_VERSION);
    add_steps(app, line);
    add_choices(app, line);
    add_solver_numerics(app, line.parameters);
    add_numerics(app, line.parameters);
    add_files(app, line);
    refuse_empty_values(app);
    try {
        std::reverse(arguments.begin(), arguments.end());  // as CLI11 wants them
        app.parse(std::move(arguments));
    } catch (const CLI::CallForHelp&) {
        line.answer = app.help();
        return line;
    } catch (const CLI::CallForVersion&) {
        line.answer = app.version() + "\n";
        return line;
    } catch (const CLI::ParseError& error) {
        throw InvalidParameter(std::string(error.what()) + ". Run tracked_mcf --help.");
    }
    check_paths(line);
    return line;
}

}  // namespace tracked_mcf
