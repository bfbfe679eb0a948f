#include "common/rpc/stall_watch.h"

#include <utility>

namespace fitroom::rpc {
namespace {

// How often the watch looks (unit: millisecond). A stall is noticed at most this much late.
constexpr std::chrono::milliseconds kPeriod{100};

}  // namespace

StallWatch::Lease::Lease(std::chrono::milliseconds timeout, std::function<void()> on_stall)
    : timeout_(timeout), on_stall_(std::move(on_stall)) {}

void StallWatch::Lease::Arm() {
  const std::lock_guard lock(mutex_);
  armed_ = true;
  due_ = std::chrono::steady_clock::now() + timeout_;
}

void StallWatch::Lease::Disarm() {
  const std::lock_guard lock(mutex_);
  armed_ = false;
}

void StallWatch::Lease::End() {
  const std::lock_guard lock(mutex_);
  on_stall_ = nullptr;
}

bool StallWatch::Lease::stalled() const {
  const std::lock_guard lock(mutex_);
  return stalled_;
}

bool StallWatch::Lease::CheckAt(std::chrono::steady_clock::time_point now) {
  const std::lock_guard lock(mutex_);
  if (!on_stall_) return false;
  if (!armed_ || now < due_) return true;
  stalled_ = true;
  on_stall_();
  on_stall_ = nullptr;
  return false;
}

StallWatch::StallWatch() : thread_([this] { Run(); }) {}

StallWatch::~StallWatch() {
  {
    const std::lock_guard lock(mutex_);
    stopping_ = true;
  }
  changed_.notify_all();
  thread_.join();
}

std::shared_ptr<StallWatch::Lease> StallWatch::Watch(std::chrono::milliseconds timeout,
                                                     std::function<void()> on_stall) {
  auto lease = std::make_shared<Lease>(timeout, std::move(on_stall));
  const std::lock_guard lock(mutex_);
  leases_.push_back(lease);
  return lease;
}

void StallWatch::Run() {
  std::unique_lock lock(mutex_);
  while (!stopping_) {
    changed_.wait_for(lock, kPeriod);
    const auto now = std::chrono::steady_clock::now();
    std::erase_if(leases_, [now](const std::shared_ptr<Lease>& lease) { return !lease->CheckAt(now); });
  }
}

}  // namespace fitroom::rpc
