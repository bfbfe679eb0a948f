#pragma once

#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "common/base/status.h"
#include "common/garment/garment.h"
#include "common/garment/garment_folder.h"
#include "common/garment/garment_json.h"
#include "common/garment/shop_statement.h"

namespace fitroom::shop_catalog {

// Everything a shop states about a garment; views of bytes must outlive the call.
struct ExtractionRequest {
  std::string id;     // [a-z0-9-]{1,63}
  std::string title;  // For people; may be empty.
  GarmentKind kind = GarmentKind::kTShirt;
  double length = 0.0;                          // From neck ends or waist to the hem, flat (unit: metre).
  std::string_view front_photo;                 // JPEG, PNG or WebP, as received.
  std::string_view back_photo;                  // Empty: the garment has no back view.
  std::string_view side_folded_photo = {};      // Of a bottom with legs; empty: none.
  const PointAnnotation* annotation = nullptr;  // Points given by hand, used instead of detected ones where present.
  const ShopStatement* statement = nullptr;     // Fabric, size chart and measures by tape; may be null.
  // Polled between the steps; true ends the extraction with CANCELLED. May be empty.
  std::function<bool()> is_cancelled;
};

// How sure one view's mask and points are.
struct ViewConfidence {
  double mask = 0.0;          // 0 to 1: agreement between independent segmentations; 1 for an alpha channel.
  double points = 0.0;        // 0 to 1: mean over the points.
  std::string weakest_point;  // Its name, empty where all points were given by hand.
  double weakest = 0.0;       // 0 to 1.
  std::string mask_source;    // "alpha", "background", "grabcut", …: for people and logs.
};

// What the photographs gave: a valid garment and all the files that belong to its folder (photographs as received,
// masks, textures, and the drawing "extraction.png").
struct GarmentExtraction {
  Garment garment;
  std::vector<GarmentFile> files;
  ViewConfidence front;
  std::optional<ViewConfidence> back;
  std::optional<ViewConfidence> side_folded;
};

// Finds mask, outline, points, scale and measures of a garment of any kind in its photographs. A one_piece is returned
// as one_piece_sleeved where it has sleeves. What folding hides of a bottom with legs is unknown unless it is stated or
// a side-folded photograph shows it. Thread-safe; one core; about a second a pair, at most about 400 MB for the largest
// allowed photographs.
//
// Refuses with a reason and a remedy: what DecodeImage() says of each photograph; INVALID_ARGUMENT LENGTH_MISSING,
// LENGTH_OUT_OF_RANGE (by kind), PHOTO_MISSING, SIDE_FOLDED_WITHOUT_LEGS, IMAGE_TOO_SMALL, POINT_… and POINTS_SWAPPED
// for an annotation; FAILED_PRECONDITION NO_GARMENT_FOUND, GARMENT_CROPPED, WRONG_KIND, NOT_SIDE_FOLDED,
// VIEWS_DO_NOT_MATCH, CHART_DOES_NOT_MATCH, LOW_CONFIDENCE; CANCELLED; what ValidateGarment() says of a chart.
Result<GarmentExtraction> ExtractGarment(const ExtractionRequest& request);

}  // namespace fitroom::shop_catalog
