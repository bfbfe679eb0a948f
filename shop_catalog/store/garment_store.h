#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "common/garment/garment_folder.h"
#include "common/garment_record/garment_record.h"

namespace fitroom::shop_catalog {

// Keeps garments and uploads durably. Thread-safe.
//
// An upload belongs to nobody's view: only PublishGarment() makes a garment, all of it in one step. When a call returns
// OK its effect survives the death of the process and of the machine. When it returns an error nothing has changed.
// Beside the errors named below any call may return the engine's: RESOURCE_EXHAUSTED [DISK_FULL], DATA_LOSS
// [DATABASE_CORRUPT], UNAVAILABLE [DATABASE_IO].
class GarmentStore {
 public:
  virtual ~GarmentStore() = default;

  // Starts an upload, or finds the one with the same statement. ALREADY_EXISTS [GARMENT_EXISTS];
  // FAILED_PRECONDITION [UPLOAD_DIFFERS] if another statement is under way under that name.
  virtual Result<GarmentUpload> StartUpload(const GarmentUploadStatement& statement) = 0;

  // NOT_FOUND [UPLOAD_NOT_FOUND].
  virtual Result<GarmentUpload> FindUpload(std::string_view id) = 0;

  // Appends bytes of one photograph at `offset` and returns its new committed size. ABORTED [UPLOAD_OFFSET_CONFLICT] if
  // `offset` is not the committed size; OUT_OF_RANGE [UPLOAD_TOO_LONG]; NOT_FOUND [UPLOAD_NOT_FOUND]; INVALID_ARGUMENT
  // [PHOTO_NOT_STATED].
  virtual Result<int64_t> AppendToUpload(std::string_view id, GarmentSide side, int64_t offset,
                                         std::string_view bytes) = 0;

  // Returns all bytes that an upload holds of one photograph. Errors as AppendToUpload().
  virtual Result<std::string> ReadUpload(std::string_view id, GarmentSide side) = 0;

  // Drops an upload and its bytes; OK if there is none.
  virtual Status DropUpload(std::string_view id) = 0;

  // Drops uploads that got their last bytes before `unix_s`; returns how many.
  virtual Result<int64_t> DropUploadsBefore(int64_t unix_s) = 0;

  // Turns a complete upload into a published garment. `files` holds the bytes of all `record.images`, by file name; the
  // photographs are taken from it too. NOT_FOUND [UPLOAD_NOT_FOUND]; FAILED_PRECONDITION [UPLOAD_INCOMPLETE];
  // ALREADY_EXISTS [GARMENT_EXISTS].
  virtual Status PublishGarment(std::string_view upload_id, const GarmentRecord& record,
                                std::span<const GarmentFile> files) = 0;

  // NOT_FOUND [GARMENT_NOT_FOUND].
  virtual Result<GarmentRecord> FindGarment(std::string_view id) = 0;

  // Returns at most `limit` garments behind the id `after`, in the order of ids.
  virtual Result<std::vector<GarmentRecord>> ListGarments(std::string_view after, int limit) = 0;

  // Returns bytes of an image (ImageId()) from `offset` on: at least 1, at most 1 MiB; none at the end.
  // NOT_FOUND [IMAGE_NOT_FOUND]; OUT_OF_RANGE [OFFSET_PAST_END].
  virtual Result<std::string> ReadImage(std::string_view garment, std::string_view image, int64_t offset) = 0;
};

}  // namespace fitroom::shop_catalog
