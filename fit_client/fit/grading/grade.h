#pragma once

#include <string>
#include <vector>

#include "common/base/status.h"
#include "common/garment/garment.h"
#include "fit_client/fit/panels/pattern.h"

namespace fitroom {

// What grading made of one measure. All in metres, flat.
struct GradedMeasure {
  std::string name;           // As in MeasureNames().
  double photographed = 0.0;  // What the photographed pattern has.
  double target = 0.0;        // What the graded one was to have.
  double graded = 0.0;        // What it has.
  bool given = false;         // By the chart, in both sizes. Else it followed the nearest given one.
  // Rises and thigh of trousers: laid flat, the photographed garment hides a part of them. The visible part was graded;
  // BuildFork() makes the measure itself.
  bool hidden = false;
  double residual() const { return graded - target; }
};

struct GradedPattern {
  GarmentPattern pattern;
  std::vector<GradedMeasure> measures;  // Of the kind, in the order of MeasureNames().
};

// Makes the pattern of another size. Cardinal points move by the grade rules of the kind, the outline between them
// follows smoothly; pixels stay with their points; seams stay equal front and back and mirrored left and right, to the
// bit. Targets: where photograph and chart agree within 10 %, what was photographed plus the chart's difference between
// the sizes, so that a size graded to itself is unchanged; where they measure something else under one name (girths,
// another place), what was photographed times the chart's ratio. Measures that the chart does not give in both sizes
// follow the nearest given one in proportion; lengths follow girths by half of it, and so does the depth of armhole and
// crotch. Every given measure that is not hidden ends within 2 mm of its target.
//
// Fails with INVALID_ARGUMENT: CHART_MEASURE_ABSURD (not finite, 0 or less, over 3 m, or a third or three times of what
// was photographed), CHART_WITHOUT_COMMON_MEASURES, CHART_OPENING_TOO_NARROW (less than 4 cm flat),
// CHART_CONTRADICTORY (measures that no outline can have together), CHART_CONTRADICTS_PHOTOGRAPHS (the photographed
// size is 2.5 times larger or smaller than its photograph), CHART_INVERTS_OUTLINE (the outline would cross itself).
Result<GradedPattern> GradePatternInDetail(const GarmentPattern& photographed, const GarmentSize& from,
                                           const GarmentSize& to);

// The same without the account.
Result<GarmentPattern> GradePattern(const GarmentPattern& photographed, const GarmentSize& from, const GarmentSize& to);

}  // namespace fitroom
