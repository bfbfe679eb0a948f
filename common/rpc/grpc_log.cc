#include "common/rpc/grpc_log.h"

#include <grpc/support/log.h>
#include <spdlog/spdlog.h>

namespace fitroom::rpc {

void RouteGrpcLog() {
  gpr_set_log_function([](gpr_log_func_args* entry) { spdlog::debug("grpc: {}", entry->message); });
}

}  // namespace fitroom::rpc
