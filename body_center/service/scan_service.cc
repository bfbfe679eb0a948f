#include "body_center/service/scan_service.h"

#include <algorithm>
#include <utility>

#include "common/base/resource_name.h"
#include "common/remote/body_convert.h"
#include "common/remote/chunk.h"

namespace fitroom::body_center {

namespace v1 = body::v1;  // The messages of this service.
using fitroom::remote::CheckChunk;
using grpc::CallbackServerContext;
using grpc::ServerUnaryReactor;

namespace {

constexpr int kDefaultPageSize = 50;
constexpr int kMaxPageSize = 200;
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

// Takes the chunks of one upload stream and commits them in groups.
class UploadSink final : public rpc::MessageSink<v1::UploadScanRequest> {
 public:
  UploadSink(BodyStore& store, rpc::ByteBudget& budget, v1::UploadScanResponse* response)
      : store_(store), response_(response), loan_(budget) {}

  Result<int64_t> Accept(const v1::UploadScanRequest& request) override {
    FR_RETURN_IF_ERROR(CheckUploadName(request.upload()));
    const Status chunk_status = CheckChunk(request.chunk(), NextOffset());
    if (!chunk_status.ok()) {
      FR_RETURN_IF_ERROR(Commit());  // What came before is whole.
      return chunk_status;
    }
    if (NextOffset() + std::ssize(request.chunk().data()) > upload_.statement.size) {
      return Status(StatusCode::kOutOfRange, "UPLOAD_TOO_LONG", "more bytes than were stated at the start");
    }
    pending_ += request.chunk().data();
    // Where the budget of all streams is used up, a stream commits each chunk at once.
    const bool may_wait = loan_.TryTake(std::ssize(request.chunk().data()));
    if (!may_wait || pending_.size() >= kCommitSize) FR_RETURN_IF_ERROR(Commit());
    return std::ssize(request.chunk().data());
  }

  Status Finish() override {
    if (upload_.id.empty()) return InvalidArgument("UPLOAD_NAME_INVALID", "the stream named no upload");
    FR_RETURN_IF_ERROR(Commit());
    response_->set_committed_size_bytes(upload_.committed_size);
    return Status();
  }

  void Cut() override { (void)Commit(); }

 private:
  int64_t NextOffset() const { return upload_.committed_size + std::ssize(pending_); }

  Status CheckUploadName(const std::string& name) {
    if (upload_.id.empty()) {
      FR_ASSIGN_OR_RETURN(const std::string id, remote::UploadIdFromName(name));
      FR_ASSIGN_OR_RETURN(upload_, store_.FindUpload(id));
      return Status();
    }
    if (name.empty()) return Status();
    return InvalidArgument("UPLOAD_NAME_INVALID", "only the first message of a stream names the upload");
  }

  Status Commit() {
    if (pending_.empty()) return Status();
    const std::string bytes = std::exchange(pending_, {});
    loan_.GiveBackAll();
    FR_ASSIGN_OR_RETURN(upload_.committed_size, store_.AppendToUpload(upload_.id, upload_.committed_size, bytes));
    return Status();
  }

  BodyStore& store_;
  v1::UploadScanResponse* const response_;
  ScanUpload upload_;
  std::string pending_;
  rpc::ByteLoan loan_;
};

// Makes the chunks of one download, out of the store's rows.
class DownloadSource final : public rpc::MessageSource<v1::DownloadScanResponse> {
 public:
  DownloadSource(BodyStore& store, const v1::DownloadScanRequest& request) : store_(store), request_(request) {}

  Result<int64_t> Next(v1::DownloadScanResponse& response) override {
    if (used_ == row_.size()) FR_RETURN_IF_ERROR(LoadRow());
    if (row_.empty()) return 0;
    const std::string_view piece = std::string_view(row_).substr(used_, remote::kMaxChunkSize);
    remote::FillChunk(offset_, piece, *response.mutable_chunk());
    used_ += piece.size();
    offset_ += std::ssize(piece);
    return std::ssize(piece);
  }

 private:
  Status LoadRow() {
    if (!started_) {
      FR_ASSIGN_OR_RETURN(name_, ParseScanName(request_.name()));
      FR_ASSIGN_OR_RETURN(content_, remote::ContentFromProto(request_.content()));
      offset_ = request_.offset_bytes();
      if (offset_ < 0) return Status(StatusCode::kOutOfRange, "OFFSET_PAST_END", "offset_bytes: below 0");
      started_ = true;
    }
    used_ = 0;
    FR_ASSIGN_OR_RETURN(row_, store_.ReadContent(name_, content_, offset_));
    return Status();
  }

  BodyStore& store_;
  const v1::DownloadScanRequest request_;
  bool started_ = false;
  ScanName name_;
  ScanContent content_ = ScanContent::kOriginal;
  int64_t offset_ = 0;
  std::string row_;
  size_t used_ = 0;
};

Status CheckFinishRequest(BodyStore& store, const std::string& id, const v1::FinishScanUploadRequest& request) {
  FR_ASSIGN_OR_RETURN(const ScanUpload upload, store.FindUpload(id));
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
  return new rpc::SinkReactor<v1::UploadScanRequest>(context, runtime_, "UploadScan",
                                                     std::make_unique<UploadSink>(store_, runtime_.bytes, response));
}

ServerUnaryReactor* ScanServiceImpl::GetScanUpload(CallbackServerContext* context,
                                                   const v1::GetScanUploadRequest* request,
                                                   v1::GetScanUploadResponse* response) {
  return rpc::RunUnary(context, runtime_.workers, "GetScanUpload", [this, request, response]() -> Status {
    FR_ASSIGN_OR_RETURN(const std::string id, remote::UploadIdFromName(request->name()));
    FR_ASSIGN_OR_RETURN(const ScanUpload upload, store_.FindUpload(id));
    remote::ToProto(upload, *response->mutable_upload());
    return Status();
  });
}

ServerUnaryReactor* ScanServiceImpl::CancelScanUpload(CallbackServerContext* context,
                                                      const v1::CancelScanUploadRequest* request,
                                                      v1::CancelScanUploadResponse*) {
  return rpc::RunUnary(context, runtime_.workers, "CancelScanUpload", [this, request]() -> Status {
    FR_ASSIGN_OR_RETURN(const std::string id, remote::UploadIdFromName(request->name()));
    return store_.DropUpload(id);
  });
}

ServerUnaryReactor* ScanServiceImpl::FinishScanUpload(CallbackServerContext* context,
                                                      const v1::FinishScanUploadRequest* request,
                                                      v1::FinishScanUploadResponse* response) {
  return rpc::RunUnary(context, accepting_, "FinishScanUpload", [this, context, request, response]() -> Status {
    FR_ASSIGN_OR_RETURN(const std::string id, remote::UploadIdFromName(request->name()));
    FR_RETURN_IF_ERROR(CheckFinishRequest(store_, id, *request));
    FR_ASSIGN_OR_RETURN(const ScanRecord scan,
                        FinishRegistration(store_, acceptor_, id, [context] { return context->IsCancelled(); }));
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
    if (request->page_size() < 0) return InvalidArgument("PAGE_SIZE_INVALID", "page_size: below 0");
    const int page_size =
        request->page_size() == 0 ? kDefaultPageSize : std::min(int{request->page_size()}, kMaxPageSize);
    // One more than the page tells whether there is a next one.
    FR_ASSIGN_OR_RETURN(std::vector<ScanRecord> scans, store_.ListScans(body, after, page_size + 1));
    if (std::ssize(scans) > page_size) {
      scans.pop_back();
      response->set_next_page_token(ToString(scans.back().name));
    }
    for (const ScanRecord& scan : scans) remote::ToProto(scan, *response->add_scans());
    return Status();
  });
}

grpc::ServerWriteReactor<v1::DownloadScanResponse>* ScanServiceImpl::DownloadScan(
    CallbackServerContext* context, const v1::DownloadScanRequest* request) {
  return new rpc::SourceReactor<v1::DownloadScanResponse>(context, runtime_, "DownloadScan",
                                                          std::make_unique<DownloadSource>(store_, *request));
}

}  // namespace fitroom::body_center
