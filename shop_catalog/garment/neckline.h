#pragma once

#include <opencv2/core.hpp>

#include "common/garment/polygon.h"
#include "shop_catalog/garment/top_corners.h"

namespace fitroom::shop_catalog {

// The neckline of the front as seen in a photograph, from the neck end on the image's left to the one on its right.
struct Neckline {
  enum class Source {
    kSilhouette,  // The silhouette's own edge: nothing of the back neck's inside shows.
    kCollarEdge,  // The edge of the front collar, found in the picture below the visible inside of the back neck.
    kEstimated,   // No edge was found; an arc of usual depth.
  };
  Source source = Source::kSilhouette;
  Polygon curve;  // Open; both neck ends included.
  double confidence = 0.0;
};

// Finds the front neckline in a photograph (Lab, 32-bit floats): among smooth arcs between the neck ends, from a V to a
// round U, the one along which the picture has the clearest edge of one kind (lighter below, darker below, or any
// change of colour), then followed closely. `outline` is the silhouette, clockwise.
Neckline FindFrontNeckline(const cv::Mat& lab, const Polygon& outline, const TopCorners& corners);

// Returns the part of the silhouette between the neck ends: the neckline of a back view.
Neckline SilhouetteNeckline(const Polygon& outline, const TopCorners& corners);

// Returns a smooth arc through both neck ends and a lowest point that is given.
Polygon NecklineThrough(const Eigen::Vector2d& left, const Eigen::Vector2d& lowest, const Eigen::Vector2d& right);

}  // namespace fitroom::shop_catalog
