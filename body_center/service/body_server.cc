#include "body_center/service/body_server.h"

#include <utility>

#include "body_center/service/scan_service.h"
#include "body_center/store/sqlite_body_store.h"
#include "common/transfer/upload_server.h"

namespace fitroom::body_center {

Result<std::unique_ptr<BodyServer>> BodyServer::Start(BodyServerOptions options) {
  using Server = transfer::UploadServer<BodyServer, BodyStore, ScanServiceImpl>;
  return Server::Start(
      {options.listen, options.stall_timeout_ms, options.drain_time_ms},
      [&] { return OpenSqliteBodyStore(options.data_folder); },
      [&](BodyStore& store, rpc::CallRuntime& runtime) {
        return std::make_unique<ScanServiceImpl>(store, std::move(options.acceptor), runtime);
      });
}

}  // namespace fitroom::body_center
