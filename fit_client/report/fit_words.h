#pragma once

#include <string>

#include "fit_client/report/fit_report.h"

namespace fitroom {

// A verdict with its reason, nothing said twice: "tight at the hip: 2 cm less than the 5 cm a woven needs".
std::string VerdictSentence(const SizeVerdict& verdict);

// The same as a shopper reads it first: with what the measures leave open.
std::string VerdictWords(const SizeVerdict& verdict);

// The main direction of strain, an angle from the horizontal (unit: radian): "round", "oblique" or "along".
const char* DirectionWords(double angle);

// Pressure (unit: Pa) as a band with its bounds, never as a number to two digits: "comfortable (0.4-1.3)".
std::string PressureWords(double pressure);

// The measures of a garment that are estimated by a rule, or not known at all: "thigh width, front rise"; may be empty.
std::string MeasuresKnownAs(const FitReport& report, Provenance provenance);

}  // namespace fitroom
