#pragma once

#include "common/base/status.h"

namespace fitroom {

// Exit codes of all three programs.
enum class ExitCode {
  kOk = 0,
  kFailure = 1,
  kUsage = 2,
  kNotFound = 3,
  kRefused = 4,
  kInvalidInput = 5,
  kUnavailable = 6,
  kInterrupted = 130,
};

// Maps a status to the exit code that scripts may rely on.
ExitCode ExitCodeFor(const Status& status);

// Prints "program: message [REASON]" to standard error and returns the exit code as an int; OK prints nothing.
int ReportAndExitCode(const char* program, const Status& status);

}  // namespace fitroom
