#include "body_center/service/body_server.h"

#include <chrono>
#include <ctime>
#include <utility>

#include <spdlog/spdlog.h>

#include "body_center/service/scan_service.h"
#include "body_center/store/sqlite_body_store.h"
#include "common/rpc/periodic_task.h"
#include "common/rpc/server.h"

namespace fitroom::body_center {
namespace {

constexpr std::chrono::hours kUploadLifetime{24};
constexpr std::chrono::hours kSweepPeriod{1};

void DropStaleUploads(BodyStore& store) {
  const Result<int64_t> dropped =
      store.DropUploadsBefore(std::time(nullptr) - std::chrono::seconds(kUploadLifetime).count());
  if (!dropped.ok()) spdlog::warn("sweep reason={}", dropped.status().reason());
}

class RunningBodyServer final : public BodyServer {
 public:
  RunningBodyServer(std::unique_ptr<BodyStore> store, ScanAcceptor acceptor, const rpc::StreamLimits& limits)
      : store_(std::move(store)),
        runtime_(/*thread_count=*/4, limits),
        service_(std::make_unique<ScanServiceImpl>(*store_, std::move(acceptor), runtime_)),
        sweeper_(std::make_unique<rpc::PeriodicTask>(kSweepPeriod, [this] { DropStaleUploads(*store_); })) {}
  ~RunningBodyServer() override { Shutdown(); }

  Status Listen(const rpc::ServerOptions& options) {
    FR_ASSIGN_OR_RETURN(server_, rpc::Server::Start(options, {service_.get()}));
    return Status();
  }
  const std::string& address() const override { return server_->address(); }
  void Shutdown() override {
    if (server_ != nullptr) server_->Shutdown();
  }

 private:
  // In the order of their needs: each dies before what it uses.
  std::unique_ptr<BodyStore> store_;
  rpc::CallRuntime runtime_;
  std::unique_ptr<ScanServiceImpl> service_;
  std::unique_ptr<rpc::PeriodicTask> sweeper_;
  std::unique_ptr<rpc::Server> server_;
};

}  // namespace

Result<std::unique_ptr<BodyServer>> BodyServer::Start(BodyServerOptions options) {
  FR_RETURN_IF_ERROR(rpc::CheckLoopbackAddress(options.listen).status());
  FR_ASSIGN_OR_RETURN(std::unique_ptr<BodyStore> store, OpenSqliteBodyStore(options.data_folder));
  rpc::StreamLimits limits;
  limits.stall_timeout = std::chrono::milliseconds(options.stall_timeout_ms);
  auto server = std::make_unique<RunningBodyServer>(std::move(store), std::move(options.acceptor), limits);
  FR_RETURN_IF_ERROR(
      server->Listen({.listen = options.listen, .drain_time = std::chrono::milliseconds(options.drain_time_ms)}));
  return std::unique_ptr<BodyServer>(std::move(server));
}

}  // namespace fitroom::body_center
