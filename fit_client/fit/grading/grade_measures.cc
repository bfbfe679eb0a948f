#include "fit_client/fit/grading/grade_measures.h"

#include <cmath>

#include "fit_client/fit/panels/measure.h"

namespace fitroom::grading {

MeasureMap MeasureByName(const GarmentPattern& pattern) {
  MeasureMap measures;
  for (const GarmentMeasure& measure : MeasurePattern(pattern)) {
    if (std::isfinite(measure.value) && measure.value > 0.0) measures[measure.name] = measure.value;
  }
  return measures;
}

}  // namespace fitroom::grading
