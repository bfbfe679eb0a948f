#include "shop_catalog/service/publication.h"

#include <array>
#include <ctime>
#include <utility>

#include "common/garment/validate.h"
#include "common/image/decode.h"

namespace fitroom::shop_catalog {
namespace {

// A photograph that the catalog takes in must not be refused for its size once all of it has been sent.
static_assert(static_cast<size_t>(kMaxPhotoSize) == ImageLimits{}.max_bytes);

// An extractor's error that another try with the same bytes would meet again.
bool IsFinal(const Status& status) {
  return status.code() != StatusCode::kCancelled && status.code() != StatusCode::kUnavailable &&
         status.code() != StatusCode::kInternal;
}

// The photographs by side; empty where none is stated.
struct PhotoBytes {
  std::array<std::string, kGarmentSideCount> by_side;

  const std::string& at(GarmentSide side) const { return by_side[static_cast<size_t>(side)]; }
};

Result<PhotoBytes> ReadPhotos(GarmentStore& store, const GarmentUpload& upload) {
  PhotoBytes photos;
  for (const PhotoStatement& photo : upload.statement.photos) {
    FR_ASSIGN_OR_RETURN(photos.by_side[static_cast<size_t>(photo.side)], store.ReadUpload(upload.id, photo.side));
  }
  return photos;
}

Result<GarmentExtraction> CheckAndExtract(const GarmentExtractor& extractor, const GarmentUploadStatement& statement,
                                          const PhotoBytes& photos, const std::function<bool()>& is_cancelled) {
  for (const PhotoStatement& photo : statement.photos) {
    const std::string& bytes = photos.at(photo.side);
    if (std::ssize(bytes) != photo.size || Blake2b(bytes) != photo.hash) {
      return DataLoss("UPLOAD_HASH_MISMATCH", "what arrived is not the photograph that was stated; publish it again");
    }
  }
  ExtractionRequest request;
  request.id = statement.id;
  request.title = statement.title;
  request.kind = statement.kind;
  request.length = statement.length;
  request.front_photo = photos.at(GarmentSide::kFront);
  request.back_photo = photos.at(GarmentSide::kBack);
  request.side_folded_photo = photos.at(GarmentSide::kSideFolded);
  request.statement = &statement.stated;
  request.is_cancelled = is_cancelled;
  PointAnnotation annotation;
  if (!statement.annotation_json.empty()) {
    Result<PointAnnotation> read = PointAnnotationFromJson(statement.annotation_json, statement.kind);
    if (!read.ok()) return read.status().At("annotation");
    annotation = std::move(read).value();
    request.annotation = &annotation;
  }
  FR_ASSIGN_OR_RETURN(GarmentExtraction extraction, extractor(request));
  if (!request.side_folded_photo.empty() && !extraction.garment.side_folded) {
    return Internal("SIDE_FOLDED_MISSING", "the extraction gave no side-folded view");
  }
  ApplyShopStatement(statement.stated, extraction.garment);
  FR_RETURN_IF_ERROR(ValidateGarment(extraction.garment));
  return extraction;
}

void DescribeImages(const GarmentView& view, std::vector<GarmentImageRecord>& images) {
  images.push_back({GarmentImageKind::kPhoto, view.side, view.photo_file, 0, {}});
  images.push_back({GarmentImageKind::kMask, view.side, view.mask_file, 0, {}});
  images.push_back({GarmentImageKind::kTexture, view.side, view.texture_file, 0, {}});
}

// Says which file is what. A file that no view names is the drawing of what was found.
Result<GarmentRecord> MakeRecord(const GarmentExtraction& extraction) {
  GarmentRecord record;
  record.garment = extraction.garment;
  record.publish_time_unix_s = std::time(nullptr);
  DescribeImages(record.garment.front, record.images);
  if (record.garment.back) DescribeImages(*record.garment.back, record.images);
  if (record.garment.side_folded) DescribeImages(*record.garment.side_folded, record.images);
  for (const GarmentFile& file : extraction.files) {
    bool is_named = false;
    for (GarmentImageRecord& image : record.images) {
      if (image.file_name != file.name) continue;
      is_named = true;
      image.size = std::ssize(file.bytes);
      image.hash = Blake2b(file.bytes);
    }
    if (is_named) continue;
    record.images.push_back(
        {GarmentImageKind::kExtraction, GarmentSide::kFront, file.name, std::ssize(file.bytes), Blake2b(file.bytes)});
  }
  for (const GarmentImageRecord& image : record.images) {
    if (image.size == 0) return Internal("IMAGE_MISSING", "the extraction gave no " + image.file_name);
  }
  return record;
}

}  // namespace

Result<GarmentRecord> FinishPublication(GarmentStore& store, const GarmentExtractor& extractor,
                                        std::string_view upload_id, const std::function<bool()>& is_cancelled) {
  FR_ASSIGN_OR_RETURN(const GarmentUpload upload, store.FindUpload(upload_id));
  for (size_t i = 0; i < upload.committed_sizes.size(); ++i) {
    if (upload.committed_sizes[i] == upload.statement.photos[i].size) continue;
    return FailedPrecondition("UPLOAD_INCOMPLETE", "bytes are missing; ask how far the upload is and go on from there");
  }
  // What the store itself fails at is no fault of the photographs: the upload stays.
  FR_ASSIGN_OR_RETURN(const PhotoBytes photos, ReadPhotos(store, upload));
  const Result<GarmentExtraction> extraction = CheckAndExtract(extractor, upload.statement, photos, is_cancelled);
  if (!extraction.ok()) {
    if (IsFinal(extraction.status())) FR_RETURN_IF_ERROR(store.DropUpload(upload_id));
    return extraction.status();
  }
  FR_ASSIGN_OR_RETURN(GarmentRecord record, MakeRecord(*extraction));
  FR_RETURN_IF_ERROR(store.PublishGarment(upload_id, record, extraction->files));
  return record;
}

}  // namespace fitroom::shop_catalog
