#include "fit_client/fitting/stopwatch.h"

#include <sys/resource.h>

namespace fitroom {

int64_t PeakMemory() {
  rusage usage{};
  ::getrusage(RUSAGE_SELF, &usage);
  return int64_t{usage.ru_maxrss} * 1024;  // Linux reports KiB.
}

}  // namespace fitroom
