#include "common/base/executor.h"

#include <algorithm>

#include "common/base/check.h"

namespace fitroom {
namespace {

constexpr int kFieldBits = 20;
constexpr uint64_t kFieldMask = (uint64_t{1} << kFieldBits) - 1;
constexpr int kSpinCount = 4000;  // Some tens of microseconds before a thread sleeps.

uint64_t JobOf(uint64_t ticket) { return ticket >> (2 * kFieldBits); }
uint64_t CountOf(uint64_t ticket) { return (ticket >> kFieldBits) & kFieldMask; }
uint64_t NextOf(uint64_t ticket) { return ticket & kFieldMask; }

void Pause() {
#if defined(__x86_64__)
  __builtin_ia32_pause();
#endif
}

}  // namespace

void SerialExecutor::Run(int task_count, const std::function<void(int)>& task) {
  for (int index = 0; index < task_count; ++index) task(index);
}

ThreadPool::ThreadPool(int thread_count) {
  for (int index = 1; index < std::max(1, thread_count); ++index) threads_.emplace_back([this] { WorkerLoop(); });
}

ThreadPool::~ThreadPool() {
  stopping_.store(true);
  ticket_.store((JobOf(ticket_.load()) + 1) << (2 * kFieldBits));  // A new, empty job wakes everyone.
  ticket_.notify_all();
  for (std::thread& thread : threads_) thread.join();
}

void ThreadPool::Run(int task_count, const std::function<void(int)>& task) {
  FR_CHECK(task_count >= 0 && static_cast<uint64_t>(task_count) <= kFieldMask);
  if (task_count <= 1 || threads_.empty()) {
    for (int index = 0; index < task_count; ++index) task(index);
    return;
  }
  task_.store(&task);
  unfinished_count_.store(task_count);
  const uint64_t job = JobOf(ticket_.load()) + 1;
  const uint64_t ticket = (job << (2 * kFieldBits)) | (static_cast<uint64_t>(task_count) << kFieldBits);
  ticket_.store(ticket);
  ticket_.notify_all();
  RunTasks(ticket);
  for (int spin = 0; unfinished_count_.load() != 0; ++spin) {
    if (spin < kSpinCount) {
      Pause();
    } else {
      std::this_thread::yield();
    }
  }
}

void ThreadPool::RunTasks(uint64_t ticket) {
  const uint64_t job = JobOf(ticket);
  for (uint64_t current = ticket_.load(); JobOf(current) == job && NextOf(current) < CountOf(current);) {
    if (!ticket_.compare_exchange_weak(current, current + 1)) continue;
    (*task_.load())(static_cast<int>(NextOf(current)));
    unfinished_count_.fetch_sub(1);
    current = ticket_.load();
  }
}

void ThreadPool::WorkerLoop() {
  uint64_t done = 0;  // The last job this thread has looked at.
  while (true) {
    uint64_t ticket = ticket_.load();
    for (int spin = 0; JobOf(ticket) == done; ticket = ticket_.load()) {
      if (++spin < kSpinCount) {
        Pause();
      } else {
        ticket_.wait(ticket);
      }
    }
    if (stopping_.load()) return;
    done = JobOf(ticket);
    RunTasks(ticket);
  }
}

}  // namespace fitroom
