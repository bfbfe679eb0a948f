#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "common/base/status.h"
#include "common/garment/garment.h"

namespace fitroom {

// The body's girth by which a size is chosen.
enum class PrimaryDimension { kBust, kWaist, kHip };

// Returns the dimension after ISO 8559-2 for women: bust for tops and one-pieces, hip for skirts and trousers.
PrimaryDimension PrimaryDimensionOf(GarmentKind kind);
std::string_view PrimaryDimensionName(PrimaryDimension dimension);  // "bust", "waist", "hip": as in GarmentSize::body.

// Girths of a body, full circle (unit: metre). Absent: not known.
struct BodyGirths {
  std::optional<double> bust;
  std::optional<double> waist;
  std::optional<double> hip;
};

// Returns the girth of a garment minus the girth of the body that it is cut for, where the shop states no body girths:
// the least wearing ease of woven garments, the border between fitted and loose of jersey, the middle of "very fitted"
// of stretch. Unknown fabrics count as woven. `body_girth` and the result in metres.
double ClassEase(GarmentKind kind, std::string_view fabric, PrimaryDimension dimension, double body_girth);

// A garment measure is trusted to 10 mm, a scan to 9 mm, a photograph to 5 mm: together, at right angles, 14 mm.
inline constexpr double kSizeUncertainty = 0.014;

struct SizeChoice {
  int index = 0;     // Into SizeChart::sizes.
  std::string size;  // Its name.
  PrimaryDimension dimension = PrimaryDimension::kBust;
  bool from_flat_measures = false;  // The chart states no body girths: flat widths less the class's ease were used.
  double size_girth = 0.0;          // The girth of the body that the size is for (unit: metre).
  double difference = 0.0;          // size_girth - the body's girth; positive: the size is larger (unit: metre).
  // The neighbours by girth, empty at the chart's ends, and how much further from the body they are than the size
  // itself (unit: metre).
  std::string smaller;
  double smaller_margin = 0.0;
  std::string larger;
  double larger_margin = 0.0;
  // The neighbour that is as near as the uncertainty can tell, empty if the choice is clear.
  std::string between_with;
  // The body lies beyond the chart's smallest or largest size by more than half the step to the next size.
  bool outside_chart = false;
  bool between() const { return !between_with.empty(); }
};

// Chooses the size whose girth is nearest to the body's in the primary dimension; of two equally near ones the larger.
// Where neither chart nor body know that dimension, the next one that both know is taken: hip, waist, bust for bottoms,
// bust, waist, hip for the rest. Sizes that do not state the dimension are passed over.
// Fails with FAILED_PRECONDITION: CHART_EMPTY, CHART_WITHOUT_DIMENSION (body and chart share none), CHART_NOT_A_GRADING
// (two sizes with one girth); INVALID_ARGUMENT: BODY_GIRTH_OUT_OF_RANGE.
Result<SizeChoice> ChooseSize(GarmentKind kind, std::string_view fabric, const SizeChart& chart, const BodyGirths& body,
                              double uncertainty = kSizeUncertainty);

}  // namespace fitroom
