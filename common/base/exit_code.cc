#include "common/base/exit_code.h"

#include <cstdio>

namespace fitroom {

ExitCode ExitCodeFor(const Status& status) {
  switch (status.code()) {
    case StatusCode::kOk:
      return ExitCode::kOk;
    case StatusCode::kNotFound:
      return ExitCode::kNotFound;
    case StatusCode::kAlreadyExists:
    case StatusCode::kPermissionDenied:
    case StatusCode::kUnauthenticated:
    case StatusCode::kFailedPrecondition:
      return ExitCode::kRefused;
    case StatusCode::kInvalidArgument:
    case StatusCode::kOutOfRange:
    case StatusCode::kDataLoss:
      return ExitCode::kInvalidInput;
    case StatusCode::kUnavailable:
    case StatusCode::kDeadlineExceeded:
      return ExitCode::kUnavailable;
    case StatusCode::kCancelled:
      return ExitCode::kInterrupted;
    default:
      return ExitCode::kFailure;
  }
}

int ReportAndExitCode(const char* program, const Status& status) {
  if (!status.ok()) {
    std::fprintf(stderr, "%s: %s [%s]\n", program, status.message().c_str(), status.reason().c_str());
  }
  return static_cast<int>(ExitCodeFor(status));
}

}  // namespace fitroom
