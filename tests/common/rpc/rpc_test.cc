#include <atomic>
#include <chrono>
#include <condition_variable>
#include <mutex>
#include <set>
#include <string>
#include <thread>
#include <vector>

#include <gtest/gtest.h>

#include "common/rpc/byte_budget.h"
#include "common/rpc/client.h"
#include "common/rpc/server.h"
#include "common/rpc/stall_watch.h"
#include "common/rpc/stream_limiter.h"
#include "common/rpc/worker_pool.h"

namespace fitroom::rpc {
namespace {

using std::chrono::milliseconds;

// A condition that a test waits for, with an end to its patience.
class Signal {
 public:
  void Set() {
    const std::lock_guard lock(mutex_);
    is_set_ = true;
    changed_.notify_all();
  }
  bool Await() {
    std::unique_lock lock(mutex_);
    return changed_.wait_for(lock, std::chrono::seconds(20), [this] { return is_set_; });
  }

 private:
  std::mutex mutex_;
  std::condition_variable changed_;
  bool is_set_ = false;
};

TEST(WorkerPool, RunsEverythingItTook) {
  std::atomic<int> count{0};
  {
    WorkerPool pool(/*thread_count=*/3, /*queue_limit=*/1000);
    for (int i = 0; i < 500; ++i) ASSERT_TRUE(pool.TrySubmit([&count] { ++count; }));
  }
  EXPECT_EQ(count, 500);
}

TEST(WorkerPool, RefusesWhatDoesNotFit) {
  Signal started, go;
  WorkerPool pool(/*thread_count=*/1, /*queue_limit=*/2);
  ASSERT_TRUE(pool.TrySubmit([&] {
    started.Set();
    go.Await();
  }));
  ASSERT_TRUE(started.Await());
  EXPECT_TRUE(pool.TrySubmit([] {}));
  EXPECT_TRUE(pool.TrySubmit([] {}));
  EXPECT_FALSE(pool.TrySubmit([] {}));
  go.Set();
}

TEST(StallWatch, CallsOnceWhenAnArmedLeaseIsDue) {
  StallWatch watch;
  Signal stalled;
  std::atomic<int> calls{0};
  const auto lease = watch.Watch(milliseconds(1), [&] {
    ++calls;
    stalled.Set();
  });
  EXPECT_FALSE(lease->stalled());
  lease->Arm();
  ASSERT_TRUE(stalled.Await());
  lease->Arm();
  lease->End();
  EXPECT_TRUE(lease->stalled());
  EXPECT_EQ(calls, 1);
}

TEST(StallWatch, LeavesADisarmedAndAnEndedLeaseAlone) {
  StallWatch watch;
  std::atomic<bool> is_cut{false};
  const auto disarmed = watch.Watch(milliseconds(1), [&] { is_cut = true; });
  disarmed->Arm();
  disarmed->Disarm();
  const auto ended = watch.Watch(milliseconds(1), [&] { is_cut = true; });
  ended->Arm();
  ended->End();
  // A third lease, armed after them, tells when the watch has looked.
  Signal looked;
  const auto third = watch.Watch(milliseconds(200), [&] { looked.Set(); });
  third->Arm();
  ASSERT_TRUE(looked.Await());
  EXPECT_FALSE(is_cut);
}

TEST(StreamLimiter, CountsAllAndEachPeer) {
  StreamLimiter limiter({.stream_count = 3, .stream_count_per_peer = 2});
  Result<StreamLimiter::Ticket> first = limiter.Admit("a");
  Result<StreamLimiter::Ticket> second = limiter.Admit("a");
  ASSERT_TRUE(first.ok() && second.ok());
  EXPECT_EQ(limiter.Admit("a").status().reason(), "TOO_MANY_STREAMS");
  const Result<StreamLimiter::Ticket> third = limiter.Admit("b");
  ASSERT_TRUE(third.ok());
  EXPECT_EQ(limiter.Admit("c").status().reason(), "SERVER_BUSY");
  { const StreamLimiter::Ticket gone = std::move(first).value(); }
  EXPECT_TRUE(limiter.Admit("a").ok());
}

TEST(ByteBudget, LendsNoMoreThanItHas) {
  ByteBudget budget(100);
  ByteLoan loan(budget);
  EXPECT_TRUE(loan.TryTake(60));
  EXPECT_FALSE(loan.TryTake(41));
  {
    ByteLoan other(budget);
    EXPECT_TRUE(other.TryTake(40));
    EXPECT_FALSE(loan.TryTake(1));
  }
  EXPECT_TRUE(loan.TryTake(40));
  loan.GiveBackAll();
  EXPECT_TRUE(budget.TryTake(100));
}

TEST(RetryTransient, RepeatsOnlyWhatMayHelp) {
  const RetryPolicy policy{.attempt_count = 3, .first_pause = milliseconds(1)};
  const auto attempts_for = [&](const Status& status) {
    int attempts = 0;
    EXPECT_EQ(RetryTransient(policy,
                             [&] {
                               ++attempts;
                               return status;
                             })
                  .reason(),
              status.reason());
    return attempts;
  };
  EXPECT_EQ(attempts_for(Unavailable("SERVER_UNAVAILABLE", "")), 3);
  EXPECT_EQ(attempts_for(Status(StatusCode::kAborted, "UPLOAD_OFFSET_CONFLICT", "")), 3);
  EXPECT_EQ(attempts_for(ResourceExhausted("SERVER_BUSY", "")), 3);
  EXPECT_EQ(attempts_for(ResourceExhausted("DISK_FULL", "")), 1);
  EXPECT_EQ(attempts_for(DataLoss("UPLOAD_HASH_MISMATCH", "")), 1);
  EXPECT_EQ(attempts_for(Status(StatusCode::kDeadlineExceeded, "DEADLINE_EXCEEDED", "")), 1);
  int attempts = 0;
  EXPECT_TRUE(RetryTransient(policy, [&]() -> Status {
                return ++attempts < 3 ? Unavailable("SERVER_UNAVAILABLE", "") : Status();
              }).ok());
}

TEST(RetryTransient, LosesItsPatience) {
  const RetryPolicy policy{.attempt_count = 1000000, .first_pause = milliseconds(1), .patience = milliseconds(50)};
  int attempts = 0;
  EXPECT_FALSE(RetryTransient(policy, [&] {
                 ++attempts;
                 return Unavailable("SERVER_UNAVAILABLE", "");
               }).ok());
  EXPECT_LE(attempts, 6) << "pauses of 1, 2, 4, 8, 16 ms and the next would end after 50 ms";
}

TEST(MakeClientContext, GivesADeadlineAndAFreshRequestId) {
  const auto before = std::chrono::system_clock::now();
  const auto context = MakeClientContext(milliseconds(5000));
  EXPECT_GE(context->deadline(), before + milliseconds(4990));
  EXPECT_LE(context->deadline(), std::chrono::system_clock::now() + milliseconds(5010));
}

TEST(CheckLoopbackAddress, TakesLoopbackInEveryForm) {
  EXPECT_EQ(*CheckLoopbackAddress("127.0.0.1:80"), "127.0.0.1:80");
  EXPECT_EQ(*CheckLoopbackAddress("127.255.0.3:0"), "127.255.0.3:0");
  EXPECT_EQ(*CheckLoopbackAddress("localhost:65535"), "127.0.0.1:65535");
  EXPECT_EQ(*CheckLoopbackAddress("[::1]:80"), "[::1]:80");
}

}  // namespace
}  // namespace fitroom::rpc
