#include "body_center/scan/body_specification.h"

#include <array>
#include <cmath>
#include <cstdio>
#include <numbers>

namespace fitroom::body_center {
namespace {

struct Range {
  const char* option;
  double value;
  double least;
  double most;
  const char* unit;
};

Status CheckRange(const Range& range) {
  // The comparison is written so that it also fails for NaN. The slack takes up the conversion of units.
  if (range.value >= range.least - 1e-9 && range.value <= range.most + 1e-9) return {};
  std::array<char, 160> text;
  std::snprintf(text.data(), text.size(), "%s %.6g is out of range: give %g to %g %s", range.option, range.value,
                range.least, range.most, range.unit);
  return InvalidArgument("MEASUREMENT_OUT_OF_RANGE", text.data());
}

Status CheckProportion(const char* what, double value, double least, double most) {
  if (value >= least && value <= most) return {};
  std::array<char, 200> text;
  std::snprintf(text.data(), text.size(),
                "%s is %.2f, beyond what this body can show (%.2f to %.2f): check the options", what, value, least,
                most);
  return InvalidArgument("MEASUREMENTS_DO_NOT_GO_TOGETHER", text.data());
}

}  // namespace

double NeckGirth(const BodySpecification& specification) {
  // A slender neck of 33 cm goes with 1.68 m and bust 88; it grows at a third of the bust's rate.
  return specification.neck.value_or(0.33 *
                                     (0.4 + 0.25 * specification.stature / 1.68 + 0.35 * specification.bust / 0.88));
}

Status ValidateBodySpecification(const BodySpecification& specification) {
  const double degrees = specification.arm_angle * 180.0 / std::numbers::pi;
  FR_RETURN_IF_ERROR(CheckRange({"--stature-cm", 100 * specification.stature, 140, 195, "cm"}));
  FR_RETURN_IF_ERROR(CheckRange({"--bust-cm", 100 * specification.bust, 70, 140, "cm"}));
  FR_RETURN_IF_ERROR(CheckRange({"--waist-cm", 100 * specification.waist, 50, 130, "cm"}));
  FR_RETURN_IF_ERROR(CheckRange({"--hip-cm", 100 * specification.hip, 75, 150, "cm"}));
  FR_RETURN_IF_ERROR(CheckRange({"--neck-cm", 100 * NeckGirth(specification), 26, 48, "cm"}));
  FR_RETURN_IF_ERROR(CheckRange({"--arm-angle-deg", degrees, 15, 60, "degrees"}));
  FR_RETURN_IF_ERROR(CheckProportion("waist / hip", specification.waist / specification.hip, 0.58, 0.96));
  FR_RETURN_IF_ERROR(CheckProportion("waist / bust", specification.waist / specification.bust, 0.62, 0.98));
  FR_RETURN_IF_ERROR(CheckProportion("bust / hip", specification.bust / specification.hip, 0.72, 1.25));
  FR_RETURN_IF_ERROR(CheckProportion("bust / stature", specification.bust / specification.stature, 0.42, 0.80));
  FR_RETURN_IF_ERROR(CheckProportion("hip / stature", specification.hip / specification.stature, 0.46, 0.85));
  FR_RETURN_IF_ERROR(CheckProportion("neck / bust", NeckGirth(specification) / specification.bust, 0.28, 0.46));
  return {};
}

}  // namespace fitroom::body_center
