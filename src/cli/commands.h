// The commands of the program: each adds itself to the command line, and leaves what it will do in `action`.
#pragma once

#include "base/error.h"

#include <functional>

namespace CLI {
class App;
}

namespace spectrad {

/// What the chosen command does once the whole command line has been read; returns the exit code.
using Action = std::function<ExitCode()>;

void addRender(CLI::App& app, Action& action);
void addBake(CLI::App& app, Action& action);
void addObserve(CLI::App& app, Action& action);
void addMeasure(CLI::App& app, Action& action);
void addCompare(CLI::App& app, Action& action);
void addCertify(CLI::App& app, Action& action);
void addStudy(CLI::App& app, Action& action);
void addMetamer(CLI::App& app, Action& action);
void addView(CLI::App& app, Action& action);
void addInfo(CLI::App& app, Action& action);
void addDevices(CLI::App& app, Action& action);
void addCompletion(CLI::App& app, Action& action);

}  // namespace spectrad
