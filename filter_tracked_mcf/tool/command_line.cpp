#include "filter_tracked_mcf/tool/command_line.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <map>
#include <sstream>

#include "filter_tracked_mcf/parameters/parameter_table.h"
#include "filter_tracked_mcf/tool/documents/mesh_document.h"
#include "filter_tracked_mcf/tool/mesh_file.h"

namespace tracked_mcf {

namespace fs = std::filesystem;

namespace {

const std::map<std::string, FlowKind> kFlows = {{"mean-curvature", FlowKind::MeanCurvature},
                                                {"conformalized", FlowKind::Conformalized}};

const std::map<std::string, BoundaryCondition> kBoundaries = {
    {"locked", BoundaryCondition::Locked},
    {"locked-cells", BoundaryCondition::LockedCells},
    {"free", BoundaryCondition::Free}};

const std::map<std::string, Rescaling> kRescalings = {
    {"none", Rescaling::None}, {"area", Rescaling::KeepArea}, {"volume", Rescaling::KeepVolume}};

const std::map<std::string, Cubature> kCubatures = {
    {"1", Cubature::OnePoint}, {"3", Cubature::ThreePoints}, {"11", Cubature::Degree6}};

const std::map<std::string, bool> kSwitches = {{"on", true}, {"off", false}};

const std::map<std::string, Solver> kSolvers = {{"converged", Solver::Converged},
                                                {"w-cycle", Solver::OneWCycle}};

constexpr std::size_t kNameColumns = 26, kTextColumns = 70;

const char* const kDescription =
    "Smooths a triangle mesh by mean-curvature flow: every point moves along the normal with the "
    "speed of the mean curvature, so that noise and small detail vanish first and large shapes "
    "last. Closed surfaces shrink, thin parts pinch, and sharp features are smoothed like noise.";

const char* const kExamples =
    "Examples:\n"
    "  tracked_mcf scan.ply smooth.ply\n"
    "      the defaults: noise of up to about 1 % of the model's size goes\n"
    "  tracked_mcf scan.ply smooth.ply --step-size 1e-6 --iterations 5\n"
    "      gently: only the finest noise goes\n"
    "  tracked_mcf face.obj face_smooth.obj --depth 8 --boundary free\n"
    "      resolve finer detail, and let the rim move\n"
    "  tracked_mcf scan.ply smooth.ply --rescale volume\n"
    "      a closed scan, without shrinking it\n"
    "  tracked_mcf scan.ply smooth.ply --selected flags\n"
    "      only the faces that were selected in MeshLab, saved with their flags\n"
    "  tracked_mcf scan.ply smooth.stl --quiet --report smooth.json\n"
    "      in a script: convert, say nothing, keep sizes, times and residuals\n"
    "\n"
    "Files: PLY, OBJ, OFF and STL, by extension; PLY and STL are written as binary. Everything\n"
    "but positions and normals is kept as far as the output's format can carry it. INPUT and\n"
    "OUTPUT may be the same file: it is replaced only when all has gone well.\n"
    "\n"
    "Exit codes: 0 done; 1 the mesh cannot be read or smoothed; 2 wrong use of options; 3 a\n"
    "result cannot be written. Errors are one line on the error output. So are\n"
    "warnings, even with --quiet: that the flow stopped before its last step, or a step's solver\n"
    "short of the tolerance. They leave the exit code 0.\n"
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

/// The parameters that all hosts share are explained in the same words by all of them.
std::string shared_help(const std::string& name) {
    const auto& table = parameter_table();
    const auto found = std::find_if(table.begin(), table.end(),
                                    [&](const auto& entry) { return entry.name == name; });
    return found == table.end() ? std::string() : help_of(found->tooltip);
}

template <class Map>
CLI::Validator one_of(const Map& names) {
    std::vector<std::string> allowed;
    allowed.reserve(names.size());
    for (const auto& [name, value] : names) allowed.push_back(name);
    return CLI::IsMember(allowed).description("");
}

/// Option names and texts as they come from the parser, before they have a meaning.
struct Texts {
    std::string input, output, report;
    std::string flow, boundary, rescale, cubature, separate_sheets, solver;
};

void add_files(CLI::App& app, Texts& texts) {
    app.add_option("INPUT", texts.input, "The mesh: .ply, .obj, .off or .stl")
        ->required()
        ->type_name("");
    app.add_option("OUTPUT", texts.output, "The smoothed mesh, in the format of its extension")
        ->required()
        ->type_name("");
}

void add_steps(CLI::App& app, FlowParameters& parameters) {
    app.add_option("--depth", parameters.depth, shared_help("depth"))
        ->type_name("N")
        ->capture_default_str();
    app.add_option("--step-size", parameters.step_size, shared_help("step_size"))
        ->type_name("X")
        ->default_str("1e-5");
    app.add_flag("--absolute", parameters.absolute, shared_help("absolute"));
    app.add_option("--iterations", parameters.iterations, shared_help("iterations"))
        ->type_name("N")
        ->capture_default_str();
}

void add_choices(CLI::App& app, Texts& texts, std::string& selected) {
    const auto add = [&app](const char* option, std::string& text, const char* name,
                            const char* values, const auto& names) {
        app.add_option(option, text, shared_help(name))
            ->type_name(values)
            ->check(one_of(names))
            ->capture_default_str();
    };
    add("--flow", texts.flow, "flow", "mean-curvature|conformalized", kFlows);
    add("--boundary", texts.boundary, "boundary", "locked|locked-cells|free", kBoundaries);
    app.add_option("--selected", selected,
                   help_of("Only selected faces move; all vertices that others have keep their "
                           "place. The name of a number that the faces, or else the vertices, of "
                           "a PLY file have: a face is selected if it is not 0, of the face or "
                           "of all its vertices. 'flags' is what MeshLab saves: of it only the "
                           "bit for selected (32) counts."))
        ->type_name("PROPERTY")
        ->check(CLI::Validator(
            [](const std::string& name) { return std::string(name.empty() ? "no name" : ""); },
            ""));
    add("--rescale", texts.rescale, "rescale", "none|area|volume", kRescalings);
    add("--separate-sheets", texts.separate_sheets, "separate_sheets", "on|off", kSwitches);
    add("--solver", texts.solver, "solver", "converged|w-cycle", kSolvers);
}

void add_solver_numerics(CLI::App& app, FlowParameters& parameters) {
    app.add_option("--tolerance", parameters.tolerance,
                   help_of("With --solver converged: a step is solved when what is left of it, "
                           "measured by its energy, is at most this fraction of it; greater than "
                           "0, less than 1. Smaller takes more iterations; the default leaves the "
                           "grid's own error the larger."))
        ->type_name("X")
        ->default_str("1e-3");
    app.add_option("--stabilization", parameters.stabilization,
                   help_of("Weight of the volume stabilisation, without unit, 0 to 1000. It lets "
                           "the solver converge; much more of it holds the surface back. 0 is the "
                           "paper's system, on which --solver converged takes more iterations "
                           "and may stop short."))
        ->type_name("X")
        ->default_str(CLI::detail::to_string(kDefaultStabilization) + ", with --solver w-cycle 0");
    app.add_option("--cycles", parameters.cycles,
                   help_of("With --solver w-cycle: W-cycles of multigrid in each step, 1 to 1000. "
                           "The paper uses one; more solve each step's equations more exactly, and "
                           "the time grows in proportion."))
        ->type_name("N")
        ->capture_default_str();
}

void add_numerics(CLI::App& app, FlowParameters& parameters, Texts& texts) {
    app.add_option("--cubature", texts.cubature,
                   help_of("Samples on each split triangle: 3 as in the paper; 1 is inaccurate, 11 "
                           "is slow, and both are there to compare with."))
        ->type_name("1|3|11")
        ->check(one_of(kCubatures))
        ->capture_default_str();
    app.add_option("--threads", parameters.threads,
                   help_of("Threads; 0 takes all that OpenMP offers (OMP_NUM_THREADS is "
                           "respected). The result is the same whatever the number."))
        ->type_name("N")
        ->capture_default_str();
}

void add_output(CLI::App& app, Texts& texts, bool& quiet) {
    app.add_option("--report", texts.report,
                   help_of("Write sizes, times, residuals and memory to a JSON file."))
        ->type_name("FILE.json");
    app.add_flag("--quiet", quiet,
                 help_of("No summary and no progress bar; errors and warnings only."));
}

fs::path resolved(const fs::path& path) {
    return fs::weakly_canonical(fs::absolute(path));
}

void check_paths(const CommandLine& line) {
    for (const fs::path& path : {line.input, line.output}) {
        if (!MeshFile::knows_format_of(path)) {
            throw UsageError(path.string() +
                             ": the extension tells the format; give .ply, .obj, .off or .stl.");
        }
    }
    if (!line.selected.empty() && lower_case_extension(line.input) != ".ply") {
        throw UsageError(
            "--selected needs a PLY file as INPUT: only PLY has properties to select "
            "by.");
    }
    if (line.report.empty()) return;
    for (const fs::path& path : {line.input, line.output}) {
        if (resolved(line.report) == resolved(path)) {
            throw UsageError("--report would overwrite the mesh " + path.string() +
                             "; give it another name.");
        }
    }
}

}  // namespace

CommandLine parse_command_line(int argc, const char* const* argv) {
    CommandLine line;
    Texts texts;
    texts.flow = flow_name(line.parameters.flow);
    texts.boundary = boundary_name(line.parameters.boundary);
    texts.rescale = rescaling_name(line.parameters.rescale);
    texts.cubature = std::to_string(cubature_name(line.parameters.cubature));
    texts.separate_sheets = line.parameters.separate_sheets ? "on" : "off";
    texts.solver = solver_name(line.parameters.solver);

    CLI::App app(wrapped(kDescription, kNameColumns + kTextColumns) + "\n", "tracked_mcf");
    app.get_formatter()->column_width(kNameColumns);
    app.footer(kExamples);
    app.set_version_flag("--version", std::string("tracked_mcf ") + program_version());
    add_files(app, texts);
    add_steps(app, line.parameters);
    add_choices(app, texts, line.selected);
    add_solver_numerics(app, line.parameters);
    add_numerics(app, line.parameters, texts);
    add_output(app, texts, line.quiet);
    try {
        app.parse(argc, argv);
    } catch (const CLI::CallForHelp&) {
        line.answer = app.help();
        return line;
    } catch (const CLI::CallForVersion&) {
        line.answer = app.version() + "\n";
        return line;
    } catch (const CLI::ParseError& error) {
        throw UsageError(std::string(error.what()) + ". Run tracked_mcf --help.");
    }
    line.input = texts.input;
    line.output = texts.output;
    line.report = texts.report;
    line.parameters.flow = kFlows.at(texts.flow);
    line.parameters.boundary = kBoundaries.at(texts.boundary);
    line.parameters.rescale = kRescalings.at(texts.rescale);
    line.parameters.cubature = kCubatures.at(texts.cubature);
    line.parameters.separate_sheets = kSwitches.at(texts.separate_sheets);
    line.parameters.solver = kSolvers.at(texts.solver);
    check_paths(line);
    return line;
}

const char* flow_name(FlowKind flow) {
    return flow == FlowKind::Conformalized ? "conformalized" : "mean-curvature";
}

const char* boundary_name(BoundaryCondition boundary) {
    if (boundary == BoundaryCondition::Free) return "free";
    return boundary == BoundaryCondition::LockedCells ? "locked-cells" : "locked";
}

const char* rescaling_name(Rescaling rescaling) {
    if (rescaling == Rescaling::None) return "none";
    return rescaling == Rescaling::KeepArea ? "area" : "volume";
}

int cubature_name(Cubature cubature) {
    if (cubature == Cubature::OnePoint) return 1;
    return cubature == Cubature::ThreePoints ? 3 : 11;
}

const char* solver_name(Solver solver) {
    return solver == Solver::OneWCycle ? "w-cycle" : "converged";
}

const char* program_version() {
    return TRACKED_MCF_VERSION;
}

}  // namespace tracked_mcf
