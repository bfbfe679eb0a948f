#pragma once

#include <chrono>
#include <cstdint>
#include <string>
#include <vector>

#include "fit_client/report/fit_report.h"

namespace fitroom {

// Times the parts of a command, one after the other. Not thread-safe.
class Stopwatch {
 public:
  Stopwatch() : begin_(Clock::now()), lap_begin_(begin_) {}

  // Ends the current part, under this name, and begins the next.
  void Lap(std::string name) {
    const Clock::time_point now = Clock::now();
    laps_.push_back({std::move(name), Seconds(now - lap_begin_)});
    lap_begin_ = now;
  }
  const std::vector<StageTime>& laps() const { return laps_; }
  double total_seconds() const { return Seconds(Clock::now() - begin_); }

 private:
  using Clock = std::chrono::steady_clock;
  static double Seconds(Clock::duration duration) { return std::chrono::duration<double>(duration).count(); }

  Clock::time_point begin_;
  Clock::time_point lap_begin_;
  std::vector<StageTime> laps_;
};

// Returns the most memory this process has held so far (unit: byte).
int64_t PeakMemory();

}  // namespace fitroom
