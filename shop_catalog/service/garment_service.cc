#include "shop_catalog/service/garment_service.h"

#include <utility>

#include "common/remote/shop_convert.h"
#include "common/transfer/download_source.h"
#include "common/transfer/page.h"
#include "common/transfer/upload_sink.h"

namespace fitroom::shop_catalog {

namespace v1 = shop::v1;  // The messages of this service.
using grpc::CallbackServerContext;
using grpc::ServerUnaryReactor;

namespace {

constexpr size_t kCommitSize = size_t{4} << 20;  // What a stream collects before it is committed (unit: byte).

using PhotoSink = transfer::UploadSink<v1::UploadPhotoRequest, v1::UploadPhotoResponse>;
using ImageSource = transfer::DownloadSource<v1::DownloadImageRequest, v1::DownloadImageResponse>;

Result<transfer::OpenUpload> OpenPhoto(GarmentStore& store, const v1::UploadPhotoRequest& first) {
  FR_ASSIGN_OR_RETURN(const std::string id, remote::UploadIdFromShopName(first.upload()));
  FR_ASSIGN_OR_RETURN(const GarmentSide side, remote::SideFromProto(first.side()));
  FR_ASSIGN_OR_RETURN(const GarmentUpload upload, store.FindUpload(id));
  const std::optional<size_t> photo = FindPhoto(upload.statement, side);
  if (!photo) return InvalidArgument("PHOTO_NOT_STATED", "no photograph of that side was stated at the start");
  return transfer::OpenUpload{upload.statement.photos[*photo].size, upload.committed_sizes[*photo],
                              [&store, id, side](int64_t offset, std::string_view bytes) {
                                return store.AppendToUpload(id, side, offset, bytes);
                              }};
}

bool NamesPhoto(const v1::UploadPhotoRequest& request) {
  return !request.upload().empty() || request.side() != v1::GARMENT_SIDE_UNSPECIFIED;
}

Result<ImageSource::Read> OpenImage(GarmentStore& store, const v1::DownloadImageRequest& request) {
  FR_ASSIGN_OR_RETURN(const remote::ImageName name, remote::ImageNameFrom(request.name()));
  return ImageSource::Read(
      [&store, name](int64_t offset) { return store.ReadImage(name.garment, name.image, offset); });
}

// A page token is the name of the last garment of the page before.
Result<std::string> AfterFromToken(const std::string& token) {
  if (token.empty()) return token;
  Result<std::string> after = remote::GarmentIdFromName(token);
  if (!after.ok()) return InvalidArgument("PAGE_TOKEN_INVALID", "page_token: not one of this service");
  return after;
}

}  // namespace

GarmentServiceImpl::GarmentServiceImpl(GarmentStore& store, GarmentExtractor extractor, rpc::CallRuntime& runtime)
    : store_(store), extractor_(std::move(extractor)), runtime_(runtime) {}

ServerUnaryReactor* GarmentServiceImpl::StartGarmentUpload(CallbackServerContext* context,
                                                           const v1::StartGarmentUploadRequest* request,
                                                           v1::StartGarmentUploadResponse* response) {
  return rpc::RunUnary(context, runtime_.workers, "StartGarmentUpload", [this, request, response]() -> Status {
    FR_ASSIGN_OR_RETURN(const GarmentUploadStatement statement, remote::StatementFromProto(*request));
    FR_ASSIGN_OR_RETURN(const GarmentUpload upload, store_.StartUpload(statement));
    remote::ToProto(upload, *response->mutable_upload());
    return Status();
  });
}

grpc::ServerReadReactor<v1::UploadPhotoRequest>* GarmentServiceImpl::UploadPhoto(CallbackServerContext* context,
                                                                                 v1::UploadPhotoResponse* response) {
  const auto open = [this](const v1::UploadPhotoRequest& first) { return OpenPhoto(store_, first); };
  return new rpc::SinkReactor<v1::UploadPhotoRequest>(
      context, runtime_, "UploadPhoto",
      std::make_unique<PhotoSink>(open, NamesPhoto, runtime_.bytes, kCommitSize, response));
}

ServerUnaryReactor* GarmentServiceImpl::GetGarmentUpload(CallbackServerContext* context,
                                                         const v1::GetGarmentUploadRequest* request,
                                                         v1::GetGarmentUploadResponse* response) {
  return rpc::RunUnary(context, runtime_.workers, "GetGarmentUpload", [this, request, response]() -> Status {
    FR_ASSIGN_OR_RETURN(const std::string id, remote::UploadIdFromShopName(request->name()));
    FR_ASSIGN_OR_RETURN(const GarmentUpload upload, store_.FindUpload(id));
    remote::ToProto(upload, *response->mutable_upload());
    return Status();
  });
}

ServerUnaryReactor* GarmentServiceImpl::CancelGarmentUpload(CallbackServerContext* context,
                                                            const v1::CancelGarmentUploadRequest* request,
                                                            v1::CancelGarmentUploadResponse*) {
  return rpc::RunUnary(context, runtime_.workers, "CancelGarmentUpload", [this, request]() -> Status {
    FR_ASSIGN_OR_RETURN(const std::string id, remote::UploadIdFromShopName(request->name()));
    return store_.DropUpload(id);
  });
}

ServerUnaryReactor* GarmentServiceImpl::FinishGarmentUpload(CallbackServerContext* context,
                                                            const v1::FinishGarmentUploadRequest* request,
                                                            v1::FinishGarmentUploadResponse* response) {
  return rpc::RunUnary(context, extracting_, "FinishGarmentUpload", [this, context, request, response]() -> Status {
    FR_ASSIGN_OR_RETURN(const std::string id, remote::UploadIdFromShopName(request->name()));
    FR_ASSIGN_OR_RETURN(const GarmentRecord record,
                        FinishPublication(store_, extractor_, id, [context] { return context->IsCancelled(); }));
    remote::ToProto(record, *response->mutable_garment());
    return Status();
  });
}

ServerUnaryReactor* GarmentServiceImpl::GetGarment(CallbackServerContext* context, const v1::GetGarmentRequest* request,
                                                   v1::GetGarmentResponse* response) {
  return rpc::RunUnary(context, runtime_.workers, "GetGarment", [this, request, response]() -> Status {
    FR_ASSIGN_OR_RETURN(const std::string id, remote::GarmentIdFromName(request->name()));
    FR_ASSIGN_OR_RETURN(const GarmentRecord record, store_.FindGarment(id));
    remote::ToProto(record, *response->mutable_garment());
    return Status();
  });
}

ServerUnaryReactor* GarmentServiceImpl::ListGarments(CallbackServerContext* context,
                                                     const v1::ListGarmentsRequest* request,
                                                     v1::ListGarmentsResponse* response) {
  return rpc::RunUnary(context, runtime_.workers, "ListGarments", [this, request, response]() -> Status {
    FR_ASSIGN_OR_RETURN(const std::string after, AfterFromToken(request->page_token()));
    FR_ASSIGN_OR_RETURN(const int page_size, transfer::PageSize(request->page_size()));
    // One more than the page tells whether there is a next one.
    FR_ASSIGN_OR_RETURN(std::vector<GarmentRecord> records, store_.ListGarments(after, page_size + 1));
    if (transfer::CutToPage(records, page_size)) {
      response->set_next_page_token(remote::GarmentName(records.back().garment.id));
    }
    for (const GarmentRecord& record : records) {
      v1::Garment* garment = response->add_garments();
      remote::ToProto(record, *garment);
      for (v1::GarmentView& view : *garment->mutable_views()) {
        view.clear_outline_xy_px();
        view.clear_points();
      }
      if (!garment->has_chart()) continue;
      for (v1::GarmentSize& size : *garment->mutable_chart()->mutable_sizes()) {
        size.clear_measures();
        size.clear_cut_for();
      }
    }
    return Status();
  });
}

grpc::ServerWriteReactor<v1::DownloadImageResponse>* GarmentServiceImpl::DownloadImage(
    CallbackServerContext* context, const v1::DownloadImageRequest* request) {
  const auto open = [this](const v1::DownloadImageRequest& asked) { return OpenImage(store_, asked); };
  return new rpc::SourceReactor<v1::DownloadImageResponse>(context, runtime_, "DownloadImage",
                                                           std::make_unique<ImageSource>(*request, open));
}

}  // namespace fitroom::shop_catalog
