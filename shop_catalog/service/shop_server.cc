#include "shop_catalog/service/shop_server.h"

#include <chrono>
#include <ctime>
#include <utility>

#include <spdlog/spdlog.h>

#include "common/rpc/periodic_task.h"
#include "common/rpc/server.h"
#include "shop_catalog/service/garment_service.h"
#include "shop_catalog/store/sqlite_garment_store.h"

namespace fitroom::shop_catalog {
namespace {

constexpr std::chrono::hours kUploadLifetime{24};
constexpr std::chrono::hours kSweepPeriod{1};

void DropStaleUploads(GarmentStore& store) {
  const Result<int64_t> dropped =
      store.DropUploadsBefore(std::time(nullptr) - std::chrono::seconds(kUploadLifetime).count());
  if (!dropped.ok()) spdlog::warn("sweep reason={}", dropped.status().reason());
}

class RunningShopServer final : public ShopServer {
 public:
  RunningShopServer(std::unique_ptr<GarmentStore> store, GarmentExtractor extractor, const rpc::StreamLimits& limits)
      : store_(std::move(store)),
        runtime_(/*thread_count=*/4, limits),
        service_(std::make_unique<GarmentServiceImpl>(*store_, std::move(extractor), runtime_)),
        sweeper_(std::make_unique<rpc::PeriodicTask>(kSweepPeriod, [this] { DropStaleUploads(*store_); })) {}
  ~RunningShopServer() override { Shutdown(); }

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
  std::unique_ptr<GarmentStore> store_;
  rpc::CallRuntime runtime_;
  std::unique_ptr<GarmentServiceImpl> service_;
  std::unique_ptr<rpc::PeriodicTask> sweeper_;
  std::unique_ptr<rpc::Server> server_;
};

}  // namespace

Result<std::unique_ptr<ShopServer>> ShopServer::Start(ShopServerOptions options) {
  FR_RETURN_IF_ERROR(rpc::CheckLoopbackAddress(options.listen).status());
  FR_ASSIGN_OR_RETURN(std::unique_ptr<GarmentStore> store, OpenSqliteGarmentStore(options.data_folder));
  rpc::StreamLimits limits;
  limits.stall_timeout = std::chrono::milliseconds(options.stall_timeout_ms);
  auto server = std::make_unique<RunningShopServer>(std::move(store), std::move(options.extractor), limits);
  FR_RETURN_IF_ERROR(
      server->Listen({.listen = options.listen, .drain_time = std::chrono::milliseconds(options.drain_time_ms)}));
  return std::unique_ptr<ShopServer>(std::move(server));
}

}  // namespace fitroom::shop_catalog
