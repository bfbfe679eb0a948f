#pragma once

#include <string>
#include <vector>

#include "common/base/status.h"
#include "common/garment/garment.h"
#include "fit_client/fit/grading/grade_measures.h"

namespace fitroom::grading {

// A measure that is brought to its target by an increment of the grade rules (see Increments).
struct GradeDriver {
  std::string measure;
  std::string increment;
  double sign = 1.0;  // -1: the measure falls as the increment rises.
};

struct GradeTargets {
  MeasureMap targets;                // Of every measure of the pattern.
  std::vector<std::string> given;    // By the chart in both sizes.
  std::vector<GradeDriver> drivers;  // As many as the outline has freedoms.
};

// Says what each measure of a pattern is to become, as GradePatternInDetail() describes it, and refuses what is absurd.
Result<GradeTargets> FindGradeTargets(GarmentKind kind, const MeasureMap& photographed, const GarmentSize& from,
                                      const GarmentSize& to);

// Says whether a garment laid flat hides a part of the measure.
bool IsHiddenByFolding(GarmentKind kind, const std::string& measure);

}  // namespace fitroom::grading
