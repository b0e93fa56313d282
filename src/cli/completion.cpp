// spectrad completion: scripts for shells, made from the command line's own description, so that they never
// lag behind it.
#include "base/text.h"
#include "cli/commands.h"
#include "cli/console.h"

#include <CLI/CLI.hpp>
#include <fmt/format.h>

namespace spectrad {

namespace {

struct OptionEntry {
    std::vector<std::string> names;    ///< "-o", "--output"
    std::vector<std::string> choices;  ///< of "slit|box|point"
    bool takesValue = false;
    std::string description;
};
struct CommandEntry {
    std::string name, description;
    std::vector<OptionEntry> options;
    std::vector<std::string> choices;  ///< of its arguments; none: files
};

/// "slit|box|point" offers these words; "OUT.png|OUT.exr" and the like, in capitals, name kinds of values.
std::vector<std::string> choicesOf(const std::string& type) {
    std::vector<std::string> choices;
    if (type.find('|') == std::string::npos) return choices;
    for (std::string_view word : split(type, '|'))
        if (word.find_first_of("ABCDEFGHIJKLMNOPQRSTUVWXYZ") == std::string_view::npos)
            choices.emplace_back(word);
    return choices;
}

std::vector<CommandEntry> describe(const CLI::App& app) {
    std::vector<CommandEntry> commands;
    for (const CLI::App* command : app.get_subcommands({})) {
        CommandEntry entry{command->get_name(), command->get_description(), {}, {}};
        for (const CLI::Option* option : command->get_options()) {
            const std::vector<std::string> choices = choicesOf(option->get_type_name());
            if (option->get_positional()) {
                entry.choices.insert(entry.choices.end(), choices.begin(), choices.end());
                continue;
            }
            OptionEntry described{{}, choices, option->get_type_size() != 0, option->get_description()};
            for (const std::string& name : option->get_snames())
                described.names.push_back("-" + name);
            for (const std::string& name : option->get_lnames())
                described.names.push_back("--" + name);
            entry.options.push_back(described);
        }
        commands.push_back(entry);
    }
    return commands;
}

std::string joined(const std::vector<std::string>& items, const char* separator = " ") {
    return fmt::format("{}", fmt::join(items, separator));
}

/// In single quotes of a shell.
std::string singleQuoted(std::string_view text) {
    std::string out = "'";
    for (char c : text)
        out += c == '\'' ? std::string("'\\''") : std::string(1, c);
    return out + "'";
}

/// With a backslash before each of `special`.
std::string backslashed(std::string_view text, std::string_view special) {
    std::string out;
    for (char c : text) {
        if (special.find(c) != std::string_view::npos) out += '\\';
        out += c;
    }
    return out;
}

std::string forBash(const std::vector<CommandEntry>& commands) {
    std::string names, byCommand, byOption;
    for (const CommandEntry& command : commands) {
        names += (names.empty() ? "" : " ") + command.name;
        std::vector<std::string> options;
        for (const OptionEntry& option : command.options) {
            options.insert(options.end(), option.names.begin(), option.names.end());
            if (!option.takesValue) continue;
            std::vector<std::string> patterns;
            for (const std::string& name : option.names)
                patterns.push_back(command.name + ":" + name);
            byOption += fmt::format("        {}) words=\"{}\"; value=1 ;;\n", joined(patterns, "|"),
                                    joined(option.choices));
        }
        byCommand += fmt::format("        {}) options=\"{}\"; words=\"{}\" ;;\n", command.name,
                                 joined(options), joined(command.choices));
    }
    return "# bash: source <(spectrad completion bash)\n"
           "_spectrad() {\n"
           "    local current=${COMP_WORDS[COMP_CWORD]} previous=${COMP_WORDS[COMP_CWORD-1]}\n"
           "    local command=${COMP_WORDS[1]} options= words= value=\n"
           "    COMPREPLY=()\n"
           "    if [ \"$COMP_CWORD\" -eq 1 ]; then\n"
           "        COMPREPLY=($(compgen -W \"" +
           names +
           " --help --version\" -- \"$current\"))\n"
           "        return\n"
           "    fi\n"
           "    case $command in\n" +
           byCommand +
           "    esac\n"
           "    case $command:$previous in\n" +
           byOption +
           "    esac\n"
           "    if [ -z \"$value\" ] && [ \"${current:0:1}\" = - ]; then\n"
           "        COMPREPLY=($(compgen -W \"$options\" -- \"$current\"))\n"
           "    elif [ -n \"$words\" ]; then\n"
           "        COMPREPLY=($(compgen -W \"$words\" -- \"$current\"))\n"
           "    else\n"
           "        compopt -o filenames 2>/dev/null\n"
           "        COMPREPLY=($(compgen -f -- \"$current\"))\n"
           "    fi\n"
           "}\n"
           "complete -F _spectrad spectrad\n";
}

std::string zshAction(const std::vector<std::string>& choices) {
    return choices.empty() ? "_files" : "(" + joined(choices) + ")";
}

std::string forZsh(const std::vector<CommandEntry>& commands) {
    std::string list, cases;
    for (const CommandEntry& command : commands) {
        list +=
            "        " + singleQuoted(command.name + ":" + backslashed(command.description, ":\\")) + "\n";
        std::string arguments;
        for (const OptionEntry& option : command.options)
            for (const std::string& name : option.names) {
                std::string spec = "*" + name + "[" + backslashed(option.description, "[]:\\") + "]";
                if (option.takesValue) spec += ":value:" + zshAction(option.choices);
                arguments += " \\\n                " + singleQuoted(spec);
            }
        arguments += " \\\n                " + singleQuoted("*:argument:" + zshAction(command.choices));
        cases += fmt::format("            {})\n                _arguments{}\n                ;;\n",
                             command.name, arguments);
    }
    return "#compdef spectrad\n"
           "# zsh: spectrad completion zsh > \"${fpath[1]}/_spectrad\"\n"
           "_spectrad() {\n"
           "    local -a commands\n"
           "    commands=(\n" +
           list +
           "    )\n"
           "    if (( CURRENT == 2 )); then\n"
           "        _describe command commands\n"
           "    else\n"
           "        local command=$words[2]\n"
           "        shift words\n"
           "        (( CURRENT-- ))\n"
           "        case $command in\n" +
           cases +
           "        esac\n"
           "    fi\n"
           "}\n"
           "compdef _spectrad spectrad\n";
}

std::string forFish(const std::vector<CommandEntry>& commands) {
    std::string out = "# fish: spectrad completion fish > ~/.config/fish/completions/spectrad.fish\n";
    for (const CommandEntry& command : commands) {
        out += fmt::format("complete -c spectrad -n __fish_use_subcommand -f -a {} -d {}\n", command.name,
                           singleQuoted(command.description));
        const std::string here = "complete -c spectrad -n '__fish_seen_subcommand_from " + command.name + "'";
        if (!command.choices.empty()) out += here + " -f -a " + singleQuoted(joined(command.choices)) + "\n";
        for (const OptionEntry& option : command.options) {
            out += here;
            for (const std::string& name : option.names)
                out += name.starts_with("--") ? " -l " + name.substr(2) : " -s " + name.substr(1);
            if (!option.choices.empty())
                out += " -x -a " + singleQuoted(joined(option.choices));
            else if (option.takesValue)
                out += " -r";
            out += " -d " + singleQuoted(option.description) + "\n";
        }
    }
    return out;
}

}  // namespace

void addCompletion(CLI::App& app, Action& action) {
    CLI::App* command = app.add_subcommand("completion", "Print a completion script for a shell");
    auto shell = std::make_shared<std::string>();
    command->add_option("SHELL", *shell, "the shell")->type_name("bash|zsh|fish")->required();
    command->footer(
        "Examples:\n"
        "  source <(spectrad completion bash)\n"
        "  spectrad completion zsh > \"${fpath[1]}/_spectrad\"\n"
        "  spectrad completion fish > ~/.config/fish/completions/spectrad.fish");
    command->final_callback([&app, &action, shell] {
        action = [&app, shell] {
            const std::vector<CommandEntry> commands = describe(app);
            if (*shell == "bash")
                printText(forBash(commands));
            else if (*shell == "zsh")
                printText(forZsh(commands));
            else if (*shell == "fish")
                printText(forFish(commands));
            else
                throw UsageError("completion: '" + *shell +
                                 "' is no shell known here (allowed: bash, zsh, fish)");
            return ExitCode::ok;
        };
    });
}

}  // namespace spectrad
