#pragma once

#include <string>
#include <string_view>

#include "common/base/status.h"
#include "common/garment/garment.h"
#include "common/garment/shop_statement.h"

namespace fitroom {

// Writes a garment as JSON (format "fitroom.garment", version 2; lengths in cm, scale in mm a pixel). Numbers come back
// bit for bit up to the change of unit. The same garment gives the same text.
std::string GarmentToJson(const Garment& garment);

// Reads and validates a garment of version 1 or 2. INVALID_ARGUMENT GARMENT_JSON (with the place) where the text is not
// such a document, else the reasons of ValidateGarment(). Text above 4 MB: RESOURCE_EXHAUSTED GARMENT_JSON_TOO_LARGE.
Result<Garment> GarmentFromJson(std::string_view text);

// Writes and reads what a shop states, for its catalog's own rows. Reading does not validate.
std::string ShopStatementToJson(const ShopStatement& statement);
Result<ShopStatement> ShopStatementFromJson(std::string_view text);

// Points given by hand, of one photograph or of more, to be used instead of detected ones:
//   {"front": {"P1": [x, y], …}, "back": {…}, "side_folded": {…}}   (unit: pixel of the photograph, upright)
// A value may also be {"pixel": [x, y], "confidence": c}. Order and sides are checked by ValidatePoints() later, once
// the image is known.
struct PointAnnotation {
  std::vector<OutlinePoint> front;
  std::vector<OutlinePoint> back;         // Empty where the document has none.
  std::vector<OutlinePoint> side_folded;  // Empty where the document has none.
};

Result<PointAnnotation> PointAnnotationFromJson(std::string_view text, GarmentKind kind);

}  // namespace fitroom
