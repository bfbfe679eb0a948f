#pragma once

#include <functional>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "common/base/progress.h"
#include "common/garment_record/garment_record.h"

namespace fitroom::remote {

// One page of garments, without outlines and points; an empty token ends the list.
struct GarmentPage {
  std::vector<GarmentRecord> garments;
  std::string next_page_token;
};

// Speaks to a shop's catalog. Thread-safe. Every call has a deadline; calls that may be repeated are, with growing
// pauses. Beside the server's own errors (fitroom/shop/v1/garment_service.proto) any call may return UNAVAILABLE
// [SERVER_UNAVAILABLE], [STREAM_CUT] or DEADLINE_EXCEEDED. Nothing that it sends says anything about a person.
class ShopClient {
 public:
  // `address` is HOST:PORT. Connects with the first call. `attempt_count` is how often a call is tried in all.
  explicit ShopClient(const std::string& address, int attempt_count = 5);
  ShopClient(const ShopClient&) = delete;
  ShopClient& operator=(const ShopClient&) = delete;
  ~ShopClient();

  // Publishes a garment and returns it. `photos` are the bytes, in the order of the statement. Goes on with an upload
  // that an earlier call left, and after a cut. A garment that is there already with the same photographs, kind,
  // length, fabric, measures and size chart is returned as it is.
  Result<GarmentRecord> Publish(const GarmentUploadStatement& statement, const std::vector<std::string_view>& photos,
                                const ProgressSink& progress);

  // The steps of Publish().
  Result<GarmentUpload> StartUpload(const GarmentUploadStatement& statement);
  Result<GarmentUpload> GetUpload(const GarmentUpload& upload);
  Result<int64_t> SendBytes(const GarmentUpload& upload, GarmentSide side, int64_t offset, std::string_view bytes);
  Result<GarmentRecord> FinishUpload(const GarmentUpload& upload);
  Status CancelUpload(const GarmentUpload& upload);

  Result<GarmentRecord> GetGarment(std::string_view id);
  Result<GarmentPage> ListGarments(int page_size, const std::string& page_token);
  // Goes through all pages.
  Result<std::vector<GarmentRecord>> ListAllGarments();

  // Hands an image (ImageId()) from `offset` on to `sink`, piece by piece; goes on by itself after a cut. An error of
  // `sink` ends it. The hash of the whole is the caller's to check.
  Status DownloadImage(std::string_view garment, std::string_view image, int64_t offset,
                       const std::function<Status(std::string_view)>& sink);

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace fitroom::remote
