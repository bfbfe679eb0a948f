#pragma once

#include <chrono>
#include <cstdint>
#include <map>
#include <mutex>
#include <string>

#include "common/base/status.h"

namespace fitroom::rpc {

// Limits of a server's streams. They bound its memory: each stream holds one chunk in flight.
struct StreamLimits {
  int stream_count = 64;                           // At once.
  int stream_count_per_peer = 16;                  // At once, for one connection.
  std::chrono::milliseconds stall_timeout{20000};  // A stream without progress is cut after this.
};

// Counts the streams that are open. Thread-safe; must outlive its tickets.
class StreamLimiter {
 public:
  // Counts as one open stream until it dies.
  class Ticket {
   public:
    Ticket() = default;
    Ticket(StreamLimiter* limiter, std::string peer) : limiter_(limiter), peer_(std::move(peer)) {}
    Ticket(Ticket&& other) noexcept;
    Ticket& operator=(Ticket&& other) noexcept;
    ~Ticket() { Release(); }

   private:
    void Release();
    StreamLimiter* limiter_ = nullptr;
    std::string peer_;
  };

  explicit StreamLimiter(const StreamLimits& limits) : limits_(limits) {}

  // Admits a stream. RESOURCE_EXHAUSTED [SERVER_BUSY] or [TOO_MANY_STREAMS] at the limits.
  Result<Ticket> Admit(const std::string& peer);

  const StreamLimits& limits() const { return limits_; }

 private:
  const StreamLimits limits_;
  std::mutex mutex_;
  std::map<std::string, int> open_by_peer_;
  int open_ = 0;
};

}  // namespace fitroom::rpc
