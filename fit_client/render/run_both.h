#pragma once

#include <exception>
#include <future>
#include <string>
#include <system_error>

#include "common/base/status.h"

namespace fitroom::render {

// Runs both, the second on a thread of its own where two are allowed and one can be had. Returns when both have ended.
// INTERNAL [DRAWING_FAILED] if either throws, such as for want of memory; the other still runs to its end.
template <typename First, typename Second>
Status RunBoth(int thread_count, First first, Second second) {
  const auto run = [](auto& work) -> Status {
    try {
      work();
      return Status();
    } catch (const std::exception& error) {
      return Internal("DRAWING_FAILED", std::string("the pictures cannot be drawn: ") + error.what());
    } catch (...) {
      return Internal("DRAWING_FAILED", "the pictures cannot be drawn");
    }
  };
  std::future<Status> other;
  if (thread_count > 1) {
    try {
      other = std::async(std::launch::async, [&] { return run(second); });
    } catch (const std::system_error&) {
      // No thread is to be had: the second goes behind the first.
    }
  }
  const Status first_status = run(first);
  const Status second_status = other.valid() ? other.get() : run(second);
  return first_status.ok() ? second_status : first_status;
}

}  // namespace fitroom::render
