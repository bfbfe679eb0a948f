#include "common/base/executor.h"

#include <atomic>
#include <numeric>
#include <vector>

#include <gtest/gtest.h>

namespace fitroom {
namespace {

TEST(Executor, RunsEveryTaskExactlyOnceForAnyThreadCount) {
  for (const int thread_count : {1, 2, 3, 5}) {
    ThreadPool pool(thread_count);
    EXPECT_EQ(pool.thread_count(), thread_count);
    for (int round = 0; round < 300; ++round) {
      const int task_count = round % 17;
      std::vector<std::atomic<int>> calls(17);
      pool.Run(task_count, [&](int task) { calls[static_cast<size_t>(task)].fetch_add(1); });
      for (int task = 0; task < 17; ++task) {
        ASSERT_EQ(calls[static_cast<size_t>(task)].load(), task < task_count ? 1 : 0)
            << "threads " << thread_count << ", round " << round << ", task " << task;
      }
    }
  }
}

TEST(Executor, WhatTasksWroteIsSeenAfterRun) {
  ThreadPool pool(2);
  std::vector<int> values(1000, 0);
  for (int round = 1; round <= 50; ++round) {
    pool.Run(1000, [&](int task) { values[static_cast<size_t>(task)] += task; });
    EXPECT_EQ(std::accumulate(values.begin(), values.end(), 0LL), 499500LL * round);
  }
}

TEST(Executor, SerialRunsInOrder) {
  SerialExecutor serial;
  std::vector<int> order;
  serial.Run(4, [&](int task) { order.push_back(task); });
  EXPECT_EQ(order, (std::vector<int>{0, 1, 2, 3}));
}

}  // namespace
}  // namespace fitroom
