#include "shop_catalog/service/shop_server.h"

#include <utility>

#include "common/transfer/upload_server.h"
#include "shop_catalog/service/garment_service.h"
#include "shop_catalog/store/sqlite_garment_store.h"

namespace fitroom::shop_catalog {

Result<std::unique_ptr<ShopServer>> ShopServer::Start(ShopServerOptions options) {
  using Server = transfer::UploadServer<ShopServer, GarmentStore, GarmentServiceImpl>;
  return Server::Start(
      {options.listen, options.stall_timeout_ms, options.drain_time_ms},
      [&] { return OpenSqliteGarmentStore(options.data_folder); },
      [&](GarmentStore& store, rpc::CallRuntime& runtime) {
        return std::make_unique<GarmentServiceImpl>(store, std::move(options.extractor), runtime);
      });
}

}  // namespace fitroom::shop_catalog
