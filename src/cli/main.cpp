// The program: reads the command line, runs one command, and turns every failure into one line and an exit
// code.
#include "base/text.h"
#include "cli/camera_commands.h"
#include "cli/console.h"
#include "cli/help.h"
#include "cli/signals.h"

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <algorithm>
#include <new>

namespace spectrad {

namespace {

constexpr const char* description =
    "Spectrad renders spectroradiometric images: every pixel holds spectral radiance in W.m^-2.sr^-1.nm^-1 "
    "at every "
    "wavelength (nm) asked for.";
constexpr const char* footer =
    "'spectrad COMMAND --help' describes a command with its units, defaults and examples.\n\n"
    "Results go to standard output, remarks and errors to standard error. Exit codes: 0 fine; 1 an error in "
    "the input, or a comparison beyond its bound; 2 wrong usage; 3 the device or the machine failed.\n\n"
    "Examples:\n"
    "  spectrad render chart.xml --preview chart.png\n"
    "  spectrad measure chart.exr --at 150,100,5\n"
    "  spectrad observe chart.exr -o chart.png --observer cie1964-10\n"
    "  spectrad info illuminants/FL11";

/// CLI11 takes an empty value ("--size ''") for one not given; here it is an error.
void refuseEmptyValues(CLI::App& app) {
    const auto nonEmpty = [](const std::string& value) {
        return std::string(value.empty() ? "needs a value" : "");
    };
    for (CLI::App* command : app.get_subcommands({}))
        for (CLI::Option* option : command->get_options())
            if (option->get_type_size() != 0) option->check(nonEmpty, "");
}

std::vector<std::string> optionNames(const CLI::App& app) {
    std::vector<std::string> names;
    for (const CLI::Option* option : app.get_options())
        for (const std::string& name : option->get_lnames())
            names.push_back("--" + name);
    return names;
}

std::vector<std::string> commandNames(const CLI::App& app) {
    std::vector<std::string> names;
    for (const CLI::App* command : app.get_subcommands({}))
        names.push_back(command->get_name());
    return names;
}

/// What is wrong with the command line, in our words where CLI11's are not plain.
std::string complaint(const CLI::App& app, const CLI::App& command, const CLI::ParseError& error) {
    std::vector<std::string> left = command.remaining();
    const auto endOfOptions = std::find(left.begin(), left.end(), "--");
    for (const std::string& word : std::vector<std::string>(left.begin(), endOfOptions))
        if (word.size() > 1 && word[0] == '-')
            return "unknown option '" + word + "'" +
                   didYouMean(word.substr(0, word.find('=')), optionNames(command));
    if (endOfOptions != left.end()) left.erase(endOfOptions);
    if (!left.empty())
        return &command == &app ? "unknown command '" + left[0] + "'" + didYouMean(left[0], commandNames(app))
                                : "unexpected argument '" + left[0] + "'";
    if (&command == &app)
        return "a command is needed (" + fmt::format("{}", fmt::join(commandNames(app), ", ")) + ")";
    std::string message = error.what();
    if (error.get_name() == "ArgumentMismatch") {
        const std::string option = message.substr(0, message.find(':'));
        message = option + (message.find("At Most") == std::string::npos ? " needs a value"
                                                                         : " is given more than once");
    }
    return message;
}

ExitCode runProgram(std::vector<std::string> arguments) {
    if (!arguments.empty() && arguments.front() == "--") arguments.erase(arguments.begin());
    CLI::App app(description, "spectrad");
    app.formatter(std::make_shared<HelpFormatter>());
    app.footer(footer);
    app.set_help_flag("-h,--help", "print this help and exit");
    app.set_version_flag("--version", "spectrad " SPECTRAD_VERSION, "print the version and exit");
    app.require_subcommand(1);

    Action action;
    addRender(app, action);
    addBake(app, action);
    addObserve(app, action);
    addMeasure(app, action);
    addCompare(app, action);
    addCertify(app, action);
    addStudy(app, action);
    addMetamer(app, action);
    addExpose(app, action);
    addSweep(app, action);
    addView(app, action);
    addInfo(app, action);
    addDevices(app, action);
    addCompletion(app, action);
    refuseEmptyValues(app);
    for (CLI::App* command : app.get_subcommands({}))
        command->group("Commands");

    try {
        app.parse(
            std::vector<std::string>(arguments.rbegin(), arguments.rend()));  // CLI11 wants them backwards
    } catch (const CLI::CallForHelp&) {
        printText(app.help());
        return ExitCode::ok;
    } catch (const CLI::CallForVersion& version) {
        printText(std::string(version.what()) + "\n");
        return ExitCode::ok;
    } catch (const CLI::ParseError& error) {
        const std::vector<CLI::App*> chosen = app.get_subcommands();
        const CLI::App& command = chosen.empty() ? app : *chosen.front();
        const std::string name = chosen.empty() ? "spectrad" : "spectrad " + command.get_name();
        throw UsageError(complaint(app, command, error) + "; see '" + name + " --help'");
    }
    return action();
}

ExitCode guarded(const std::vector<std::string>& arguments) {
    try {
        const ExitCode code = runProgram(arguments);
        finishOutput();
        return code;
    } catch (const Error& error) {
        printError(error.what());
        return error.code();
    } catch (const std::bad_alloc&) {
        printError("out of memory");
        return ExitCode::machine;
    } catch (const std::exception& error) {
        printError(std::string("internal error: ") + error.what());
        return ExitCode::machine;
    }
}

}  // namespace

}  // namespace spectrad

int main(int argc, char** argv) {
    spectrad::installSignalHandlers();
    return static_cast<int>(
        spectrad::guarded(std::vector<std::string>(argv + (argc > 0 ? 1 : 0), argv + argc)));
}
