#include "cli/signals.h"

#include "base/files.h"

#include <csignal>
#include <unistd.h>

namespace spectrad {

namespace {

pid_t owner = 0;  // a forked child inherits the handler, but the files are its parent's

extern "C" void endCleanly(int signal) {
    if (::getpid() == owner) removePendingFiles();
    ::raise(signal);  // the default again (SA_RESETHAND), so that the shell sees what ended us
}

}  // namespace

void installSignalHandlers() {
    owner = ::getpid();
    struct sigaction action {};
    action.sa_handler = endCleanly;
    sigemptyset(&action.sa_mask);
    action.sa_flags = SA_RESETHAND | SA_NODEFER;
    for (int signal : {SIGINT, SIGTERM, SIGHUP}) {
        struct sigaction before {};
        ::sigaction(signal, nullptr, &before);
        if (before.sa_handler != SIG_IGN) ::sigaction(signal, &action, nullptr);
    }
    std::signal(SIGXFSZ, SIG_IGN);
}

}  // namespace spectrad
