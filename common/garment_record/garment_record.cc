#include "common/garment_record/garment_record.h"

#include <algorithm>

namespace fitroom {

std::string ImageId(GarmentImageKind kind, GarmentSide side) {
  std::string prefix(GarmentSideName(side));
  std::replace(prefix.begin(), prefix.end(), '_', '-');  // An id holds no '_'.
  prefix += '-';
  switch (kind) {
    case GarmentImageKind::kPhoto:
      return prefix + "photo";
    case GarmentImageKind::kMask:
      return prefix + "mask";
    case GarmentImageKind::kTexture:
      return prefix + "texture";
    case GarmentImageKind::kExtraction:
      break;
  }
  return "extraction";
}

std::optional<size_t> FindPhoto(const GarmentUploadStatement& statement, GarmentSide side) {
  for (size_t i = 0; i < statement.photos.size(); ++i) {
    if (statement.photos[i].side == side) return i;
  }
  return std::nullopt;
}

}  // namespace fitroom
