#include "common/base/thread_count.h"

#include <sched.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <string>

namespace fitroom {

int AvailableThreadCount() {
  int count = 1;
  cpu_set_t affinity;
  if (::sched_getaffinity(0, sizeof affinity, &affinity) == 0) count = CPU_COUNT(&affinity);
  std::ifstream quota_file("/sys/fs/cgroup/cpu.max");
  std::string quota;
  double period = 0.0;
  if (quota_file >> quota >> period && quota != "max" && period > 0.0) {
    count = std::min(count, static_cast<int>(std::ceil(std::strtod(quota.c_str(), nullptr) / period)));
  }
  return std::max(count, 1);
}

}  // namespace fitroom
