#pragma once

#include <map>
#include <string>

#include "fit_client/fit/panels/pattern.h"

namespace fitroom::grading {

// Measures by the names of size charts (MeasureNames()), flat (unit: metre).
using MeasureMap = std::map<std::string, double>;

// Returns MeasurePattern()'s measures by name, without those that the pattern does not have.
MeasureMap MeasureByName(const GarmentPattern& pattern);

}  // namespace fitroom::grading
