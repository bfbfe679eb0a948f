#pragma once

#include <string_view>

#include <grpcpp/support/status.h>

#include "common/base/status.h"

namespace fitroom::rpc {

// Converts an error for the wire: code, message, and the reason as an ErrorInfo in the error details.
grpc::Status ToGrpcStatus(const Status& status);

// Converts what a call returned. `server` names the other side in messages for people ("body center at
// 127.0.0.1:50051"). Without error details the reason is made from the code: SERVER_UNAVAILABLE, DEADLINE_EXCEEDED, …;
// a call that the server cut counts as UNAVAILABLE, because trying again may help.
Status FromGrpcStatus(const grpc::Status& status, std::string_view server);

}  // namespace fitroom::rpc
