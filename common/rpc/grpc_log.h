#pragma once

namespace fitroom::rpc {

// Sends what the gRPC library logs to our own log at debug level, instead of to standard error past it. Idempotent.
void RouteGrpcLog();

}  // namespace fitroom::rpc
