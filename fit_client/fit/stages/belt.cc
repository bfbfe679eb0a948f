#include "fit_client/fit/stages/belt.h"

#include <string>

#include "common/body/polygon.h"
#include "fit_client/fit/stages/tape_curve.h"

namespace fitroom {

double MeanWaistHeight(const BottomOutline& outline, std::span<const Eigen::Vector3d> positions) {
  FR_CHECK(!outline.waist.empty());
  double sum = 0.0;
  for (const WaistParticle& edge : outline.waist) sum += positions[static_cast<size_t>(edge.particle)].y();
  return sum / static_cast<double>(outline.waist.size());
}

Result<Belt> LayBelt(const BottomOutline& outline, std::span<const Eigen::Vector2d> section, double height,
                     double middle, double offset) {
  TapeCurve tape(section, offset);
  if (tape.is_empty()) {
    return FailedPrecondition("BELT_HAS_NO_BODY", "there is no body for a belt at a height of " +
                                                      std::to_string(height) +
                                                      " m; is the scan complete between hip and waist?");
  }
  tape.StartTowards({middle, tape.middle().y()}, {0.0, 1.0});
  Belt belt;
  belt.measure.height = height;
  belt.measure.body_girth = TapeLength(section);
  belt.measure.garment_girth = outline.waist_girth;
  const double gathering = tape.length() / outline.waist_girth;
  for (const WaistParticle& edge : outline.waist) {
    const Eigen::Vector2d at = tape.At(edge.place * gathering);
    belt.attachments.push_back({edge.particle, {at.x(), height, at.y()}});
  }
  return belt;
}

}  // namespace fitroom
