#include "common/rpc/client.h"

#include <array>
#include <cstdio>
#include <random>
#include <thread>

#include <grpcpp/create_channel.h>
#include <grpcpp/security/credentials.h>

#include "common/rpc/grpc_log.h"

namespace fitroom::rpc {

std::shared_ptr<grpc::Channel> OpenChannel(const std::string& address) {
  RouteGrpcLog();
  grpc::ChannelArguments arguments;
  arguments.SetInt(GRPC_ARG_ENABLE_HTTP_PROXY, 0);
  arguments.SetInt(GRPC_ARG_INITIAL_RECONNECT_BACKOFF_MS, 100);
  arguments.SetInt(GRPC_ARG_MIN_RECONNECT_BACKOFF_MS, 4000);  // How long one attempt to connect may take.
  arguments.SetInt(GRPC_ARG_MAX_RECONNECT_BACKOFF_MS, 1000);
  arguments.SetInt(GRPC_ARG_ENABLE_RETRIES, 0);  // We know which calls may be repeated; the library does not.
  return grpc::CreateCustomChannel(address, grpc::InsecureChannelCredentials(), arguments);
}

std::unique_ptr<grpc::ClientContext> MakeClientContext(std::chrono::milliseconds timeout) {
  static thread_local std::mt19937_64 generator{std::random_device{}()};
  std::array<char, 17> request_id{};
  std::snprintf(request_id.data(), request_id.size(), "%016llx", static_cast<unsigned long long>(generator()));
  auto context = std::make_unique<grpc::ClientContext>();
  context->set_deadline(std::chrono::system_clock::now() + timeout);
  context->AddMetadata("x-request-id", request_id.data());
  return context;
}

ClientStallGuard::ClientStallGuard(grpc::ClientContext& context, std::chrono::milliseconds timeout)
    : lease_(watch_.Watch(timeout, [&context] { context.TryCancel(); })) {
  lease_->Arm();
}

bool IsTransient(const Status& status) {
  switch (status.code()) {
    case StatusCode::kUnavailable:
    case StatusCode::kAborted:
      return true;
    case StatusCode::kResourceExhausted:
      return status.reason() == "SERVER_BUSY";
    default:
      return false;
  }
}

Status RetryTransient(const RetryPolicy& policy, const std::function<Status()>& attempt) {
  const auto last_start = std::chrono::steady_clock::now() + policy.patience;
  std::chrono::milliseconds pause = policy.first_pause;
  for (int i = 1;; ++i) {
    Status status = attempt();
    if (status.ok() || !IsTransient(status) || i >= policy.attempt_count) return status;
    if (std::chrono::steady_clock::now() + pause > last_start) return status;
    std::this_thread::sleep_for(pause);
    pause *= 2;
  }
}

}  // namespace fitroom::rpc
