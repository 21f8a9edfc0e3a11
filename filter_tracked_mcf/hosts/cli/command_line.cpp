// SPDX-License-Identifier: GPL-3.0-or-later
#include "filter_tracked_mcf/hosts/cli/command_line.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <iomanip>
#include <numeric>
#include <sstream>
#include <type_traits>

#include "filter_tracked_mcf/core/errors.h"
#include "filter_tracked_mcf/core/parameter_table.h"
#include "filter_tracked_mcf/hosts/cli/documents/file_document.h"
#include "filter_tracked_mcf/hosts/cli/output_file.h"
#include "filter_tracked_mcf/hosts/cli/step_files.h"

namespace tracked_mcf {

namespace fs = std::filesystem;

namespace {

constexpr std::size_t kNameColumns = 26, kTextColumns = 54;

const std::string kLength = "X in units of the mesh, or X% of its bounding box's diagonal. ";

const std::string kFaceProperty =
    "Only selected faces move. PROPERTY is the name of a number that the faces of a PLY file have, "
    "or else its vertices. A face is selected if its number is not 0, or if the numbers of all its "
    "vertices are not 0. 'flags' is where MeshLab saves a selection: only its bit 32 counts. ";

const std::string kVertexProperty =
    "PROPERTY is the name of a number that the vertices of a PLY file have; MeshLab's vertex "
    "quality is 'quality'. ";

/// What --help says about the filter of these parameters, and how it is called.
template <class Parameters>
struct ProgramTexts;

template <>
struct ProgramTexts<FlowParameters> {
    static constexpr const char *kCommand = "tracked_mcf", *kUsage = "tracked_mcf [smooth]";
    static constexpr const char* kDescription =
        "Smooths a triangle mesh by mean-curvature flow: every point moves along the normal with "
        "the speed of the mean curvature, so that noise and small detail vanish first and large "
        "shapes last. Closed surfaces shrink and thin parts pinch.";
    static constexpr const char* kExamples =
        "Examples:\n"
        "  tracked_mcf scan.ply smooth.ply\n"
        "      the defaults: removes the finest noise\n"
        "  tracked_mcf scan.ply smooth.ply --detail-size 2%\n"
        "      removes detail smaller than 2 % of the model's diagonal\n"
        "  tracked_mcf face.obj face_smooth.obj --boundary free\n"
        "      lets the rim move\n"
        "  tracked_mcf scan.ply smooth.ply --preserve volume\n"
        "      smooths a scan without shrinking it\n"
        "  tracked_mcf scan.ply smooth.ply --selected flags\n"
        "      smooths only the faces that were selected in MeshLab and saved with flags\n"
        "  tracked_mcf scan.ply smooth.stl --quiet --report smooth.json\n"
        "      in a script: converts, prints no summary, and writes a report\n"
        "\n"
        "The method is that of M. Chuang and M. Kazhdan, Fast Mean-Curvature Flow via\n"
        "Finite-Elements Tracking, 2011.\n";
};

template <>
struct ProgramTexts<NoiseParameters> {
    static constexpr const char *kCommand = "tracked_mcf remove-noise", *kUsage = kCommand;
    static constexpr const char* kDescription =
        "Removes noise from a triangle mesh, and keeps creases and larger detail. Noise is what "
        "single vertices do independently of their neighbours. The program measures it, so the "
        "defaults suit most meshes.";
    static constexpr const char* kExamples =
        "Examples:\n"
        "  tracked_mcf remove-noise scan.ply clean.ply\n"
        "      the defaults\n"
        "  tracked_mcf remove-noise part.stl clean.stl --largest-movement 0.05\n"
        "      moves no vertex farther than the tolerance of the scanner\n"
        "  tracked_mcf remove-noise scan.ply clean.ply --detail-size 2% --crease-angle 40\n"
        "      also removes the layers of a print, and keeps only sharper creases\n";
};

template <>
struct ProgramTexts<FairParameters> {
    static constexpr const char *kCommand = "tracked_mcf fair", *kUsage = kCommand;
    static constexpr const char* kDescription =
        "Makes the selected faces of a triangle mesh continue the surface around them, such as "
        "those that fill a hole. Only vertices of which all faces are selected move, and none on "
        "the rim of an open mesh. Where the surroundings are rough for the size of the hole, "
        "remove noise first.";
    static constexpr const char* kExamples =
        "Examples:\n"
        "  tracked_mcf fair closed.ply fair.ply --selected flags\n"
        "      after Close Holes in MeshLab, refining the new faces, saving with flags\n"
        "  tracked_mcf fair closed.ply fair.ply --selected flags --continuity curvature\n"
        "      in a smooth surface\n";
};

const char* const kFooter =
    "\n"
    "Files: PLY, OBJ, OFF and STL, by extension. If OUTPUT has the format of INPUT,\n"
    "only the positions and the normals around them change: text stays text, and\n"
    "binary stays binary. Another format, PLY or STL in binary, gets only the\n"
    "positions and the faces, and a warning names everything that is left out. Only a\n"
    "PLY file can hold a quality: the property quality of its vertices. INPUT and\n"
    "OUTPUT may be the same file: it is replaced only after everything has succeeded.\n"
    "\n"
    "Exit codes: 0 done; 1 the mesh cannot be read or smoothed; 2 wrong use of\n"
    "options; 3 a result cannot be written; 4 too little memory; 5 an unexpected\n"
    "error. An interrupt ends the program by its signal, which a shell shows as 129,\n"
    "130 or 143. An error is one line on the error output. So is a warning, also with\n"
    "--quiet: it leaves the exit code 0.\n";

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

/// Returns the list of commands, which stands before the flow's help.
template <class Parameters>
std::string list_of_commands() {
    if constexpr (!std::is_same_v<Parameters, FlowParameters>) return {};
    std::ostringstream list;
    list << "Commands, each of which has a --help of its own:\n" << std::left;
    for (const Command& command : kCommands)
        list << "  " << std::setw(kNameColumns - 2) << command.name << command.summary << '\n';
    list << '\n';
    return list.str();
}

std::string help_of(const std::string& text) {
    return wrapped(text, kTextColumns);
}

/// Returns the length that `text` gives to an option, such as 1.5 or 0.5%.
Length length_of(const std::string& option, std::string text) {
    Length length;
    length.in_per_cent = !text.empty() && text.back() == '%';
    if (length.in_per_cent) text.pop_back();
    if (!CLI::detail::lexical_cast(text, length.value)) {
        throw CLI::ValidationError(
            option, "give a length such as 1.5, or 2% of the bounding box's diagonal");
    }
    return length;
}

/// Adds the option of a parameter. `line` and `parameter` must outlive `app`.
template <class Parameters>
void add_parameter(CLI::App& app, CommandLineOf<Parameters>& line,
                   const ParameterOf<Parameters>& parameter) {
    const std::string option = option_of(parameter.name);
    const std::string help = help_of(parameter.help);
    const ParameterValue& value = parameter.initial;
    const std::string first = std::visit([](auto v) { return CLI::detail::to_string(v); }, value);
    const auto set = [&line, &parameter](const ParameterValue& taken) {
        parameter.set(line.parameters, taken);
    };
    switch (parameter.type) {
        case Parameter::Type::Switch:
            app.add_flag_function(
                option, [set](auto count) { set(count > 0); }, help);
            break;
        case Parameter::Type::Integer:
            app.add_option_function<int>(option, set, help)->type_name("N")->default_str(first);
            break;
        case Parameter::Type::Real:
            app.add_option_function<double>(option, set, help)->type_name("X")->default_str(first);
            break;
        case Parameter::Type::Length:
            app.add_option_function<std::string>(
                   option,
                   [&line, &parameter, option](const std::string& text) {
                       line.lengths[parameter.name] = length_of(option, text);
                   },
                   help_of(kLength + parameter.help))
                ->type_name("X|X%")
                ->default_str(first);
            break;
        case Parameter::Type::Choice:
            std::vector<std::string> names;
            for (const NamedChoice& choice : parameter.choices) names.push_back(choice.name);
            const auto take = [&line, &parameter](const std::string& taken) {
                for (std::size_t i = 0; i < parameter.choices.size(); ++i) {
                    if (parameter.choices[i].name != taken) continue;
                    parameter.set(line.parameters, static_cast<int>(i));
                }
            };
            app.add_option_function<std::string>(option, take, help)
                ->type_name(CLI::detail::join(names, "|"))
                ->transform(CLI::IsMember(names, CLI::ignore_case).description(""))
                ->default_str(names.at(static_cast<std::size_t>(std::get<int>(value))));
    }
}

template <class Parameters>
void add_rows(CLI::App& app, CommandLineOf<Parameters>& line) {
    for (const auto& row : parameter_table<Parameters>()) add_parameter(app, line, row);
    for (const Input& input : input_table<Parameters>()) {
        const std::string& property = input.of_faces ? kFaceProperty : kVertexProperty;
        app.add_option(option_of(input.name), line.properties[input.name],
                       help_of(property + input.help))
            ->type_name("PROPERTY");
    }
}

void add_parameters(CLI::App& app, CommandLineOf<FlowParameters>& line) {
    add_rows(app, line);
    app.add_option(
           "--every", line.every,
           help_of("Also write the surface after every N steps, for an animation or a "
                   "hierarchy of scales, to files named after OUTPUT: step 10 of smooth.ply "
                   "is smooth_0010.ply."))
        ->type_name("N")
        ->check(CLI::PositiveNumber.description(""));
}

template <class Parameters>
void add_parameters(CLI::App& app, CommandLineOf<Parameters>& line) {
    add_rows(app, line);
}

void add_parameters(CLI::App& app, CommandLineOf<FairParameters>& line) {
    add_rows(app, line);
    app.get_option("--selected")->required();
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
    app.add_flag("--double", line.doubles,
                 help_of("Write a PLY file's coordinates and normals as doubles. Without this "
                         "option they keep their type."));
    app.add_flag("--overwrite", line.overwrites,
                 help_of("Replace OUTPUT even if it is a mesh of other numbers of vertices or "
                         "faces than INPUT."));
    app.add_flag("--quiet", line.quiet,
                 help_of("No summary and no progress bar; errors and warnings only."));
    app.add_flag("--verbose", line.verbose,
                 help_of("The summary also has the numbers of the grid and of the solver."));
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

void check_paths(const CommandLine& line, bool has_quality) {
    for (const fs::path& path : {line.input, line.output}) {
        if (format_of(path)) continue;
        throw InvalidParameter(path.u8string() +
                               ": the extension tells the format; give .ply, .obj, .off or .stl.");
    }
    for (const auto& [name, property] : line.properties) {
        if (property.empty() || format_of(line.input)->has_numbers) continue;
        throw InvalidParameter(option_of(name) +
                               " needs a PLY file as INPUT: only PLY has properties.");
    }
    if (format_of(line.input) != format_of(line.output) && !format_of(line.output)->convert) {
        throw InvalidParameter(line.output.u8string() +
                               ": only PLY and STL can be written from another format; give " +
                               "OUTPUT the extension of INPUT, .ply or .stl.");
    }
    if (has_quality && !format_of(line.output)->has_numbers) {
        throw InvalidParameter("--quality needs a PLY file as OUTPUT: only PLY can hold it.");
    }
    const StepFiles steps(line.output, line.every);
    for (const fs::path& path : {line.input, line.report}) {
        if (!steps.includes(path)) continue;
        throw InvalidParameter("--every would overwrite " + path.u8string() +
                               "; give OUTPUT another name.");
    }
    if (line.report.empty()) return;
    for (const fs::path& path : {line.input, line.output}) {
        if (!is_same_file(line.report, path)) continue;
        throw InvalidParameter("--report would overwrite the mesh " + path.u8string() +
                               "; give it another name.");
    }
    if (format_of(line.report)) {
        throw InvalidParameter("--report would write JSON to " + line.report.u8string() +
                               ", which has the name of a mesh; give it another one.");
    }
}

/// Returns how many letters must be inserted, removed or replaced to turn one word into the other.
std::size_t distance(const std::string& a, const std::string& b) {
    // [j]: distance from a's letters so far to b's first j
    std::vector<std::size_t> row(b.size() + 1);
    std::iota(row.begin(), row.end(), 0);
    for (const char letter : a) {
        std::size_t above_left = row[0]++;
        for (std::size_t j = 0; j < b.size(); ++j) {
            const std::size_t replaced = above_left + (letter == b[j] ? 0 : 1);
            above_left = row[j + 1];
            row[j + 1] = std::min({replaced, above_left + 1, row[j] + 1});
        }
    }
    return row.back();
}

/// Returns what is probably meant by the unexpected words: the option that is nearest to the first
/// unknown one, or many meshes; empty if neither is near.
std::string hint(const CLI::App& app) {
    std::vector<std::string> names;
    for (const CLI::Option* const option : app.get_options()) names.push_back(option->get_name());
    for (const std::string& word : app.remaining()) {
        if (format_of(fs::u8path(word)))
            return " For all meshes of a folder, run tracked_mcf_folder.";
        if (word.rfind("--", 0) != 0) continue;
        const std::string nearest = nearest_name(word.substr(0, word.find('=')), names);
        return nearest.empty() ? "" : " Do you mean " + nearest + "?";
    }
    return {};
}

}  // namespace

std::string nearest_name(std::string word, const std::vector<std::string>& names) {
    for (char& letter : word) {
        if (letter >= 'A' && letter <= 'Z') letter = static_cast<char>(letter - 'A' + 'a');
    }
    std::string nearest;
    std::size_t least = word.size() / 3 + 1;
    for (const std::string& name : names) {
        const bool is_begun = word.size() > 2 && name.rfind(word, 0) == 0;
        const std::size_t changes = is_begun ? 0 : distance(word, name);
        if (changes >= least) continue;
        nearest = name;
        least = changes;
    }
    return nearest;
}

std::string option_of(const std::string& parameter) {
    std::string option = "--" + parameter;
    std::replace(option.begin(), option.end(), '_', '-');
    return option;
}

template <class Parameters>
CommandLineOf<Parameters> parse_command_line(std::vector<std::string> arguments) {
    CommandLineOf<Parameters> line;
    using Texts = ProgramTexts<Parameters>;
    CLI::App app(list_of_commands<Parameters>() +
                     wrapped(Texts::kDescription, kNameColumns + kTextColumns) + "\n",
                 Texts::kUsage);
    app.allow_windows_style_options(false);  // on Windows, "/scan.ply" would be an option
    app.get_formatter()->column_width(kNameColumns);
    app.footer(std::string(Texts::kExamples) + kFooter);
    app.set_version_flag("--version", "tracked_mcf " TRACKED_MCF_VERSION);
    add_parameters(app, line);
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
        // CLI11 lists unexpected words backwards.
        const bool has_extras =
            error.get_exit_code() == static_cast<int>(CLI::ExitCodes::ExtrasError);
        const std::string what =
            has_extras ? "not expected: " + CLI::detail::join(app.remaining(), " ") : error.what();
        throw InvalidParameter(what + "." + hint(app) + " Run " + Texts::kCommand + " --help.");
    }
    check_paths(line, line.parameters.quality != Quality::None);
    return line;
}

template CommandLineOf<FlowParameters> parse_command_line(std::vector<std::string> arguments);
template CommandLineOf<NoiseParameters> parse_command_line(std::vector<std::string> arguments);
template CommandLineOf<FairParameters> parse_command_line(std::vector<std::string> arguments);

}  // namespace tracked_mcf
