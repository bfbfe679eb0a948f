#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "common/base/status.h"
#include "common/garment/garment.h"
#include "common/garment/shop_statement.h"

namespace fitroom {

// What a published garment may hold; a reader refuses more before it allocates.
inline constexpr int kMaxOutlinePoints = 5000;
inline constexpr int kMaxGarmentImageSide = 8192;  // (unit: pixel)
inline constexpr double kMinGarmentLength = 0.2;   // (unit: metre)
inline constexpr double kMaxGarmentLength = 2.0;   // (unit: metre)

inline constexpr int kMaxChartSizes = 40;
inline constexpr int kMaxSizeNameSize = 16;  // (unit: byte)

// Checks that a garment read from outside is one that the fit can rely on: names and sizes in range, outlines simple
// and clockwise, every point of the kind present once, in order, inside its image, on the outline, and on the right
// side. INVALID_ARGUMENT with the reasons GARMENT_ID, GARMENT_TITLE, GARMENT_LENGTH, GARMENT_MEASURE,
// GARMENT_FILE_NAME, IMAGE_SIZE, METRE_PER_PIXEL, OUTLINE_SIZE, OUTLINE_NOT_SIMPLE, OUTLINE_DIRECTION, POINT_MISSING,
// POINT_UNKNOWN, POINT_OUTSIDE_IMAGE, POINT_CONFIDENCE, POINTS_SWAPPED, POINT_OFF_OUTLINE, POINT_OUT_OF_ORDER;
// SIDE_FOLDED_KIND for a side-folded view of what has no legs; those of ValidateFabric(), ValidateMeasures() and
// ValidateSizeChart(); CHART_CONTRADICTS_PHOTOGRAPH. The message names view and point.
Status ValidateGarment(const Garment& garment);

// Checks a size chart that is not empty: 1 to 40 sizes with names of their own; every measure one of the kind, 1 cm to
// 2.5 m; at least one stated for all sizes and one of these growing at each step, none leaping; body girths 40 cm to
// 2 m and growing; the photographed size among them. INVALID_ARGUMENT CHART_SIZE_COUNT, CHART_SIZE_NAME,
// CHART_PHOTOGRAPHED_SIZE, CHART_MEASURE, CHART_NO_SHARED_MEASURE, CHART_NOT_INCREASING, CHART_JUMP, CHART_BODY_GIRTH.
Status ValidateSizeChart(GarmentKind kind, const SizeChart& chart);

// Checks that the photographed size's row can be the garment on the photographs: CHART_CONTRADICTS_PHOTOGRAPH where a
// measure is off by a factor, as girths for flat widths and inches for centimetres are.
Status CheckChartAgainstPhotographs(const Garment& garment);

// INVALID_ARGUMENT FABRIC_UNKNOWN.
Status ValidateFabric(std::string_view fabric);

// Checks a garment's measures; stated ones must be of the kind and plausible. INVALID_ARGUMENT GARMENT_MEASURE.
Status ValidateMeasures(GarmentKind kind, const std::vector<GarmentMeasure>& measures);

// Checks all that a shop states: the three above.
Status ValidateShopStatement(GarmentKind kind, const ShopStatement& statement);

// The checks of one view: see ValidateGarment().
Status ValidateView(GarmentKind kind, const GarmentView& view);

// Checks points alone, without an outline: count, names, image, confidence and left against right. This is what an
// annotation given by hand must pass.
Status ValidatePoints(GarmentKind kind, const GarmentView& view);

// Returns the names of a view's points, in their order: of the kind, or of a side-folded photograph.
const std::vector<std::string>& ViewPointNames(GarmentKind kind, GarmentSide side);
// Returns "a pants", "a side-folded photograph": for messages.
std::string DescribeView(GarmentKind kind, GarmentSide side);

// Says whether `name` can be a file in a garment's folder: [A-Za-z0-9._-]{1,100}, not starting with a dot.
bool IsPlainFileName(std::string_view name);

}  // namespace fitroom
