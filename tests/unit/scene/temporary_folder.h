// For the test that still names it here.
#pragma once

#include "support/temporary_folder.h"
