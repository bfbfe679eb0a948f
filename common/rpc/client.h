#pragma once

#include <chrono>
#include <functional>
#include <memory>
#include <string>

#include <grpcpp/channel.h>
#include <grpcpp/client_context.h>

#include "common/base/status.h"
#include "common/rpc/stall_watch.h"

namespace fitroom::rpc {

// Deadlines of calls by what they wait for.
inline constexpr std::chrono::milliseconds kQuickCall{10000};    // A look-up.
inline constexpr std::chrono::milliseconds kLongCall{120000};    // Reading and measuring a scan, extracting a garment.
inline constexpr std::chrono::milliseconds kStreamCall{900000};  // A whole transfer; kStreamStall cuts a dead one.
inline constexpr std::chrono::milliseconds kStreamStall{15000};  // A transfer without progress.

// Opens a channel to HOST:PORT, without credentials and never through a proxy. Connecting happens with the first call.
std::shared_ptr<grpc::Channel> OpenChannel(const std::string& address);

// Makes the context that every call needs: a deadline and a fresh request id.
std::unique_ptr<grpc::ClientContext> MakeClientContext(std::chrono::milliseconds timeout);

// Cancels a streaming call that makes no progress. Lives as long as the call; call Progress() after each message.
class ClientStallGuard {
 public:
  explicit ClientStallGuard(grpc::ClientContext& context, std::chrono::milliseconds timeout = kStreamStall);
  ClientStallGuard(const ClientStallGuard&) = delete;
  ClientStallGuard& operator=(const ClientStallGuard&) = delete;
  ~ClientStallGuard() { lease_->End(); }
  void Progress() { lease_->Arm(); }

 private:
  StallWatch watch_;
  std::shared_ptr<StallWatch::Lease> lease_;
};

// How often and how fast a call is tried again.
struct RetryPolicy {
  int attempt_count = 5;
  std::chrono::milliseconds first_pause{100};  // Doubled after each attempt.
  std::chrono::milliseconds patience{8000};    // No attempt starts later than this after the first.
};

// Says whether the same call may succeed later without any change.
bool IsTransient(const Status& status);

// Calls `attempt`, which must be idempotent, until it succeeds, fails for good, or the attempts are used up.
Status RetryTransient(const RetryPolicy& policy, const std::function<Status()>& attempt);

}  // namespace fitroom::rpc
