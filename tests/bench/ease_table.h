#pragma once

#include <string>
#include <vector>

#include "fit_client/fit/measure/zone_fit.h"

namespace fitroom {

// One worn garment's zones, for the tables.
struct WornZones {
  std::string body;
  std::string outfit;
  std::string garment;
  std::string size;
  std::vector<ZoneFit> zones;
  double belt_ease = 0.0;  // Of a bottom's waist, as dressing measured it before the belt took hold (unit: metre).
};

// How the worn line of a zone came to its length. Where neither half of the line has to stretch it is as long as the
// flat one, so that ease from the drape is garment girth less body girth; where front or back is wider than its panel,
// it is as long as the way round body and layers; on a belt it is the belt's.
enum class LineState { kFree, kStretched, kBelted };
LineState StateOf(const ZoneFit& zone);
// How far the worn line is from the length that its state asks for (unit: metre).
double LineError(const ZoneFit& zone);

// Prints how far the worn lines at bust, waist and hip are from what they have to be, an outfit's zone a line.
void PrintEaseTable(const std::vector<WornZones>& worn);

// Prints the ease of all sizes, a body's zone a line, in the order of `worn`, and where it does not grow with the size.
void PrintEaseOfSizes(const std::vector<WornZones>& worn);

}  // namespace fitroom
