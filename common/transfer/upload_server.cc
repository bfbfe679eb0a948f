#include "common/transfer/upload_server.h"

#include <spdlog/spdlog.h>

namespace fitroom::transfer {

void ReportSweep(const Result<int64_t>& dropped) {
  if (!dropped.ok()) spdlog::warn("sweep reason={}", dropped.status().reason());
}

}  // namespace fitroom::transfer
