#include "opencl/program.h"

#include "base/error.h"
#include "base/files.h"
#include "base/text.h"
#include "opencl/kernel_sources.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <set>

namespace spectrad {

namespace fs = std::filesystem;

namespace {

bool has(const std::vector<std::string>& defines, std::string_view switchedOn) {
    return std::find(defines.begin(), defines.end(), switchedOn) != defines.end();
}

// Contraction is off in the sources; division and square root are to be correctly rounded where the device
// can. But for a study of what that costs: CONTRACT, FAST_MATH.
std::string buildOptions(const Device::Body& body, const std::vector<std::string>& defines) {
    std::string options = "-cl-std=CL1.2 -cl-kernel-arg-info -Werror";
    if (has(defines, "CONTRACT")) options += " -cl-mad-enable";
    if (has(defines, "FAST_MATH"))
        options += " -cl-fast-relaxed-math";
    else if (body.device.getInfo<CL_DEVICE_SINGLE_FP_CONFIG>() & CL_FP_CORRECTLY_ROUNDED_DIVIDE_SQRT)
        options += " -cl-fp32-correctly-rounded-divide-sqrt";
    return options;
}

std::string_view textOf(std::string_view name) {
    for (const KernelSource& source : kernelSources())
        if (source.name == name) return source.text;
    throw std::logic_error("no kernel source named " + std::string(name));
}

// Replaces #include "x.h" by the text of x.h, once each; kernels need no include path then.
void appendWithIncludes(std::string_view name, std::set<std::string, std::less<>>& done, std::string& out) {
    if (!done.insert(std::string(name)).second) return;
    out += fmt::format("#line 1 \"{}\"\n", name);
    std::string_view text = textOf(name);
    int line = 0;
    while (!text.empty()) {
        const size_t end = std::min(text.find('\n'), text.size() - 1);
        const std::string_view current = text.substr(0, end + 1);
        text.remove_prefix(end + 1);
        ++line;
        constexpr std::string_view include = "#include \"";
        if (startsWith(current, include)) {
            const std::string_view rest = current.substr(include.size());
            appendWithIncludes(rest.substr(0, rest.find('"')), done, out);
            out += fmt::format("#line {} \"{}\"\n", line + 1, name);
        } else {
            out += current;
        }
    }
}

cl::Program fromBinary(const Device::Body& body, const std::string& bytes, const std::string& options) {
    const cl::Program::Binaries binaries{{bytes.begin(), bytes.end()}};
    cl::Program program(body.context, {body.device}, binaries);
    program.build({body.device}, options.c_str());
    // Arguments are bound by name, and not every driver keeps the names in its binaries: asking throws where
    // they are gone.
    std::vector<cl::Kernel> kernels;
    program.createKernels(&kernels);
    for (const cl::Kernel& kernel : kernels)
        if (kernel.getInfo<CL_KERNEL_NUM_ARGS>() > 0)
            static_cast<void>(kernel.getArgInfo<CL_KERNEL_ARG_NAME>(0));
    return program;
}

// Cached binaries are only a shortcut: whatever is wrong with one, the source is compiled instead.
bool loadCached(const Device::Body& body, const fs::path& file, const std::string& options,
                cl::Program& program) {
    if (!isFile(file)) return false;
    try {
        const std::string stored = readFile(file);
        constexpr size_t digestLength = 64;
        if (stored.size() <= digestLength ||
            sha256(stored.substr(digestLength)) != stored.substr(0, digestLength))
            return false;
        program = fromBinary(body, stored.substr(digestLength), options);
        return true;
    } catch (const std::exception&) {
        return false;
    }
}

void storeCached(const cl::Program& program, const fs::path& file) {
    try {
        const cl::Program::Binaries binaries = program.getInfo<CL_PROGRAM_BINARIES>();
        if (binaries.empty() || binaries.front().empty()) return;
        const std::string bytes(binaries.front().begin(), binaries.front().end());
        fs::create_directories(file.parent_path());
        writeFile(file, sha256(bytes) + bytes);  // appears whole: two processes may share the folder
    } catch (const std::exception&) {
        return;  // an unwritable cache costs time, nothing else
    }
}

}  // namespace

std::string Program::defaultCacheFolder() {
    if (const char* folder = std::getenv("XDG_CACHE_HOME"); folder && *folder)
        return std::string(folder) + "/spectrad";
    if (const char* home = std::getenv("HOME"); home && *home) return std::string(home) + "/.cache/spectrad";
    return {};
}

std::string Program::source(const std::vector<std::string>& files, const std::vector<std::string>& defines) {
    std::vector<std::string> sorted = defines;
    std::sort(sorted.begin(), sorted.end());
    std::string text;
    for (const std::string& define : sorted) {
        std::string line = define;
        std::replace(line.begin(), line.end(), '=', ' ');
        text += "#define " + line + "\n";
    }
    std::set<std::string, std::less<>> done;
    for (const std::string& file : files)
        appendWithIncludes(file, done, text);
    return text;
}

std::string vectorDefine(const Device& device) {
    return "VW=" + std::to_string(device.body().vectorWidth());
}

Kernel vectorKernel(const Device& device, const char* file, const char* name) {
    return Program(device, {file}, {vectorDefine(device)}).kernel(name);
}

Program::Program(const Device& device, const std::vector<std::string>& files,
                 const std::vector<std::string>& defines, const std::string& cacheFolder)
    : device_(device) {
    const Device::Body& body = device.body();
    const std::string text = source(files, defines);
    const std::string options =
        checked(body, "compiling kernels", [&] { return buildOptions(body, defines); });
    const DeviceInfo& info = device.info();
    fs::path cached;
    if (!cacheFolder.empty()) {
        const std::string key = text + "\n" + options + "\n" + info.platform + "\n" + info.name + "\n" +
                                info.driver + "\n" + info.version;
        cached = fs::path(cacheFolder) / (sha256(key) + ".clbin");
        if (loadCached(body, cached, options, program_)) return;
    }
    try {
        program_ = cl::Program(body.context, text);
        program_.build({body.device}, options.c_str());
    } catch (const cl::Error& error) {
        std::string log;
        if (error.err() == CL_BUILD_PROGRAM_FAILURE)
            log = checked(body, "compiling kernels",
                          [&] { return program_.getBuildInfo<CL_PROGRAM_BUILD_LOG>(body.device); });
        throw MachineError(fmt::format("OpenCL: building kernels failed with {} on {}{}{}",
                                       clErrorName(error.err()), info.name, log.empty() ? "" : ":\n", log));
    }
    if (!cached.empty()) storeCached(program_, cached);
}

Kernel::Kernel(const Device& device, const cl::Program& program, const char* name)
    : device_(device), name_(name) {
    checked(device.body(), name, [&] {
        kernel_ = cl::Kernel(program, name);
        const auto count = kernel_.getInfo<CL_KERNEL_NUM_ARGS>();
        isSet_.assign(count, false);
        for (cl_uint i = 0; i < count; ++i)
            arguments_[kernel_.getArgInfo<CL_KERNEL_ARG_NAME>(i)] = i;
    });
}

unsigned Kernel::indexOf(std::string_view argument) const {
    const auto found = arguments_.find(argument);
    if (found == arguments_.end())
        throw std::logic_error("kernel " + name_ + " has no argument '" + std::string(argument) + "'");
    return found->second;
}

Kernel& Kernel::set(std::string_view argument, const cl::Buffer& buffer) {
    const cl_mem handle = buffer();
    setBytes(argument, sizeof handle, static_cast<const void*>(&handle));
    return *this;
}

void Kernel::setBytes(std::string_view argument, size_t size, const void* value) {
    const unsigned index = indexOf(argument);
    checked(device_.body(), name_.c_str(), [&] { kernel_.setArg(index, size, value); });
    isSet_[index] = true;
}

void Kernel::run(size_t items, size_t group) {
    for (const auto& [argument, index] : arguments_)
        if (!isSet_[index])
            throw std::logic_error("kernel " + name_ + ": argument '" + argument + "' was not set");
    if (items == 0) return;
    const size_t whole = (items + group - 1) / group * group;
    checked(device_.body(), name_.c_str(), [&] {
        device_.body().queue.enqueueNDRangeKernel(kernel_, cl::NullRange, cl::NDRange(whole),
                                                  cl::NDRange(group));
    });
}

}  // namespace spectrad
