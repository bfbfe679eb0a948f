#pragma once

#include <functional>
#include <string>
#include <vector>

#include <opencv2/core.hpp>

// Telling a garment from what it lies on. Several methods that fail in different ways each give a mask; where they
// agree the mask is trusted, and the caller may choose between them by the shape it looks for.
namespace fitroom::shop_catalog {

// One method's answer. Masks are CV_8U, 255 = garment, one connected region without holes.
struct MaskCandidate {
  std::string method;
  cv::Mat mask;
  double agreement = 0.0;   // Mean intersection over union with the other methods' masks, 0 to 1.
  double contrast = 0.0;    // Part of the outline across which colours differ visibly, 0 to 1.
  double frame_part = 0.0;  // Part of the outline that lies on the image's frame, 0 to 1.
};

// Returns the methods' masks of an RGB photograph at its own size, most trusted first; those that found nothing are
// left out. The dear methods are tried only where the cheap ones do not agree on a clear edge, or where `is_plausible`
// (asked at the methods' own small size) says that what they agree on does not look like the garment. Deterministic.
// Time is bounded by the methods' working size (400 pixels a side).
std::vector<MaskCandidate> SegmentGarment(const cv::Mat& rgb,
                                          const std::function<bool(const MaskCandidate&)>& is_plausible);

// Keeps the region that is most likely the garment (large and central), fills its holes, and removes threads and
// slivers thinner than `sliver` (unit: pixel). Returns an empty matrix where nothing is left.
cv::Mat CleanMask(const cv::Mat& mask, int sliver);

// Returns intersection over union of two masks of one size; 0 if both are empty.
double IntersectionOverUnion(const cv::Mat& a, const cv::Mat& b);

// Refines a mask to the photograph's own resolution: in a band along the mask's edge each pixel's coverage is
// estimated from the mean colours of garment and background near it. Returns coverage, CV_8U, 255 = garment; its level
// 128 is the outline. Where the colours do not differ, the smoothed mask decides.
cv::Mat RefineCoverage(const cv::Mat& rgb, const cv::Mat& mask);

}  // namespace fitroom::shop_catalog
