#pragma once

#include "body_center/service/registration.h"
#include "common/rpc/server_call.h"
#include "fitroom/body/v1/scan_service.grpc.pb.h"

namespace fitroom::body_center {

// fitroom.body.v1.ScanService over a store. Handlers only check, call and convert. Quick work runs on the runtime's
// workers; accepting a scan takes a second and hundreds of megabytes, so one thread of its own does one at a time.
// Store and runtime must outlive the service, and the service the server.
class ScanServiceImpl final : public body::v1::ScanService::CallbackService {
 public:
  ScanServiceImpl(BodyStore& store, ScanAcceptor acceptor, rpc::CallRuntime& runtime);

  grpc::ServerUnaryReactor* StartScanUpload(grpc::CallbackServerContext* context,
                                            const body::v1::StartScanUploadRequest* request,
                                            body::v1::StartScanUploadResponse* response) override;
  grpc::ServerReadReactor<body::v1::UploadScanRequest>* UploadScan(grpc::CallbackServerContext* context,
                                                                   body::v1::UploadScanResponse* response) override;
  grpc::ServerUnaryReactor* GetScanUpload(grpc::CallbackServerContext* context,
                                          const body::v1::GetScanUploadRequest* request,
                                          body::v1::GetScanUploadResponse* response) override;
  grpc::ServerUnaryReactor* CancelScanUpload(grpc::CallbackServerContext* context,
                                             const body::v1::CancelScanUploadRequest* request,
                                             body::v1::CancelScanUploadResponse* response) override;
  grpc::ServerUnaryReactor* FinishScanUpload(grpc::CallbackServerContext* context,
                                             const body::v1::FinishScanUploadRequest* request,
                                             body::v1::FinishScanUploadResponse* response) override;
  grpc::ServerUnaryReactor* GetScan(grpc::CallbackServerContext* context, const body::v1::GetScanRequest* request,
                                    body::v1::GetScanResponse* response) override;
  grpc::ServerUnaryReactor* ListScans(grpc::CallbackServerContext* context, const body::v1::ListScansRequest* request,
                                      body::v1::ListScansResponse* response) override;
  grpc::ServerWriteReactor<body::v1::DownloadScanResponse>* DownloadScan(
      grpc::CallbackServerContext* context, const body::v1::DownloadScanRequest* request) override;

 private:
  BodyStore& store_;
  const ScanAcceptor acceptor_;
  rpc::CallRuntime& runtime_;
  rpc::WorkerPool accepting_{/*thread_count=*/1, /*queue_limit=*/16};
};

}  // namespace fitroom::body_center
