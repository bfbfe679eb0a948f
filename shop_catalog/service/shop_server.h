#pragma once

#include <filesystem>
#include <memory>
#include <string>

#include "common/base/status.h"
#include "shop_catalog/service/publication.h"

namespace fitroom::shop_catalog {

struct ShopServerOptions {
  std::filesystem::path data_folder;
  std::string listen = "127.0.0.1:0";  // Loopback only; port 0: any free one.
  GarmentExtractor extractor = ExtractGarment;
  int stall_timeout_ms = 20000;  // A stream without progress is cut after this.
  int drain_time_ms = 10000;     // How long running calls may go on after Shutdown().
};

// A running shop catalog as a value: store, service and server. Uploads that got no bytes for 24 hours are dropped
// at the start and every hour.
class ShopServer {
 public:
  // Opens the store and serves. Errors of OpenSqliteGarmentStore() and rpc::Server::Start().
  static Result<std::unique_ptr<ShopServer>> Start(ShopServerOptions options);
  virtual ~ShopServer() = default;

  // Host and the port that was really bound.
  virtual const std::string& address() const = 0;
  // Drains: returns when all calls have ended. The store stays open until the destructor closes it.
  virtual void Shutdown() = 0;
};

}  // namespace fitroom::shop_catalog
