#pragma once

#include "common/base/status.h"
#include "common/garment/garment.h"

namespace fitroom {

// What a published garment may hold; a reader refuses more before it allocates.
inline constexpr int kMaxOutlinePoints = 5000;
inline constexpr int kMaxGarmentImageSide = 8192;  // (unit: pixel)
inline constexpr double kMinGarmentLength = 0.2;   // (unit: metre)
inline constexpr double kMaxGarmentLength = 2.0;   // (unit: metre)

// Checks that a garment read from outside is one that the fit can rely on: names and sizes in range, outlines simple
// and clockwise, every point of the kind present once, in order, inside its image, on the outline, and on the right
// side. INVALID_ARGUMENT with the reasons GARMENT_ID, GARMENT_TITLE, GARMENT_LENGTH, GARMENT_MEASURE,
// GARMENT_FILE_NAME, IMAGE_SIZE, METRE_PER_PIXEL, OUTLINE_SIZE, OUTLINE_NOT_SIMPLE, OUTLINE_DIRECTION, POINT_MISSING,
// POINT_UNKNOWN, POINT_OUTSIDE_IMAGE, POINT_CONFIDENCE, POINTS_SWAPPED, POINT_OFF_OUTLINE, POINT_OUT_OF_ORDER;
// UNIMPLEMENTED KIND_NOT_SUPPORTED for a kind without points. The message names view and point.
Status ValidateGarment(const Garment& garment);

// The checks of one view: see ValidateGarment().
Status ValidateView(GarmentKind kind, const GarmentView& view);

// Checks points alone, without an outline: count, names, image, confidence and left against right. This is what an
// annotation given by hand must pass.
Status ValidatePoints(GarmentKind kind, const GarmentView& view);

// Says whether `name` can be a file in a garment's folder: [A-Za-z0-9._-]{1,100}, not starting with a dot.
bool IsPlainFileName(std::string_view name);

}  // namespace fitroom
