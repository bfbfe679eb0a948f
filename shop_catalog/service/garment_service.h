#pragma once

#include "common/rpc/server_call.h"
#include "fitroom/shop/v1/garment_service.grpc.pb.h"
#include "shop_catalog/service/publication.h"

namespace fitroom::shop_catalog {

// fitroom.shop.v1.GarmentService over a store. Handlers only check, call and convert. Quick work runs on the runtime's
// workers; extracting a garment takes a second and hundreds of megabytes, so one thread of its own does one at a time.
// Store and runtime must outlive the service, and the service the server.
class GarmentServiceImpl final : public shop::v1::GarmentService::CallbackService {
 public:
  GarmentServiceImpl(GarmentStore& store, GarmentExtractor extractor, rpc::CallRuntime& runtime);

  grpc::ServerUnaryReactor* StartGarmentUpload(grpc::CallbackServerContext* context,
                                               const shop::v1::StartGarmentUploadRequest* request,
                                               shop::v1::StartGarmentUploadResponse* response) override;
  grpc::ServerReadReactor<shop::v1::UploadPhotoRequest>* UploadPhoto(grpc::CallbackServerContext* context,
                                                                     shop::v1::UploadPhotoResponse* response) override;
  grpc::ServerUnaryReactor* GetGarmentUpload(grpc::CallbackServerContext* context,
                                             const shop::v1::GetGarmentUploadRequest* request,
                                             shop::v1::GetGarmentUploadResponse* response) override;
  grpc::ServerUnaryReactor* CancelGarmentUpload(grpc::CallbackServerContext* context,
                                                const shop::v1::CancelGarmentUploadRequest* request,
                                                shop::v1::CancelGarmentUploadResponse* response) override;
  grpc::ServerUnaryReactor* FinishGarmentUpload(grpc::CallbackServerContext* context,
                                                const shop::v1::FinishGarmentUploadRequest* request,
                                                shop::v1::FinishGarmentUploadResponse* response) override;
  grpc::ServerUnaryReactor* GetGarment(grpc::CallbackServerContext* context, const shop::v1::GetGarmentRequest* request,
                                       shop::v1::GetGarmentResponse* response) override;
  grpc::ServerUnaryReactor* ListGarments(grpc::CallbackServerContext* context,
                                         const shop::v1::ListGarmentsRequest* request,
                                         shop::v1::ListGarmentsResponse* response) override;
  grpc::ServerWriteReactor<shop::v1::DownloadImageResponse>* DownloadImage(
      grpc::CallbackServerContext* context, const shop::v1::DownloadImageRequest* request) override;

 private:
  GarmentStore& store_;
  const GarmentExtractor extractor_;
  rpc::CallRuntime& runtime_;
  rpc::WorkerPool extracting_{/*thread_count=*/1, /*queue_limit=*/16};
};

}  // namespace fitroom::shop_catalog
