#include "cli/support.h"

#include "base/files.h"
#include "base/text.h"
#include "opencl/device.h"
#include "support/read_picture.h"

#include <algorithm>
#include <cstdlib>
#include <fcntl.h>
#include <stdexcept>
#include <sys/wait.h>
#include <unistd.h>

namespace cli {

Folder::Folder() {
    std::string name = (fs::temp_directory_path() / "spectrad-cli-XXXXXX").string();
    if (!::mkdtemp(name.data())) throw std::runtime_error("no temporary folder");
    path_ = name;
}

Folder::~Folder() {
    std::error_code ignored;
    fs::permissions(path_, fs::perms::owner_all, ignored);
    fs::remove_all(path_, ignored);
}

std::vector<std::string> Folder::names() const {
    std::vector<std::string> names;
    for (const auto& entry : fs::directory_iterator(path_))
        names.push_back(entry.path().filename().string());
    std::sort(names.begin(), names.end());
    return names;
}

void Folder::write(const std::string& name, const std::string& text) const {
    spectrad::writeFile(path_ / name, text);
}

Outcome run(const Folder& folder, const std::vector<std::string>& arguments,
            const std::function<void(int)>& meanwhile) {
    const Folder streams;  // files, so that no pipe can fill up and block
    const fs::path out = streams / "out", err = streams / "err";
    std::vector<char*> argv{const_cast<char*>(SPECTRAD_PROGRAM)};
    for (const std::string& argument : arguments)
        argv.push_back(const_cast<char*>(argument.c_str()));
    argv.push_back(nullptr);

    const pid_t child = ::fork();
    if (child < 0) throw std::runtime_error("fork failed");
    if (child == 0) {
        const int outFile = ::open(out.c_str(), O_CREAT | O_WRONLY, 0600),
                  errFile = ::open(err.c_str(), O_CREAT | O_WRONLY, 0600);
        if (::chdir(folder.path().c_str()) == 0 && ::dup2(outFile, 1) == 1 && ::dup2(errFile, 2) == 2)
            ::execv(SPECTRAD_PROGRAM, argv.data());
        ::_exit(127);
    }
    if (meanwhile) meanwhile(child);
    int status = 0;
    ::waitpid(child, &status, 0);
    Outcome outcome;
    if (WIFEXITED(status)) outcome.code = WEXITSTATUS(status);
    if (WIFSIGNALED(status)) outcome.signal = WTERMSIG(status);
    outcome.out = bytesOf(out);
    outcome.err = bytesOf(err);
    return outcome;
}

bool isOneLine(const std::string& text) {
    return spectrad::startsWith(text, "spectrad: ") && std::count(text.begin(), text.end(), '\n') == 1 &&
           text.back() == '\n';
}

void requireError(const Outcome& outcome, int code, const std::string& mention) {
    INFO("stdout: " << outcome.out << "\nstderr: " << outcome.err);
    REQUIRE(outcome.signal == 0);
    CHECK(outcome.code == code);
    CHECK(outcome.out.empty());
    CHECK(isOneLine(outcome.err));
    CHECK_THAT(outcome.err, Catch::Contains(mention));
}

void writeCube(const fs::path& path, int width, int height, const std::string& wavelengths,
               const std::function<double(int, int, double)>& value, spectrad::CubeKind kind,
               const std::map<std::string, std::string>& attributes) {
    spectrad::CubeInfo info;
    info.width = width;
    info.height = height;
    info.wavelengths = spectrad::parseWavelengths(wavelengths, {});
    info.projectionStated = true;
    info.kind = kind;
    info.attributes = attributes;
    std::vector<float> row(info.wavelengths.size() * static_cast<size_t>(width)),
        preview(3 * static_cast<size_t>(width));
    const auto writer = spectrad::createExr(path, info, {});
    for (int y = 0; y < height; ++y) {
        size_t i = 0;
        for (double nm : info.wavelengths.nm)
            for (int x = 0; x < width; ++x)
                row[i++] = static_cast<float>(value(x, y, nm));
        writer->write(1, row.data(), preview.data());
    }
    (void)writer->finish();
}

std::string bytesOf(const fs::path& path) {
    return spectrad::readFile(path);
}

int codesApart(const fs::path& a, const fs::path& b) {
    const spectrad::Picture8 one = spectrad::readPicture8(a), two = spectrad::readPicture8(b);
    REQUIRE(one.width == two.width);
    REQUIRE(one.height == two.height);
    REQUIRE(one.channels == two.channels);
    int worst = 0;
    for (size_t i = 0; i < one.pixels.size(); ++i)
        worst = std::max(worst, std::abs(one.pixels[i] - two.pixels[i]));
    return worst;
}

void requireObserved(const Folder& folder, const std::string& cube, const std::string& picture,
                     const std::vector<std::string>& options) {
    std::vector<std::string> words{"observe", cube, "-o", "o.png", "-q"};
    words.insert(words.end(), options.begin(), options.end());
    REQUIRE(run(folder, words).code == 0);
    CAPTURE(picture);
    CHECK(codesApart(folder / picture, folder / "o.png") <= 1);
}

bool canDraw(const Outcome& outcome) {
    if (outcome.code == 3 && outcome.err.find("libOSMesa") != std::string::npos) {
        WARN("skipped: " << outcome.err);
        return false;
    }
    INFO(outcome.err);
    REQUIRE(outcome.code == 0);
    return true;
}

bool haveDevice() {
    static const bool have = !spectrad::listDevices().empty();
    if (!have) WARN("no OpenCL device: skipped");
    return have;
}

}  // namespace cli
