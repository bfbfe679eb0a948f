#pragma once

namespace fitroom {

// Returns how many threads this process may use: the affinity mask, reduced by the cgroup's CPU quota (cpu.max), which
// neither the standard library nor oneTBB looks at. At least 1.
int AvailableThreadCount();

}  // namespace fitroom
