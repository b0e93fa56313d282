// Ending by a signal leaves no half-written files behind.
#pragma once

namespace spectrad {

/// From now on SIGINT, SIGTERM and SIGHUP remove the files under way and then end the program as that signal
/// does; those that the caller ignores (nohup) stay ignored. Going beyond a limit on file size becomes an
/// error of the write instead.
void installSignalHandlers();

}  // namespace spectrad
