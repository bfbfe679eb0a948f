#pragma once

#include <string>
#include <string_view>

#include <opencv2/core.hpp>

#include "common/base/status.h"
#include "common/garment/garment.h"
#include "common/garment/polygon.h"
#include "common/image/image.h"

namespace fitroom::shop_catalog {

// A photograph upright and, where it is very large, scaled down.
struct WorkingImage {
  Image rgb;
  cv::Mat alpha;       // Empty where the photograph has none or it hides nothing.
  double scale = 1.0;  // Working pixels per pixel of the photograph.
};

// Fails as DecodeImage() does.
Result<WorkingImage> LoadWorkingImage(std::string_view bytes);

// A mask with the outline it leads to.
struct Silhouette {
  cv::Mat coverage;
  Polygon outline;
  double frame_part = 0.0;  // Of the outline that lies on the image's frame.
  double confidence = 0.0;  // 0 to 1.
  std::string source;
};

// What a silhouette may be asked to look like.
using ShapeCost = double (*)(const Polygon& outline, GarmentKind kind);

// Finds the garment's silhouette, the one among the methods' proposals that is shaped most like the kind: `cost` says
// how much, 0 for a perfect likeness.
Silhouette FindSilhouette(const WorkingImage& image, GarmentKind kind, ShapeCost cost);

// FAILED_PRECONDITION NO_GARMENT_FOUND or GARMENT_CROPPED.
Status CheckSilhouette(const Silhouette& silhouette, cv::Size size);

inline constexpr double kLeastMaskConfidence = 0.35;
// Of a corner chain, per corner, seen on the external test photographs: the right kind 0.2 to 2.5, others mostly above.
inline constexpr double kGoodShape = 1.5;

}  // namespace fitroom::shop_catalog
