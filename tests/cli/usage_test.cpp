// What every command promises: help, exit codes, one line for an error.
#include "cli/support.h"

using cli::Folder;
using cli::Outcome;
using cli::requireError;
using cli::run;

namespace {
const std::vector<std::string> commands{"render", "bake",  "observe", "measure", "compare",   "metamer",
                                        "expose", "sweep", "info",    "devices", "completion"};
}

TEST_CASE("help goes to standard output, lists every command, and ends with 0") {
    const Folder folder;
    const Outcome help = run(folder, {"--help"});
    CHECK(help.code == 0);
    CHECK(help.err.empty());
    for (const std::string& command : commands)
        CHECK_THAT(help.out, Catch::Contains("  " + command));
}

TEST_CASE("the help of every command has an example and its units") {
    const Folder folder;
    for (const std::string& command : commands) {
        const Outcome help = run(folder, {command, "--help"});
        INFO(command);
        CHECK(help.code == 0);
        CHECK(help.err.empty());
        CHECK_THAT(help.out, Catch::Contains("Examples:"));
        CHECK_THAT(help.out, Catch::Contains("spectrad " + command));
    }
    for (const char* command : {"render", "measure", "compare", "info"})
        CHECK_THAT(run(folder, {command, "--help"}).out, Catch::Contains("W.m^-2.sr^-1.nm^-1"));
    CHECK_THAT(run(folder, {"observe", "--help"}).out, Catch::Contains("cd/m2"));
    CHECK_THAT(run(folder, {"devices", "--help"}).out, Catch::Contains("GiB"));
}

TEST_CASE("help says the defaults") {
    const Folder folder;
    const std::string help = run(folder, {"render", "--help"}).out;
    for (const char* text : {"380:780:5", "slit", "16", "piz", ".exr"})
        CHECK_THAT(help, Catch::Contains(text));
    CHECK_THAT(run(folder, {"observe", "--help"}).out,
               Catch::Contains("cat16") && Catch::Contains("srgb") && Catch::Contains("cie1931-2"));
}

TEST_CASE("no line of help is wider than 100 columns") {
    const Folder folder;
    for (const std::string& command : commands) {
        std::istringstream lines(run(folder, {command, "--help"}).out);
        for (std::string line; std::getline(lines, line);) {
            INFO(line);
            CHECK(std::count_if(line.begin(), line.end(), [](char c) { return (c & 0xC0) != 0x80; }) <= 100);
        }
    }
}

TEST_CASE("--version prints one line") {
    const Folder folder;
    const Outcome version = run(folder, {"--version"});
    CHECK(version.code == 0);
    CHECK_THAT(version.out, Catch::Matches("spectrad \\d+\\.\\d+\\.\\d+\n"));
}

TEST_CASE("wrong usage ends with 2, in one line that names the help") {
    const Folder folder;
    requireError(run(folder, {}), 2, "--help");
    requireError(run(folder, {"rendr", "x.xml"}), 2, "did you mean 'render'?");
    requireError(run(folder, {"--verson"}), 2, "unknown option '--verson'");
    requireError(run(folder, {"render"}), 2, "SCENE is required");
    requireError(run(folder, {"render", "x.xml", "--sampels", "4"}), 2, "did you mean '--samples'?");
    requireError(run(folder, {"render", "a.xml", "b.xml"}), 2, "unexpected argument 'b.xml'");
    requireError(run(folder, {"render", "a.xml", "--size"}), 2, "--size needs a value");
    requireError(run(folder, {"render", "a.xml", "--size", ""}), 2, "--size");
    requireError(run(folder, {"render", "a.xml", "--size", "3x3", "--size", "4x4"}), 2,
                 "--size is given more than once");
    requireError(run(folder, {"observe", "x.exr"}), 2, "--output is required");
    requireError(run(folder, {"measure", "x.exr"}), 2, "--at");
    requireError(run(folder, {"info"}), 2, "SCENE");
}

TEST_CASE("values of options that cannot be are wrong usage, and name the option") {
    const Folder folder;
    const std::vector<std::vector<std::string>> wrong{
        {"--size", "0x10"},      {"--size", "10"},
        {"--size", "10x20x30"},  {"--size", "1e2x10"},
        {"--size", "70000x1"},   {"--samples", "0"},
        {"--samples", "65"},     {"--samples", "four"},
        {"--samples", "nan"},    {"--device", "-1"},
        {"--device", "x"},       {"--wavelengths", "700:400:10"},
        {"--wavelengths", "a"},  {"--wavelengths", "500,500"},
        {"--projection", "hat"}, {"--compression", "lzma"},
        {"--only", "x"},         {"--format", "tiff"},
        {"--preview", "x.jpg"}};
    for (const auto& option : wrong) {
        INFO(option[0] << " " << option[1]);
        requireError(run(folder, {"render", "x.xml", option[0], option[1]}), 2, option[0]);
    }
    requireError(run(folder, {"render", "x.xml", "-o", "x.tiff"}), 2, "-o");
    requireError(run(folder, {"render", "x.xml", "-o", "x.img", "--half"}), 2, "--half");
    requireError(run(folder, {"render", "x.xml", "-o", "x.exr", "--format", "envi"}), 2, "--format");
    CHECK(folder.names().empty());
}

TEST_CASE("an option that would not be read is wrong usage") {
    const Folder folder;
    const std::vector<std::vector<std::string>> unread{
        {"render", "x.xml", "--seed", "2"},
        {"render", "x.xml", "--observer", "cie1964-10"},
        {"metamer", "constant:0.3", "constant:0.2", "--count", "3"},
        {"metamer", "constant:0.3", "constant:0.2", "--output", "m.csv"},
        {"expose", "x.exr", "-o", "y.exr", "--chart", "charts/colorchecker"},
        {"info", "illuminants/A", "--size", "3x3"},
        {"info", "--list", "--restrict"}};
    for (const auto& arguments : unread) {
        INFO(arguments.back());
        const bool flag = arguments.back().starts_with("--");
        requireError(run(folder, arguments), 2, flag ? arguments.back() : arguments[arguments.size() - 2]);
    }
    CHECK(folder.names().empty());
}

TEST_CASE("what --verify and --tolerance take is read before the scene is") {
    const Folder folder;
    const auto wrong = [&](const std::vector<std::string>& options, const std::string& mention) {
        std::vector<std::string> all{"render", "nosuch.xml"};
        all.insert(all.end(), options.begin(), options.end());
        requireError(run(folder, all), 2, mention);
    };
    wrong({"--verify", "--seed", "banana"}, "--seed: 'banana' is not a whole number from 0 on");
    wrong({"--verify=200%"}, "--verify");
    wrong({"--tolerance", "x"}, "--tolerance");
    wrong({"--tolerance", "1", "--observer", "nosuch"}, "--observer");
}

TEST_CASE("an observer that is not there is called one, with the nearest that is, films too") {
    const Folder folder;
    cli::writeCube(folder / "c.exr", 2, 2, "400:700:50", [](int, int, double) { return 1.0; });
    const auto refused = [&](const std::string& observer, const std::string& mention) {
        requireError(run(folder, {"measure", "c.exr", "--at", "0,0", "--observer", observer}), 1, mention);
    };
    refused("cie1931", "unknown observer 'cie1931' (did you mean 'cie1931-2'?)");
    refused("generic-reversl", "unknown observer 'generic-reversl' (did you mean 'generic-reversal'?)");
    folder.write("x.xml", R"(<scene><sphere/><camera/></scene>)");
    refused("x.xml#cm", "(there are: none)");
}

TEST_CASE("a limit that is none is not in the message") {
    const Folder folder;
    requireError(run(folder, {"compare", "a.exr", "b.exr", "--max-deltae", "x"}), 2,
                 "'x' is not a number from 0 on\n");
    requireError(run(folder, {"view", "x.xml", "--frames", "x"}), 2, "'x' is not a whole number from 0 on\n");
    requireError(run(folder, {"render", "x.xml", "--samples", "x"}), 2, "a whole number from 1 to 64\n");
    requireError(run(folder, {"metamer", "constant:0.3", "--bounds", "1:0"}), 2, "LOW below HIGH\n");
}

TEST_CASE("-- ends the options: what follows is a name, whatever it begins with") {
    const Folder folder;
    folder.write("-x.csv", "400,0.1\n500,0.2\n");
    for (const std::vector<std::string>& arguments :
         {std::vector<std::string>{"info", "--json", "--", "-x.csv"},
          {"--", "info", "--json", "--", "-x.csv"}}) {
        const Outcome outcome = run(folder, arguments);
        INFO(outcome.err);
        REQUIRE(outcome.code == 0);
        CHECK(outcome.json().at("text") == "-x.csv");
    }
    requireError(run(folder, {"info", "--", "-x.csv", "--json"}), 2, "unexpected argument '--json'");
    requireError(run(folder, {"info", "--jsn", "--", "-x.csv"}), 2, "did you mean '--json'?");
    requireError(run(folder, {"render", "--"}), 2, "SCENE is required");
}

TEST_CASE("a file that is not there is an error in the input that names it") {
    const Folder folder;
    requireError(run(folder, {"render", "nosuch.xml"}), 1, "nosuch.xml");
    requireError(run(folder, {"observe", "nosuch.exr", "-o", "x.png"}), 1, "nosuch.exr");
    requireError(run(folder, {"measure", "nosuch.exr", "--at", "1,1"}), 1, "nosuch.exr");
    requireError(run(folder, {"compare", "nosuch.exr", "other.exr"}), 1, "nosuch.exr");
    requireError(run(folder, {"info", "nosuch.xml"}), 1, "nosuch.xml");
    requireError(run(folder, {"info", "nosuch.exr"}), 1, "nosuch.exr");
    requireError(run(folder, {"info", "nosuch.csv"}), 1, "nosuch.csv");
    CHECK(folder.names().empty());
}

TEST_CASE("a result that cannot be written to standard output is a failure of the machine") {
    const Folder folder;
    const Outcome outcome = run(folder, {"--version"});
    REQUIRE(outcome.code == 0);
    if (!std::filesystem::exists("/dev/full")) {
        WARN("no /dev/full: skipped");
        return;
    }
    const std::string line =
        std::string(SPECTRAD_PROGRAM) + " --version > /dev/full 2> " + (folder / "err").string();
    const int status = std::system(line.c_str());
    CHECK(WEXITSTATUS(status) == 3);
    CHECK(cli::isOneLine(cli::bytesOf(folder / "err")));
}

TEST_CASE("devices are listed with their numbers, and one that is not there is wrong usage") {
    if (!cli::haveDevice()) return;
    const Folder folder;
    const Outcome outcome = run(folder, {"devices", "--json"});
    REQUIRE(outcome.code == 0);
    const auto devices = outcome.json();
    REQUIRE(devices.is_array());
    REQUIRE(!devices.empty());
    for (size_t i = 0; i < devices.size(); ++i) {
        CHECK(devices[i].at("number") == i);
        CHECK(!devices[i].at("name").get<std::string>().empty());
        CHECK(devices[i].at("global_memory_bytes") > 0);
    }
    CHECK_THAT(run(folder, {"devices"}).out, Catch::StartsWith("0: "));
}

TEST_CASE("completion scripts know every command and option, and bash takes its script") {
    const Folder folder;
    for (const char* shell : {"bash", "zsh", "fish"}) {
        const Outcome outcome = run(folder, {"completion", shell});
        INFO(shell);
        CHECK(outcome.code == 0);
        for (const std::string& command : commands)
            CHECK_THAT(outcome.out, Catch::Contains(command));
        CHECK_THAT(outcome.out, Catch::Contains("max-deltae") && Catch::Contains("slit box point"));
    }
    folder.write("script",
                 run(folder, {"completion", "bash"}).out +
                     "COMP_WORDS=(spectrad render --pro); COMP_CWORD=2; _spectrad; echo \"${COMPREPLY[*]}\"\n"
                     "COMP_WORDS=(spectrad render x.xml --projection b); COMP_CWORD=4; _spectrad; echo "
                     "\"${COMPREPLY[*]}\"\n"
                     "COMP_WORDS=(spectrad o); COMP_CWORD=1; _spectrad; echo \"${COMPREPLY[*]}\"\n");
    const std::string line = "bash " + (folder / "script").string() + " > " + (folder / "out").string();
    CHECK(std::system(line.c_str()) == 0);
    CHECK(cli::bytesOf(folder / "out") == "--projection\nbox\nobserve\n");
    requireError(run(folder, {"completion", "tcsh"}), 2, "tcsh");
}
