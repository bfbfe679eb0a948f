#pragma once

#include <chrono>
#include <ctime>
#include <filesystem>
#include <functional>
#include <memory>
#include <string>
#include <utility>

#include "common/rpc/periodic_task.h"
#include "common/rpc/server.h"
#include "common/rpc/server_call.h"

namespace fitroom::transfer {

// What every server of ours is told.
struct UploadServerOptions {
  std::string listen;        // Loopback only; port 0: any free one.
  int stall_timeout_ms = 0;  // A stream without progress is cut after this.
  int drain_time_ms = 0;     // How long running calls may go on after Shutdown().
};

inline constexpr std::chrono::hours kUploadLifetime{24};
inline constexpr std::chrono::hours kSweepPeriod{1};

// Logs what a sweep of stale uploads could not do.
void ReportSweep(const Result<int64_t>& dropped);

// A store, the service over it, and the server over both, as one value. `Interface` is what the program shows of it;
// `Store` has DropUploadsBefore(). Uploads that got no bytes for 24 hours are dropped at the start and every hour.
template <typename Interface, typename Store, typename Service>
class UploadServer final : public Interface {
 public:
  using MakeService = std::function<std::unique_ptr<Service>(Store& store, rpc::CallRuntime& runtime)>;

  // Opens the store and serves. LISTEN_NOT_LOOPBACK before anything is opened; errors of `open` and of
  // rpc::Server::Start().
  static Result<std::unique_ptr<Interface>> Start(const UploadServerOptions& options,
                                                  const std::function<Result<std::unique_ptr<Store>>()>& open,
                                                  const MakeService& make_service) {
    FR_RETURN_IF_ERROR(rpc::CheckLoopbackAddress(options.listen).status());
    FR_ASSIGN_OR_RETURN(std::unique_ptr<Store> store, open());
    rpc::StreamLimits limits;
    limits.stall_timeout = std::chrono::milliseconds(options.stall_timeout_ms);
    auto server = std::make_unique<UploadServer>(std::move(store), limits, make_service);
    FR_RETURN_IF_ERROR(
        server->Listen({.listen = options.listen, .drain_time = std::chrono::milliseconds(options.drain_time_ms)}));
    return std::unique_ptr<Interface>(std::move(server));
  }

  UploadServer(std::unique_ptr<Store> store, const rpc::StreamLimits& limits, const MakeService& make_service)
      : store_(std::move(store)),
        runtime_(/*thread_count=*/4, limits),
        service_(make_service(*store_, runtime_)),
        sweeper_(std::make_unique<rpc::PeriodicTask>(kSweepPeriod, [this] {
          ReportSweep(store_->DropUploadsBefore(std::time(nullptr) - std::chrono::seconds(kUploadLifetime).count()));
        })) {}
  ~UploadServer() override { Shutdown(); }

  const std::string& address() const override { return server_->address(); }
  void Shutdown() override {
    if (server_ != nullptr) server_->Shutdown();
  }

 private:
  Status Listen(const rpc::ServerOptions& options) {
    FR_ASSIGN_OR_RETURN(server_, rpc::Server::Start(options, {service_.get()}));
    return Status();
  }

  // In the order of their needs: each dies before what it uses.
  std::unique_ptr<Store> store_;
  rpc::CallRuntime runtime_;
  std::unique_ptr<Service> service_;
  std::unique_ptr<rpc::PeriodicTask> sweeper_;
  std::unique_ptr<rpc::Server> server_;
};

}  // namespace fitroom::transfer
