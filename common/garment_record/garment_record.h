#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "common/base/status.h"
#include "common/codec/hash.h"
#include "common/garment/garment.h"
#include "common/garment/shop_statement.h"

namespace fitroom {

enum class GarmentImageKind { kPhoto, kMask, kTexture, kExtraction };

// An image of a published garment, without its bytes.
struct GarmentImageRecord {
  GarmentImageKind kind = GarmentImageKind::kPhoto;
  GarmentSide side = GarmentSide::kFront;  // kFront for the extraction drawing.
  std::string file_name;                   // In the garment's folder.
  int64_t size = 0;                        // (unit: byte)
  Hash256 hash;

  friend bool operator==(const GarmentImageRecord&, const GarmentImageRecord&) = default;
};

// A published garment as a shop's catalog knows it.
struct GarmentRecord {
  Garment garment;
  std::vector<GarmentImageRecord> images;
  int64_t publish_time_unix_s = 0;
};

// Returns the image's id in its name: "front-photo", "back-mask", "side-folded-texture", …, "extraction".
std::string ImageId(GarmentImageKind kind, GarmentSide side);

// What a photograph is before its bytes are sent.
struct PhotoStatement {
  GarmentSide side = GarmentSide::kFront;
  int64_t size = 0;  // (unit: byte)
  Hash256 hash;

  friend bool operator==(const PhotoStatement&, const PhotoStatement&) = default;
};

// What a shop states before the photographs are sent. The same statement names the same upload.
struct GarmentUploadStatement {
  std::string id;     // [a-z0-9-]{1,63}
  std::string title;  // For people.
  GarmentKind kind = GarmentKind::kTShirt;
  double length = 0.0;  // (unit: metre)
  std::vector<PhotoStatement> photos;
  std::string annotation_json;  // Points set by hand; may be empty.
  ShopStatement stated;         // Fabric, size chart and measures by tape.

  friend bool operator==(const GarmentUploadStatement&, const GarmentUploadStatement&) = default;
};

// A publication that is under way.
struct GarmentUpload {
  std::string id;  // [a-z0-9-]{1,63}
  GarmentUploadStatement statement;
  std::vector<int64_t> committed_sizes;  // One for each stated photograph (unit: byte).
};

// Returns the place of a side among the stated photographs, if it is stated.
std::optional<size_t> FindPhoto(const GarmentUploadStatement& statement, GarmentSide side);

// The largest photograph (unit: byte), and the longest annotation (unit: byte).
inline constexpr int64_t kMaxPhotoSize = int64_t{20} << 20;
inline constexpr size_t kMaxAnnotationSize = size_t{256} << 10;

}  // namespace fitroom
