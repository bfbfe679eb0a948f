#pragma once

#include <chrono>
#include <cstdint>
#include <functional>
#include <string>
#include <string_view>

#include <grpcpp/server_context.h>

#include "common/base/status.h"

namespace fitroom::rpc {

// Measures one call and writes one line about it: request id, method, code, reason, bytes, milliseconds. Never a
// measurement, a mesh, an image, a token or a message's text.
class CallLog {
 public:
  CallLog(const grpc::ServerContextBase& context, std::string_view method);

  void CountBytes(int64_t byte_count) { byte_count_ += byte_count; }
  void Write(const Status& status) const;

 private:
  std::string request_id_;
  std::string method_;
  int64_t byte_count_ = 0;
  std::chrono::steady_clock::time_point start_;
};

// Runs `work`; whatever it throws becomes INTERNAL with an incident id, and the rest goes to the log.
Status RunGuarded(const std::function<Status()>& work);

// The error for a full queue or too many streams: try again later.
Status ServerBusy();

}  // namespace fitroom::rpc
