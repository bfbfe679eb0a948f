#include "common/base/progress.h"

#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>

namespace fitroom {

ProgressBar::ProgressBar() : visible_(::isatty(STDERR_FILENO) == 1 && std::getenv("NO_PROGRESS") == nullptr) {}

ProgressBar::~ProgressBar() {
  if (drawn_) std::fputc('\n', stderr);
}

void ProgressBar::Update(std::string_view stage, double done) {
  if (!visible_) return;
  constexpr int kWidth = 32;  // Bar width (unit: characters).
  const double part = std::clamp(done, 0.0, 1.0);
  const auto filled = static_cast<size_t>(part * kWidth);
  std::string line = "\r[" + std::string(filled, '#') + std::string(kWidth - filled, '.') + "] ";
  line += std::to_string(static_cast<int>(part * 100.0)) + " % " + std::string(stage) + "\x1b[K";
  if (line == last_) return;
  std::fputs(line.c_str(), stderr);
  std::fflush(stderr);
  last_ = line;
  drawn_ = true;
}

}  // namespace fitroom
