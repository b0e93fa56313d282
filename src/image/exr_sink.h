// OpenEXR's way to the disk, and its threads.
#pragma once

#include "base/error.h"
#include "image/file_sink.h"

#include <ImfIO.h>

namespace spectrad {

/// A FileSink as OpenEXR wants it.
class ExrSink : public Imf::OStream {
  public:
    ExrSink(const std::filesystem::path& path, const std::filesystem::path& target)
        : Imf::OStream(target.c_str()), sink_(path, target) {}

    void write(const char bytes[], int count) override { sink_.write(bytes, static_cast<size_t>(count)); }
    /// Never fails: OpenEXR's destructor calls it unguarded.
    std::uint64_t tellp() override { return sink_.position(); }
    void seekp(std::uint64_t position) override { sink_.seek(position); }
    /// To be called after the OpenEXR object is gone: throws MachineError if anything was not written.
    void close() { sink_.close(); }

  private:
    FileSink sink_;
};

/// Runs `write`; what OpenEXR itself throws becomes a MachineError naming `target`.
template <typename Write>
void writingExr(const std::filesystem::path& target, Write write) {
    try {
        write();
    } catch (const Error&) {
        throw;
    } catch (const std::exception& error) {
        throw MachineError("cannot write '" + target.string() + "': " + error.what());
    }
}

/// Gives OpenEXR one thread a core, once in the life of the process (its own default is none), and returns
/// their number.
int exrThreads();

}  // namespace spectrad
