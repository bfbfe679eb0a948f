#include "common/remote/body_client.h"

#include <algorithm>

#include "common/remote/body_convert.h"
#include "common/remote/list_all.h"
#include "common/rpc/client.h"
#include "common/transfer/service_caller.h"
#include "fitroom/body/v1/scan_service.grpc.pb.h"

namespace fitroom::remote {

using body::v1::ScanService;

struct BodyClient::Impl {
  transfer::ServiceCaller<ScanService> caller;
};

BodyClient::BodyClient(const std::string& address, int attempt_count)
    : impl_(new Impl{{"body center at " + address, address, attempt_count}}) {}

BodyClient::~BodyClient() = default;

Result<ScanUpload> BodyClient::StartUpload(const ScanUploadStatement& statement) {
  body::v1::StartScanUploadRequest request;
  ToProto(statement, request);
  body::v1::StartScanUploadResponse response;
  FR_RETURN_IF_ERROR(impl_->caller.Call(&ScanService::Stub::StartScanUpload, request, response, rpc::kQuickCall));
  FR_ASSIGN_OR_RETURN(ScanUpload upload, UploadFromProto(response.upload()));
  upload.statement = statement;
  return upload;
}

Result<ScanUpload> BodyClient::GetUpload(const ScanUpload& upload) {
  body::v1::GetScanUploadRequest request;
  request.set_name(UploadName(upload));
  body::v1::GetScanUploadResponse response;
  FR_RETURN_IF_ERROR(impl_->caller.Call(&ScanService::Stub::GetScanUpload, request, response, rpc::kQuickCall));
  return UploadFromProto(response.upload());
}

Result<int64_t> BodyClient::SendBytes(const ScanUpload& upload, int64_t offset, std::string_view bytes,
                                      const std::function<void(int64_t)>& progress) {
  body::v1::UploadScanRequest first;
  first.set_upload(UploadName(upload));
  return impl_->caller.Send(&ScanService::Stub::UploadScan, std::move(first), offset, bytes, progress);
}

Result<ScanRecord> BodyClient::FinishUpload(const ScanUpload& upload, const Hash256& hash) {
  body::v1::FinishScanUploadRequest request;
  request.set_name(UploadName(upload));
  request.set_size_bytes(upload.statement.size);
  request.set_blake2b_256(std::string(hash.view()));
  body::v1::FinishScanUploadResponse response;
  FR_RETURN_IF_ERROR(impl_->caller.Call(&ScanService::Stub::FinishScanUpload, request, response, rpc::kLongCall));
  return ScanRecordFromProto(response.scan());
}

Status BodyClient::CancelUpload(const ScanUpload& upload) {
  body::v1::CancelScanUploadRequest request;
  request.set_name(UploadName(upload));
  body::v1::CancelScanUploadResponse response;
  return impl_->caller.Call(&ScanService::Stub::CancelScanUpload, request, response, rpc::kQuickCall);
}

Result<ScanRecord> BodyClient::Register(const ScanUploadStatement& statement, std::string_view file,
                                        const ProgressSink& progress) {
  const auto report = [&](std::string_view stage, int64_t done) {
    if (progress) progress(stage, static_cast<double>(done) / static_cast<double>(statement.size));
  };
  // The scan as it stands, if it is the stated file: an acknowledgement may have been lost on its way.
  const auto find_published = [&]() -> Result<ScanRecord> {
    FR_ASSIGN_OR_RETURN(ScanRecord scan, GetScan(statement.name));
    if (scan.original_hash == statement.hash) return scan;
    return Status(StatusCode::kAlreadyExists, "SCAN_EXISTS",
                  ToString(statement.name) + " holds another file; choose another scan id");
  };
  Result<ScanUpload> started = StartUpload(statement);
  if (!started.ok()) {
    return started.status().reason() == "SCAN_EXISTS" ? find_published() : Result<ScanRecord>(started.status());
  }
  ScanUpload upload = std::move(started).value();
  const Status sent = rpc::RetryTransient(impl_->caller.retries(), [&]() -> Status {
    // Where the upload stands is the server's to say.
    FR_ASSIGN_OR_RETURN(const ScanUpload now, GetUpload(upload));
    if (now.committed_size > statement.size) {
      return DataLoss("UPLOAD_SIZE_MISMATCH",
                      impl_->caller.server() + " holds more bytes than the file has; choose another scan id");
    }
    upload.committed_size = now.committed_size;
    if (upload.committed_size == statement.size) return Status();
    return SendBytes(upload, upload.committed_size, file.substr(static_cast<size_t>(upload.committed_size)),
                     [&](int64_t done) { report("sending", done); })
        .status();
  });
  FR_RETURN_IF_ERROR(sent);
  report("measuring", statement.size);
  Result<ScanRecord> finished = FinishUpload(upload, statement.hash);
  if (!finished.ok() && finished.status().reason() == "UPLOAD_NOT_FOUND") return find_published();
  return finished;
}

Result<ScanRecord> BodyClient::GetScan(const ScanName& name) {
  body::v1::GetScanRequest request;
  request.set_name(ToString(name));
  body::v1::GetScanResponse response;
  FR_RETURN_IF_ERROR(impl_->caller.Call(&ScanService::Stub::GetScan, request, response, rpc::kQuickCall));
  return ScanRecordFromProto(response.scan());
}

Result<ScanPage> BodyClient::ListScans(std::string_view body, int page_size, const std::string& page_token) {
  body::v1::ListScansRequest request;
  request.set_parent("bodies/" + (body.empty() ? std::string("-") : std::string(body)));
  request.set_page_size(page_size);
  request.set_page_token(page_token);
  body::v1::ListScansResponse response;
  FR_RETURN_IF_ERROR(impl_->caller.Call(&ScanService::Stub::ListScans, request, response, rpc::kQuickCall));
  ScanPage page;
  page.next_page_token = response.next_page_token();
  for (const body::v1::Scan& message : response.scans()) {
    FR_ASSIGN_OR_RETURN(ScanRecord scan, ScanRecordFromProto(message));
    page.scans.push_back(std::move(scan));
  }
  return page;
}

Result<std::vector<ScanRecord>> BodyClient::ListAllScans(std::string_view body) {
  return ListAll<ScanRecord>([&](const std::string& token) -> Result<ListPage<ScanRecord>> {
    FR_ASSIGN_OR_RETURN(ScanPage page, ListScans(body, /*page_size=*/200, token));
    return ListPage<ScanRecord>{std::move(page.scans), std::move(page.next_page_token)};
  });
}

Status BodyClient::Download(const ScanName& name, ScanContent content, int64_t offset,
                            const std::function<Status(std::string_view)>& sink) {
  body::v1::DownloadScanRequest request;
  request.set_name(ToString(name));
  request.set_content(ToProto(content));
  return impl_->caller.Receive(&ScanService::Stub::DownloadScan, std::move(request), offset, sink);
}

}  // namespace fitroom::remote
