#include "body_center/service/scan_service.h"

#include <utility>

#include "common/base/resource_name.h"
#include "common/remote/body_convert.h"
#include "common/transfer/download_source.h"
#include "common/transfer/page.h"
#include "common/transfer/upload_sink.h"

namespace fitroom::body_center {

namespace v1 = body::v1;  // The messages of this service.
using grpc::CallbackServerContext;
using grpc::ServerUnaryReactor;

namespace {

// What a stream collects before it is committed: 8 blocks of an original (unit: byte).
constexpr size_t kCommitSize = size_t{8} * 960 << 10;

Result<std::string> BodyFromParent(std::string_view parent) {
  constexpr std::string_view kBodies = "bodies/";
  if (parent.starts_with(kBodies)) {
    const std::string_view id = parent.substr(kBodies.size());
    if (id == "-") return std::string();
    if (IsResourceId(id)) return std::string(id);
  }
  return InvalidArgument("PARENT_INVALID", "parent: expected bodies/BODY, or bodies/- for all bodies");
}

// A page token is the name of the last scan of the page before.
Result<ScanName> AfterFromToken(const std::string& token) {
  if (token.empty()) return ScanName{};
  Result<ScanName> after = ParseScanName(token);
  if (!after.ok()) return InvalidArgument("PAGE_TOKEN_INVALID", "page_token: not one of this service");
  return after;
}

// Finds the upload by its whole name: under another body's name it is not there.
Result<ScanUpload> FindNamedUpload(BodyStore& store, std::string_view text) {
  FR_ASSIGN_OR_RETURN(const remote::UploadRef name, remote::UploadRefFromName(text));
  FR_ASSIGN_OR_RETURN(ScanUpload upload, store.FindUpload(name.id));
  if (upload.statement.name.body == name.body) return upload;
  return NotFound("UPLOAD_NOT_FOUND", std::string(text) + ": no such upload; start it again");
}

using ScanSink = transfer::UploadSink<v1::UploadScanRequest, v1::UploadScanResponse>;
using ScanSource = transfer::DownloadSource<v1::DownloadScanRequest, v1::DownloadScanResponse>;

Result<transfer::OpenUpload> OpenScanUpload(BodyStore& store, const v1::UploadScanRequest& first) {
  FR_ASSIGN_OR_RETURN(const ScanUpload upload, FindNamedUpload(store, first.upload()));
  return transfer::OpenUpload{upload.statement.size, upload.committed_size,
                              [&store, id = upload.id](int64_t offset, std::string_view bytes) {
                                return store.AppendToUpload(id, offset, bytes);
                              }};
}

bool NamesUpload(const v1::UploadScanRequest& request) { return !request.upload().empty(); }

Result<ScanSource::Read> OpenContent(BodyStore& store, const v1::DownloadScanRequest& request) {
  FR_ASSIGN_OR_RETURN(const ScanName name, ParseScanName(request.name()));
  FR_ASSIGN_OR_RETURN(const ScanContent content, remote::ContentFromProto(request.content()));
  return ScanSource::Read([&store, name, content](int64_t offset) { return store.ReadContent(name, content, offset); });
}

Status CheckFinishRequest(const ScanUpload& upload, const v1::FinishScanUploadRequest& request) {
  const std::optional<Hash256> hash = Hash256::FromBytes(request.blake2b_256());
  if (request.size_bytes() != upload.statement.size || hash != upload.statement.hash) {
    return InvalidArgument("STATEMENT_DIFFERS", "size_bytes and blake2b_256 are not those stated at the start");
  }
  return Status();
}

}  // namespace

ScanServiceImpl::ScanServiceImpl(BodyStore& store, ScanAcceptor acceptor, rpc::CallRuntime& runtime)
    : store_(store), acceptor_(std::move(acceptor)), runtime_(runtime) {}

ServerUnaryReactor* ScanServiceImpl::StartScanUpload(CallbackServerContext* context,
                                                     const v1::StartScanUploadRequest* request,
                                                     v1::StartScanUploadResponse* response) {
  return rpc::RunUnary(context, runtime_.workers, "StartScanUpload", [this, request, response]() -> Status {
    FR_ASSIGN_OR_RETURN(const ScanUploadStatement statement, remote::StatementFromProto(*request));
    FR_ASSIGN_OR_RETURN(const ScanUpload upload, store_.StartUpload(statement));
    remote::ToProto(upload, *response->mutable_upload());
    return Status();
  });
}

grpc::ServerReadReactor<v1::UploadScanRequest>* ScanServiceImpl::UploadScan(CallbackServerContext* context,
                                                                            v1::UploadScanResponse* response) {
  const auto open = [this](const v1::UploadScanRequest& first) { return OpenScanUpload(store_, first); };
  return new rpc::SinkReactor<v1::UploadScanRequest>(
      context, runtime_, "UploadScan",
      std::make_unique<ScanSink>(open, NamesUpload, runtime_.bytes, kCommitSize, response));
}

ServerUnaryReactor* ScanServiceImpl::GetScanUpload(CallbackServerContext* context,
                                                   const v1::GetScanUploadRequest* request,
                                                   v1::GetScanUploadResponse* response) {
  return rpc::RunUnary(context, runtime_.workers, "GetScanUpload", [this, request, response]() -> Status {
    FR_ASSIGN_OR_RETURN(const ScanUpload upload, FindNamedUpload(store_, request->name()));
    remote::ToProto(upload, *response->mutable_upload());
    return Status();
  });
}

ServerUnaryReactor* ScanServiceImpl::CancelScanUpload(CallbackServerContext* context,
                                                      const v1::CancelScanUploadRequest* request,
                                                      v1::CancelScanUploadResponse*) {
  return rpc::RunUnary(context, runtime_.workers, "CancelScanUpload", [this, request]() -> Status {
    const Result<ScanUpload> upload = FindNamedUpload(store_, request->name());
    if (upload.status().code() == StatusCode::kNotFound) return Status();
    FR_RETURN_IF_ERROR(upload.status());
    return store_.DropUpload(upload->id);
  });
}

ServerUnaryReactor* ScanServiceImpl::FinishScanUpload(CallbackServerContext* context,
                                                      const v1::FinishScanUploadRequest* request,
                                                      v1::FinishScanUploadResponse* response) {
  return rpc::RunUnary(context, accepting_, "FinishScanUpload", [this, context, request, response]() -> Status {
    FR_ASSIGN_OR_RETURN(const ScanUpload upload, FindNamedUpload(store_, request->name()));
    FR_RETURN_IF_ERROR(CheckFinishRequest(upload, *request));
    FR_ASSIGN_OR_RETURN(const ScanRecord scan,
                        FinishRegistration(store_, acceptor_, upload.id, [context] { return context->IsCancelled(); }));
    remote::ToProto(scan, *response->mutable_scan());
    return Status();
  });
}

ServerUnaryReactor* ScanServiceImpl::GetScan(CallbackServerContext* context, const v1::GetScanRequest* request,
                                             v1::GetScanResponse* response) {
  return rpc::RunUnary(context, runtime_.workers, "GetScan", [this, request, response]() -> Status {
    FR_ASSIGN_OR_RETURN(const ScanName name, ParseScanName(request->name()));
    FR_ASSIGN_OR_RETURN(const ScanRecord scan, store_.FindScan(name));
    remote::ToProto(scan, *response->mutable_scan());
    return Status();
  });
}

ServerUnaryReactor* ScanServiceImpl::ListScans(CallbackServerContext* context, const v1::ListScansRequest* request,
                                               v1::ListScansResponse* response) {
  return rpc::RunUnary(context, runtime_.workers, "ListScans", [this, request, response]() -> Status {
    FR_ASSIGN_OR_RETURN(const std::string body, BodyFromParent(request->parent()));
    FR_ASSIGN_OR_RETURN(const ScanName after, AfterFromToken(request->page_token()));
    FR_ASSIGN_OR_RETURN(const int page_size, transfer::PageSize(request->page_size()));
    // One more than the page tells whether there is a next one.
    FR_ASSIGN_OR_RETURN(std::vector<ScanRecord> scans, store_.ListScans(body, after, page_size + 1));
    if (transfer::CutToPage(scans, page_size)) {
      response->set_next_page_token(ToString(scans.back().name));
    }
    for (const ScanRecord& scan : scans) remote::ToProto(scan, *response->add_scans());
    return Status();
  });
}

grpc::ServerWriteReactor<v1::DownloadScanResponse>* ScanServiceImpl::DownloadScan(
    CallbackServerContext* context, const v1::DownloadScanRequest* request) {
  const auto open = [this](const v1::DownloadScanRequest& asked) { return OpenContent(store_, asked); };
  return new rpc::SourceReactor<v1::DownloadScanResponse>(context, runtime_, "DownloadScan",
                                                          std::make_unique<ScanSource>(*request, open));
}

}  // namespace fitroom::body_center
