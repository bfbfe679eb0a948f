#pragma once

#include <chrono>
#include <condition_variable>
#include <functional>
#include <memory>
#include <mutex>
#include <thread>
#include <vector>

namespace fitroom::rpc {

// Cuts streams that make no progress. One thread watches any number of streams. Thread-safe; must outlive its leases.
class StallWatch {
 public:
  // A watched stream. While armed it must be re-armed or disarmed before `timeout` has passed; else `on_stall` is
  // called once, from the watch's thread. Destroying the lease waits for a call that is under way.
  class Lease {
   public:
    Lease(std::chrono::milliseconds timeout, std::function<void()> on_stall);
    void Arm();
    void Disarm();
    // Ends the watch: after this `on_stall` is never called.
    void End();
    bool stalled() const;

   private:
    friend class StallWatch;
    bool CheckAt(std::chrono::steady_clock::time_point now);  // False once the lease has ended.

    const std::chrono::milliseconds timeout_;
    mutable std::mutex mutex_;
    std::function<void()> on_stall_;
    bool armed_ = false;
    bool stalled_ = false;
    std::chrono::steady_clock::time_point due_;
  };

  StallWatch();
  StallWatch(const StallWatch&) = delete;
  StallWatch& operator=(const StallWatch&) = delete;
  ~StallWatch();

  // Starts to watch; disarmed at first. The lease is kept alive until End() or its stall.
  std::shared_ptr<Lease> Watch(std::chrono::milliseconds timeout, std::function<void()> on_stall);

 private:
  void Run();

  std::mutex mutex_;
  std::condition_variable changed_;
  std::vector<std::shared_ptr<Lease>> leases_;
  bool stopping_ = false;
  std::thread thread_;
};

}  // namespace fitroom::rpc
