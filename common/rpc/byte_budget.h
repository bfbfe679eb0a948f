#pragma once

#include <atomic>
#include <cstdint>

namespace fitroom::rpc {

// How many bytes all streams of a server together may hold in memory beside one chunk each. Thread-safe.
class ByteBudget {
 public:
  explicit ByteBudget(int64_t byte_count) : left_(byte_count) {}

  // Takes bytes out of the budget; false, and nothing is taken, if they are not there.
  [[nodiscard]] bool TryTake(int64_t byte_count) {
    int64_t left = left_.load();
    while (left >= byte_count) {
      if (left_.compare_exchange_weak(left, left - byte_count)) return true;
    }
    return false;
  }
  void GiveBack(int64_t byte_count) { left_ += byte_count; }

 private:
  std::atomic<int64_t> left_;
};

// What one holder has taken; given back when it dies.
class ByteLoan {
 public:
  explicit ByteLoan(ByteBudget& budget) : budget_(budget) {}
  ByteLoan(const ByteLoan&) = delete;
  ByteLoan& operator=(const ByteLoan&) = delete;
  ~ByteLoan() { GiveBackAll(); }

  [[nodiscard]] bool TryTake(int64_t byte_count) {
    if (!budget_.TryTake(byte_count)) return false;
    taken_ += byte_count;
    return true;
  }
  void GiveBackAll() {
    budget_.GiveBack(taken_);
    taken_ = 0;
  }

 private:
  ByteBudget& budget_;
  int64_t taken_ = 0;
};

}  // namespace fitroom::rpc
