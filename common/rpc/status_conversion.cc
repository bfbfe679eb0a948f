#include "common/rpc/status_conversion.h"

#include <string>

#include "fitroom/common/v1/rpc_status.pb.h"

namespace fitroom::rpc {
namespace {

constexpr char kErrorInfoUrl[] = "type.googleapis.com/google.rpc.ErrorInfo";
constexpr char kDomain[] = "fitroom";

template <StatusCode ours, grpc::StatusCode theirs>
constexpr bool kSame = static_cast<int>(ours) == static_cast<int>(theirs);
static_assert(kSame<StatusCode::kOk, grpc::StatusCode::OK>);
static_assert(kSame<StatusCode::kCancelled, grpc::StatusCode::CANCELLED>);
static_assert(kSame<StatusCode::kUnknown, grpc::StatusCode::UNKNOWN>);
static_assert(kSame<StatusCode::kInvalidArgument, grpc::StatusCode::INVALID_ARGUMENT>);
static_assert(kSame<StatusCode::kDeadlineExceeded, grpc::StatusCode::DEADLINE_EXCEEDED>);
static_assert(kSame<StatusCode::kNotFound, grpc::StatusCode::NOT_FOUND>);
static_assert(kSame<StatusCode::kAlreadyExists, grpc::StatusCode::ALREADY_EXISTS>);
static_assert(kSame<StatusCode::kPermissionDenied, grpc::StatusCode::PERMISSION_DENIED>);
static_assert(kSame<StatusCode::kResourceExhausted, grpc::StatusCode::RESOURCE_EXHAUSTED>);
static_assert(kSame<StatusCode::kFailedPrecondition, grpc::StatusCode::FAILED_PRECONDITION>);
static_assert(kSame<StatusCode::kAborted, grpc::StatusCode::ABORTED>);
static_assert(kSame<StatusCode::kOutOfRange, grpc::StatusCode::OUT_OF_RANGE>);
static_assert(kSame<StatusCode::kUnimplemented, grpc::StatusCode::UNIMPLEMENTED>);
static_assert(kSame<StatusCode::kInternal, grpc::StatusCode::INTERNAL>);
static_assert(kSame<StatusCode::kUnavailable, grpc::StatusCode::UNAVAILABLE>);
static_assert(kSame<StatusCode::kDataLoss, grpc::StatusCode::DATA_LOSS>);
static_assert(kSame<StatusCode::kUnauthenticated, grpc::StatusCode::UNAUTHENTICATED>);

StatusCode CodeFromGrpc(grpc::StatusCode code) {
  const int number = static_cast<int>(code);
  if (number < static_cast<int>(StatusCode::kCancelled) || number > static_cast<int>(StatusCode::kUnauthenticated)) {
    return StatusCode::kUnknown;
  }
  return static_cast<StatusCode>(number);
}

// The reason that a server of ours put into the details; empty if there is none.
std::string ReasonFromDetails(const grpc::Status& status) {
  common::v1::RpcStatus details;
  if (status.error_details().empty() || !details.ParseFromString(status.error_details())) return "";
  for (const google::protobuf::Any& detail : details.details()) {
    common::v1::ErrorInfo info;
    if (detail.type_url() == kErrorInfoUrl && info.ParseFromString(detail.value()) && info.domain() == kDomain) {
      return info.reason();
    }
  }
  return "";
}

Status StreamCut(const std::string& server) {
  return Unavailable("STREAM_CUT", "the line to the " + server + " was cut; run the command again to go on");
}

// The library's text names its own parts; only what a person can use of it is passed on.
Status UnreachableOrCut(const std::string& server, const std::string& text) {
  if (text.find("failed to connect") == std::string::npos) return StreamCut(server);
  const bool is_refused = text.find("Connection refused") != std::string::npos;
  return Unavailable("SERVER_UNAVAILABLE", "the " + server + " cannot be reached (" +
                                               (is_refused ? "nothing listens there" : "no answer") +
                                               "); start it, or say where it listens, and run the command again");
}

}  // namespace

grpc::Status ToGrpcStatus(const Status& status) {
  if (status.ok()) return grpc::Status::OK;
  common::v1::ErrorInfo info;
  info.set_reason(status.reason());
  info.set_domain(kDomain);
  common::v1::RpcStatus details;
  details.set_code(static_cast<int>(status.code()));
  details.set_message(status.message());
  google::protobuf::Any* detail = details.add_details();
  detail->set_type_url(kErrorInfoUrl);
  info.SerializeToString(detail->mutable_value());
  return grpc::Status(static_cast<grpc::StatusCode>(status.code()), status.message(), details.SerializeAsString());
}

Status FromGrpcStatus(const grpc::Status& status, std::string_view server) {
  if (status.ok()) return Status();
  const StatusCode code = CodeFromGrpc(status.error_code());
  if (std::string reason = ReasonFromDetails(status); !reason.empty()) {
    return Status(code, std::move(reason), status.error_message());
  }
  const std::string name(server);
  switch (code) {
    case StatusCode::kUnavailable:
      return UnreachableOrCut(name, status.error_message());
    case StatusCode::kDeadlineExceeded:
      return Status(code, "DEADLINE_EXCEEDED", "the " + name + " did not answer in time; run the command again");
    case StatusCode::kCancelled:
      return StreamCut(name);
    default:
      return Status(code, std::string(StatusCodeName(code)), "the " + name + ": " + status.error_message());
  }
}

}  // namespace fitroom::rpc
