// Commands about cameras and series of lights, as commands.h.
#pragma once

#include "cli/commands.h"

namespace spectrad {

void addExpose(CLI::App& app, Action& action);
void addSweep(CLI::App& app, Action& action);

}  // namespace spectrad
