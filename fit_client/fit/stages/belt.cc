#include "fit_client/fit/stages/belt.h"

#include <string>

#include "common/body/polygon.h"

namespace fitroom {

Result<Belt> LayBelt(const BottomOutline& outline, const LowerBody& body, std::span<const Eigen::Vector3d> positions,
                     double offset) {
  FR_CHECK(!outline.waist.empty());
  Belt belt;
  for (const WaistParticle& edge : outline.waist) {
    belt.measure.height +=
        positions[static_cast<size_t>(edge.particle)].y() / static_cast<double>(outline.waist.size());
  }
  const std::vector<Eigen::Vector2d>& section = body.At(belt.measure.height).trunk;
  TapeCurve tape(section, offset);
  if (tape.is_empty()) {
    return FailedPrecondition("BELT_HAS_NO_BODY", "there is no body for a belt at a height of " +
                                                      std::to_string(belt.measure.height) +
                                                      " m; is the scan complete between hip and waist?");
  }
  tape.StartTowards({body.groin().x(), tape.middle().y()}, {0.0, 1.0});
  belt.measure.body_girth = TapeLength(section);
  belt.measure.garment_girth = outline.waist_girth;
  const double gathering = tape.length() / outline.waist_girth;
  for (const WaistParticle& edge : outline.waist) {
    const Eigen::Vector2d at = tape.At(edge.place * gathering);
    belt.attachments.push_back({edge.particle, {at.x(), belt.measure.height, at.y()}});
  }
  return belt;
}

}  // namespace fitroom
