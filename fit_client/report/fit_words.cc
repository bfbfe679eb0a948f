#include "fit_client/report/fit_words.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "fit_client/fit/measure/contact_pressure.h"
#include "fit_client/report/page.h"

namespace fitroom {

std::string VerdictSentence(const SizeVerdict& verdict) {
  const std::string words(FitVerdictWords(verdict.verdict));
  if (verdict.reason.empty()) return words;
  // "tight at the hip: …" says it already.
  return verdict.reason.starts_with(words) ? verdict.reason : words + ": " + verdict.reason;
}

std::string VerdictWords(const SizeVerdict& verdict) {
  return VerdictSentence(verdict) +
         (verdict.is_close ? Format(" (a close call: measures are known to %.0f mm)", verdict.uncertainty * 1e3) : "");
}

const char* DirectionWords(double angle) {
  const double degrees = std::abs(angle) * 180.0 / std::numbers::pi;
  if (degrees < 22.5) return "round";
  return degrees > 67.5 ? "along" : "oblique";
}

std::string PressureWords(double pressure) {
  switch (PressureBandOf(pressure)) {
    case PressureBand::kNegligible:
      return "none (< 0.4 kPa)";
    case PressureBand::kComfortable:
      return "comfortable (0.4-1.3)";
    case PressureBand::kCritical:
      return "critical (1.3-2.0)";
    case PressureBand::kMedical:
      return "as shapewear (2.0-3.3)";
    case PressureBand::kHarmful:
      return "too high (> 3.3)";
  }
  return "";
}

std::string MeasuresKnownAs(const FitReport& report, Provenance provenance) {
  std::string names;
  for (const GarmentMeasure& measure : report.measures) {
    if (measure.provenance != provenance) continue;
    std::string words = measure.name;
    std::replace(words.begin(), words.end(), '_', ' ');
    names += (names.empty() ? "" : ", ") + words;
  }
  return names;
}

}  // namespace fitroom
