#include "common/remote/shop_client.h"

#include <algorithm>
#include <iterator>

#include "common/remote/list_all.h"
#include "common/remote/shop_convert.h"
#include "common/rpc/client.h"
#include "common/transfer/service_caller.h"
#include "fitroom/shop/v1/garment_service.grpc.pb.h"

namespace fitroom::remote {

using shop::v1::GarmentService;

namespace {

bool IsAsStated(const Garment& garment, const ShopStatement& stated) {
  const auto is_kept = [&](const GarmentMeasure& measure) {
    const GarmentMeasure* known = FindMeasure(garment.measures, measure.name);
    return known != nullptr && *known == measure;
  };
  return garment.fabric == stated.fabric && garment.chart == stated.chart &&
         std::all_of(stated.measures.begin(), stated.measures.end(), is_kept);
}

}  // namespace

struct ShopClient::Impl {
  transfer::ServiceCaller<GarmentService> caller;
};

ShopClient::ShopClient(const std::string& address, int attempt_count)
    : impl_(new Impl{{"shop at " + address, address, attempt_count}}) {}

ShopClient::~ShopClient() = default;

Result<GarmentUpload> ShopClient::StartUpload(const GarmentUploadStatement& statement) {
  shop::v1::StartGarmentUploadRequest request;
  ToProto(statement, request);
  shop::v1::StartGarmentUploadResponse response;
  FR_RETURN_IF_ERROR(impl_->caller.Call(&GarmentService::Stub::StartGarmentUpload, request, response, rpc::kQuickCall));
  return UploadFromProto(response.upload(), statement);
}

Result<GarmentUpload> ShopClient::GetUpload(const GarmentUpload& upload) {
  shop::v1::GetGarmentUploadRequest request;
  request.set_name(UploadName(upload));
  shop::v1::GetGarmentUploadResponse response;
  FR_RETURN_IF_ERROR(impl_->caller.Call(&GarmentService::Stub::GetGarmentUpload, request, response, rpc::kQuickCall));
  return UploadFromProto(response.upload(), upload.statement);
}

Result<int64_t> ShopClient::SendBytes(const GarmentUpload& upload, GarmentSide side, int64_t offset,
                                      std::string_view bytes) {
  shop::v1::UploadPhotoRequest first;
  first.set_upload(UploadName(upload));
  first.set_side(ToProto(side));
  return impl_->caller.Send(&GarmentService::Stub::UploadPhoto, std::move(first), offset, bytes, /*progress=*/{});
}

Result<GarmentRecord> ShopClient::FinishUpload(const GarmentUpload& upload) {
  shop::v1::FinishGarmentUploadRequest request;
  request.set_name(UploadName(upload));
  shop::v1::FinishGarmentUploadResponse response;
  FR_RETURN_IF_ERROR(impl_->caller.Call(&GarmentService::Stub::FinishGarmentUpload, request, response, rpc::kLongCall));
  return GarmentRecordFromProto(response.garment());
}

Status ShopClient::CancelUpload(const GarmentUpload& upload) {
  shop::v1::CancelGarmentUploadRequest request;
  request.set_name(UploadName(upload));
  shop::v1::CancelGarmentUploadResponse response;
  return impl_->caller.Call(&GarmentService::Stub::CancelGarmentUpload, request, response, rpc::kQuickCall);
}

Result<GarmentRecord> ShopClient::Publish(const GarmentUploadStatement& statement,
                                          const std::vector<std::string_view>& photos, const ProgressSink& progress) {
  // The garment as it stands, if it is the stated one: an acknowledgement may have been lost on its way.
  const auto find_published = [&]() -> Result<GarmentRecord> {
    FR_ASSIGN_OR_RETURN(GarmentRecord record, GetGarment(statement.id));
    bool is_same = record.garment.kind == statement.kind && record.garment.length == statement.length &&
                   IsAsStated(record.garment, statement.stated);
    for (const PhotoStatement& photo : statement.photos) {
      is_same =
          is_same && std::any_of(record.images.begin(), record.images.end(), [&](const GarmentImageRecord& image) {
            return image.kind == GarmentImageKind::kPhoto && image.side == photo.side && image.hash == photo.hash;
          });
    }
    if (is_same) return record;
    return Status(StatusCode::kAlreadyExists, "GARMENT_EXISTS",
                  GarmentName(statement.id) + " is another garment; choose another id");
  };
  Result<GarmentUpload> started = StartUpload(statement);
  if (!started.ok()) {
    return started.status().reason() == "GARMENT_EXISTS" ? find_published() : Result<GarmentRecord>(started.status());
  }
  for (size_t i = 0; i < photos.size(); ++i) {
    if (progress) progress("sending", static_cast<double>(i) / static_cast<double>(photos.size()));
    FR_RETURN_IF_ERROR(rpc::RetryTransient(impl_->caller.retries(), [&]() -> Status {
      // Where the upload stands is the server's to say.
      FR_ASSIGN_OR_RETURN(const GarmentUpload now, GetUpload(*started));
      const int64_t offset = now.committed_sizes[i];
      if (offset == statement.photos[i].size) return Status();
      return SendBytes(*started, statement.photos[i].side, offset, photos[i].substr(static_cast<size_t>(offset)))
          .status();
    }));
  }
  if (progress) progress("extracting", 1.0);
  Result<GarmentRecord> finished = FinishUpload(*started);
  if (!finished.ok() && finished.status().reason() == "UPLOAD_NOT_FOUND") return find_published();
  return finished;
}

Result<GarmentRecord> ShopClient::GetGarment(std::string_view id) {
  shop::v1::GetGarmentRequest request;
  request.set_name(GarmentName(id));
  shop::v1::GetGarmentResponse response;
  FR_RETURN_IF_ERROR(impl_->caller.Call(&GarmentService::Stub::GetGarment, request, response, rpc::kQuickCall));
  return GarmentRecordFromProto(response.garment());
}

Result<GarmentPage> ShopClient::ListGarments(int page_size, const std::string& page_token) {
  shop::v1::ListGarmentsRequest request;
  request.set_page_size(page_size);
  request.set_page_token(page_token);
  shop::v1::ListGarmentsResponse response;
  FR_RETURN_IF_ERROR(impl_->caller.Call(&GarmentService::Stub::ListGarments, request, response, rpc::kQuickCall));
  GarmentPage page;
  page.next_page_token = response.next_page_token();
  for (const shop::v1::Garment& message : response.garments()) {
    FR_ASSIGN_OR_RETURN(GarmentRecord record, GarmentRecordFromProto(message));
    page.garments.push_back(std::move(record));
  }
  return page;
}

Result<std::vector<GarmentRecord>> ShopClient::ListAllGarments() {
  return ListAll<GarmentRecord>([&](const std::string& token) -> Result<ListPage<GarmentRecord>> {
    FR_ASSIGN_OR_RETURN(GarmentPage page, ListGarments(/*page_size=*/200, token));
    return ListPage<GarmentRecord>{std::move(page.garments), std::move(page.next_page_token)};
  });
}

Status ShopClient::DownloadImage(std::string_view garment, std::string_view image, int64_t offset,
                                 const std::function<Status(std::string_view)>& sink) {
  shop::v1::DownloadImageRequest request;
  request.set_name(ToString(ImageName{std::string(garment), std::string(image)}));
  return impl_->caller.Receive(&GarmentService::Stub::DownloadImage, std::move(request), offset, sink);
}

}  // namespace fitroom::remote
