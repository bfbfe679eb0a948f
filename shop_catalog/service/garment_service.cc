#include "shop_catalog/service/garment_service.h"

#include <algorithm>
#include <utility>

#include "common/base/resource_name.h"
#include "common/remote/chunk.h"
#include "common/remote/shop_convert.h"

namespace fitroom::shop_catalog {

namespace v1 = shop::v1;  // The messages of this service.
using grpc::CallbackServerContext;
using grpc::ServerUnaryReactor;

namespace {

constexpr int kDefaultPageSize = 50;
constexpr int kMaxPageSize = 200;
constexpr size_t kCommitSize = size_t{4} << 20;  // What a stream collects before it is committed (unit: byte).

// Takes the chunks of one photograph's stream and commits them in groups.
class PhotoSink final : public rpc::MessageSink<v1::UploadPhotoRequest> {
 public:
  PhotoSink(GarmentStore& store, rpc::ByteBudget& budget, v1::UploadPhotoResponse* response)
      : store_(store), response_(response), loan_(budget) {}

  Result<int64_t> Accept(const v1::UploadPhotoRequest& request) override {
    FR_RETURN_IF_ERROR(CheckNames(request));
    const Status chunk_status = remote::CheckChunk(request.chunk(), NextOffset());
    if (!chunk_status.ok()) {
      FR_RETURN_IF_ERROR(Commit());  // What came before is whole.
      return chunk_status;
    }
    if (NextOffset() + std::ssize(request.chunk().data()) > stated_size_) {
      return Status(StatusCode::kOutOfRange, "UPLOAD_TOO_LONG", "more bytes than were stated at the start");
    }
    pending_ += request.chunk().data();
    // Where the budget of all streams is used up, a stream commits each chunk at once.
    const bool may_wait = loan_.TryTake(std::ssize(request.chunk().data()));
    if (!may_wait || pending_.size() >= kCommitSize) FR_RETURN_IF_ERROR(Commit());
    return std::ssize(request.chunk().data());
  }

  Status Finish() override {
    if (upload_.empty()) return InvalidArgument("UPLOAD_NAME_INVALID", "the stream named no upload");
    FR_RETURN_IF_ERROR(Commit());
    response_->set_committed_size_bytes(committed_size_);
    return Status();
  }

  void Cut() override { (void)Commit(); }

 private:
  int64_t NextOffset() const { return committed_size_ + std::ssize(pending_); }

  Status CheckNames(const v1::UploadPhotoRequest& request) {
    if (!upload_.empty()) {
      if (request.upload().empty() && request.side() == v1::GARMENT_SIDE_UNSPECIFIED) return Status();
      return InvalidArgument("UPLOAD_NAME_INVALID", "only the first message of a stream names upload and side");
    }
    FR_ASSIGN_OR_RETURN(const std::string id, remote::UploadIdFromShopName(request.upload()));
    FR_ASSIGN_OR_RETURN(side_, remote::SideFromProto(request.side()));
    FR_ASSIGN_OR_RETURN(const GarmentUpload upload, store_.FindUpload(id));
    const std::optional<size_t> photo = FindPhoto(upload.statement, side_);
    if (!photo) return InvalidArgument("PHOTO_NOT_STATED", "no photograph of that side was stated at the start");
    stated_size_ = upload.statement.photos[*photo].size;
    committed_size_ = upload.committed_sizes[*photo];
    upload_ = id;
    return Status();
  }

  Status Commit() {
    if (pending_.empty()) return Status();
    const std::string bytes = std::exchange(pending_, {});
    loan_.GiveBackAll();
    FR_ASSIGN_OR_RETURN(committed_size_, store_.AppendToUpload(upload_, side_, committed_size_, bytes));
    return Status();
  }

  GarmentStore& store_;
  v1::UploadPhotoResponse* const response_;
  std::string upload_;
  GarmentSide side_ = GarmentSide::kFront;
  int64_t stated_size_ = 0;
  int64_t committed_size_ = 0;
  std::string pending_;
  rpc::ByteLoan loan_;
};

// Makes the chunks of one image, out of the store's rows.
class ImageSource final : public rpc::MessageSource<v1::DownloadImageResponse> {
 public:
  ImageSource(GarmentStore& store, const v1::DownloadImageRequest& request) : store_(store), request_(request) {}

  Result<int64_t> Next(v1::DownloadImageResponse& response) override {
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
    if (name_.garment.empty()) {
      FR_ASSIGN_OR_RETURN(name_, remote::ImageNameFrom(request_.name()));
      offset_ = request_.offset_bytes();
      if (offset_ < 0) return Status(StatusCode::kOutOfRange, "OFFSET_PAST_END", "offset_bytes: below 0");
    }
    used_ = 0;
    FR_ASSIGN_OR_RETURN(row_, store_.ReadImage(name_.garment, name_.image, offset_));
    return Status();
  }

  GarmentStore& store_;
  const v1::DownloadImageRequest request_;
  remote::ImageName name_;
  int64_t offset_ = 0;
  std::string row_;
  size_t used_ = 0;
};

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
  return new rpc::SinkReactor<v1::UploadPhotoRequest>(context, runtime_, "UploadPhoto",
                                                      std::make_unique<PhotoSink>(store_, runtime_.bytes, response));
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
    if (request->page_size() < 0) return InvalidArgument("PAGE_SIZE_INVALID", "page_size: below 0");
    const int page_size =
        request->page_size() == 0 ? kDefaultPageSize : std::min(int{request->page_size()}, kMaxPageSize);
    // One more than the page tells whether there is a next one.
    FR_ASSIGN_OR_RETURN(std::vector<GarmentRecord> records, store_.ListGarments(after, page_size + 1));
    if (std::ssize(records) > page_size) {
      records.pop_back();
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
  return new rpc::SourceReactor<v1::DownloadImageResponse>(context, runtime_, "DownloadImage",
                                                           std::make_unique<ImageSource>(store_, *request));
}

}  // namespace fitroom::shop_catalog
