#pragma once

#include <condition_variable>
#include <deque>
#include <functional>
#include <mutex>
#include <thread>
#include <vector>

namespace fitroom::rpc {

// A fixed number of threads that run blocking work (database, files, geometry) so that gRPC's own threads never block.
// The queue is bounded: what does not fit is refused at once. Thread-safe.
class WorkerPool {
 public:
  WorkerPool(int thread_count, size_t queue_limit);
  WorkerPool(const WorkerPool&) = delete;
  WorkerPool& operator=(const WorkerPool&) = delete;
  // Runs what is queued, then ends the threads.
  ~WorkerPool();

  // Queues `task`; false if the queue is full. A task must not throw.
  [[nodiscard]] bool TrySubmit(std::function<void()> task);

 private:
  void Run();

  const size_t queue_limit_;
  std::mutex mutex_;
  std::condition_variable changed_;
  std::deque<std::function<void()>> queue_;
  bool stopping_ = false;
  std::vector<std::thread> threads_;
};

}  // namespace fitroom::rpc
