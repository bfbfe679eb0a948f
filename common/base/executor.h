#pragma once

#include <atomic>
#include <cstdint>
#include <functional>
#include <thread>
#include <vector>

namespace fitroom {

// Runs independent tasks, possibly on several threads. Geometry and the solver get one passed in, so that they own no
// threads of their own. Work is cut into tasks by the size of the problem, never by the number of threads: then the
// result is the same on any executor.
class Executor {
 public:
  virtual ~Executor() = default;

  // Returns how many threads may run tasks at the same time, at least 1.
  virtual int thread_count() const = 0;

  // Calls task(0) ... task(task_count - 1), each exactly once, in any order and on any thread, and returns when all
  // have returned. Tasks must not throw and must not call Run(). `task_count` is below 2^20.
  virtual void Run(int task_count, const std::function<void(int)>& task) = 0;
};

// Runs every task on the calling thread, in order.
class SerialExecutor : public Executor {
 public:
  int thread_count() const override { return 1; }
  void Run(int task_count, const std::function<void(int)>& task) override;
};

// Owns thread_count - 1 threads; the caller of Run() is the remaining one. Idle threads spin for some ten microseconds
// before they sleep, because the solver hands out work every hundred microseconds. Run() is for one caller at a time.
class ThreadPool : public Executor {
 public:
  // Starts the threads; a count below 1 is taken as 1.
  explicit ThreadPool(int thread_count);
  ThreadPool(const ThreadPool&) = delete;
  ThreadPool& operator=(const ThreadPool&) = delete;
  ~ThreadPool() override;

  int thread_count() const override { return static_cast<int>(threads_.size()) + 1; }
  void Run(int task_count, const std::function<void(int)>& task) override;

 private:
  void WorkerLoop();
  // Claims and runs tasks of the job that `ticket` belongs to until none is left.
  void RunTasks(uint64_t ticket);

  // Job number, task count and next task in one word (24 + 20 + 20 bits), so that a claim made for an old job fails.
  std::atomic<uint64_t> ticket_ = 0;
  std::atomic<int> unfinished_count_ = 0;
  std::atomic<const std::function<void(int)>*> task_ = nullptr;
  std::atomic<bool> stopping_ = false;
  std::vector<std::thread> threads_;
};

}  // namespace fitroom
