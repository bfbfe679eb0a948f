#include <algorithm>
#include <cmath>
#include <numbers>

#include "common/body/landmark_search.h"
#include "common/body/outline_profile.h"
#include "common/body/polygon.h"

namespace fitroom {
namespace {

// Heights and widths are parts of the stature, lengths in metres. The windows are wider than people differ.
constexpr double kBustDirection = 15.0 * std::numbers::pi / 180.0;
constexpr double kFarthestArmpit = 0.14;  // From the midline; people have 0.08 to 0.11.
constexpr double kArmpitBelowAcromion = 0.066;
constexpr double kNavelPart = 0.508;      // Of the way from the crotch up to the armpits.
constexpr double kHipAboveCrotch = 0.03;  // Below, the section still holds the inner thighs (unit: metre).

double Certainty(double bridge_length) { return std::clamp(0.95 - 2.0 * bridge_length, 0.1, 0.95); }

void Place(BodyLandmarks& landmarks, BodyLandmark landmark, const Eigen::Vector3d& position, double confidence) {
  landmarks[landmark].position = position;
  landmarks[landmark].confidence = confidence;
}

GirthMeasurement TapeOf(const BodySlice& slice) { return {TapeLength(slice.TrunkLoop()->points), slice.height}; }

// The trunk's slices between two heights.
std::vector<const BodySlice*> TrunkBetween(const BodySlices& body, double low, double high) {
  std::vector<const BodySlice*> found;
  for (const BodySlice& slice : body.slices) {
    if (slice.height >= low && slice.height <= high && slice.trunk >= 0) found.push_back(&slice);
  }
  return found;
}

double MiddleX(const BodySlice& slice) { return slice.TrunkLoop()->centroid.x(); }

// Lowest point of the midline between front and back, from the slices' outlines in the sagittal plane. On a mesh with a
// hole there the legs' outlines are joined over guessed bridges; the midline's own last points are the better witness.
double LowestOnMidline(const BodyShape& shape, const MergePoint& merge) {
  const double x = merge.position.x();
  const double y = merge.position.y();
  const TriangleMesh& mesh = shape.index.mesh();
  double lowest = 1e300;
  for (const int number : shape.index.TrianglesBetween(y - 0.02, y + 0.06)) {
    const Eigen::Vector3i& t = mesh.triangles[static_cast<size_t>(number)];
    for (int i = 0; i < 3; ++i) {
      const Eigen::Vector3d& a = mesh.vertices[static_cast<size_t>(t[i])];
      const Eigen::Vector3d& b = mesh.vertices[static_cast<size_t>(t[(i + 1) % 3])];
      if ((a.x() < x) == (b.x() < x)) continue;
      lowest = std::min(lowest, a.y() + (x - a.x()) / (b.x() - a.x()) * (b.y() - a.y()));
    }
  }
  return lowest;
}

void FindCrotch(const BodyShape& shape, BodyLandmarks& landmarks) {
  const MergePoint& merge = shape.slices.crotch;
  Eigen::Vector3d crotch = merge.position;
  if (merge.bridge_length > 0.01 && !merge.touching) {
    const double lowest = LowestOnMidline(shape, merge);
    if (std::abs(lowest - crotch.y()) < 0.05) crotch.y() = std::max(crotch.y(), lowest);
  }
  const BodySlice& above = shape.slices.At(crotch.y() + 0.02);
  if (above.trunk >= 0) {
    if (const auto range = DepthAt(*above.TrunkLoop(), crotch.x())) crotch.z() = 0.5 * (range->back + range->front);
  }
  Place(landmarks, BodyLandmark::kCrotch, crotch, Certainty(merge.bridge_length));
}

void FindArmpits(const BodySlices& body, BodyLandmarks& landmarks) {
  for (const Side side : kSides) {
    const MergePoint& merge = body.armpit[IndexOf(side)];
    if (!merge.found) continue;
    // An arm that is raised level leaves no hollow: what was found is where the forearm sinks below its height.
    if (SignOf(side) * merge.position.x() > kFarthestArmpit * body.stature) continue;
    Eigen::Vector3d armpit = merge.position;
    const LandmarkEstimate& acromion = landmarks[OnSide(BodyLandmark::kAcromionLeft, side)];
    if (merge.touching && acromion.confidence > 0.0) {
      armpit.y() = std::max(armpit.y(), acromion.position.y() - kArmpitBelowAcromion * body.stature);
    }
    // Along the hollow the height hardly changes: its middle is where the arm's own middle is.
    const BodySlice& below = body.At(armpit.y() - 0.01);
    if (const SectionLoop* arm = below.ArmLoop(side)) armpit.z() = arm->bounds.center().y();
    Place(landmarks, OnSide(BodyLandmark::kArmpitLeft, side), armpit, Certainty(merge.bridge_length));
  }
}

void FindBust(const BodySlices& body, double armpit_height, BodyLandmarks& landmarks, BodyMeasurements& measurements) {
  double height_sum = 0.0;
  for (const Side side : kSides) {
    // The direction in which a breast stands out: forwards and a little outwards. Straight forwards, a flat chest's
    // farthest point would lie on the breastbone.
    const Eigen::Vector2d outwards(SignOf(side) * std::sin(kBustDirection), std::cos(kBustDirection));
    Eigen::Vector3d best = Eigen::Vector3d::Zero();
    double farthest = -1e300;
    double bridge = 0.0;
    for (const BodySlice* slice : TrunkBetween(body, armpit_height - 0.06 * body.stature, armpit_height)) {
      for (const Eigen::Vector2d& p : slice->TrunkLoop()->points) {
        const double aside = SignOf(side) * (p.x() - MiddleX(*slice)) / body.stature;
        if (aside < 0.02 || aside > 0.09 || p.dot(outwards) <= farthest) continue;
        farthest = p.dot(outwards);
        best = Eigen::Vector3d(p.x(), slice->height, p.y());
        bridge = slice->TrunkLoop()->bridge_length;
      }
    }
    if (farthest == -1e300) return;
    height_sum += best.y();
    Place(landmarks, OnSide(BodyLandmark::kBustPointLeft, side), best, Certainty(bridge));
  }
  const BodySlice& slice = body.At(0.5 * height_sum);
  if (slice.trunk >= 0) measurements.bust = {TapeOf(slice).girth, 0.5 * height_sum};
}

void FindWaist(const BodySlices& body, double crotch, double bust, double armpit, BodyLandmarks& landmarks,
               BodyMeasurements& measurements) {
  const BodySlice* waist = nullptr;
  for (const BodySlice* slice : TrunkBetween(body, crotch + 0.11 * body.stature, bust - 0.04 * body.stature)) {
    const GirthMeasurement tape = TapeOf(*slice);
    if (waist != nullptr && tape.girth >= measurements.waist.girth) continue;
    waist = slice;
    measurements.waist = tape;
  }
  if (waist == nullptr) return;
  const double x = MiddleX(*waist);
  const auto range = DepthAt(*waist->TrunkLoop(), x);
  if (!range) return;
  const double certainty = Certainty(waist->TrunkLoop()->bridge_length);
  Place(landmarks, BodyLandmark::kWaistFront, Eigen::Vector3d(x, waist->height, range->front), certainty);
  Place(landmarks, BodyLandmark::kWaistBack, Eigen::Vector3d(x, waist->height, range->back), certainty);
  // A scan seldom resolves the navel: its usual place between crotch and armpits.
  const BodySlice& navel = body.At(crotch + kNavelPart * (armpit - crotch));
  if (navel.trunk < 0) return;
  const double navel_x = MiddleX(navel);
  if (const auto depth = DepthAt(*navel.TrunkLoop(), navel_x)) {
    Place(landmarks, BodyLandmark::kNavel, Eigen::Vector3d(navel_x, navel.height, depth->front), 0.4);
  }
}

// The slice of the seat that reaches farthest along a direction in its plane.
const BodySlice* FarthestSlice(const std::vector<const BodySlice*>& seat, const Eigen::Vector2d& direction) {
  const BodySlice* farthest = nullptr;
  double reach = -1e300;
  for (const BodySlice* slice : seat) {
    const double here = FarthestAlong(*slice->TrunkLoop(), direction).dot(direction);
    if (here <= reach) continue;
    reach = here;
    farthest = slice;
  }
  return farthest;
}

void FindHip(const BodySlices& body, double crotch, BodyLandmarks& landmarks, BodyMeasurements& measurements) {
  const std::vector<const BodySlice*> seat = TrunkBetween(body, crotch + kHipAboveCrotch, crotch + 0.13 * body.stature);
  for (const BodySlice* slice : seat) {
    const GirthMeasurement tape = TapeOf(*slice);
    if (tape.girth > measurements.hip.girth) measurements.hip = tape;
  }
  const BodySlice* buttock = FarthestSlice(seat, Eigen::Vector2d(0.0, -1.0));
  if (buttock == nullptr) return;
  // The great trochanters lie a little above the level of the buttocks' farthest points.
  const BodySlice& hip = body.At(buttock->height + 0.007 * body.stature);
  for (const Side side : kSides) {
    if (hip.trunk < 0) break;
    const Eigen::Vector2d p = FarthestAlong(*hip.TrunkLoop(), Eigen::Vector2d(SignOf(side), 0.0));
    Place(landmarks, OnSide(BodyLandmark::kHipSideLeft, side), Eigen::Vector3d(p.x(), hip.height, p.y()),
          Certainty(hip.TrunkLoop()->bridge_length));
  }
  const double x = MiddleX(*buttock);
  if (const auto range = DepthAt(*buttock->TrunkLoop(), x)) {
    Place(landmarks, BodyLandmark::kButtockMidBack, Eigen::Vector3d(x, buttock->height, range->back),
          Certainty(buttock->TrunkLoop()->bridge_length));
  }
}

void FindCrown(const BodyShape& shape, BodyLandmarks& landmarks) {
  const TriangleMesh& mesh = shape.index.mesh();
  Eigen::Vector3d crown = mesh.vertices.front();
  for (const Eigen::Vector3d& p : mesh.vertices) {
    if (p.y() > crown.y()) crown = p;
  }
  Place(landmarks, BodyLandmark::kCrown, crown, 0.8);
}

void MeasureNeck(const BodySlices& body, BodyMeasurements& measurements) {
  for (const BodySlice* slice : TrunkBetween(body, 0.80 * body.stature, 0.90 * body.stature)) {
    const GirthMeasurement tape = TapeOf(*slice);
    if (measurements.neck.girth == 0.0 || tape.girth < measurements.neck.girth) measurements.neck = tape;
  }
}

}  // namespace

void FindTrunk(const BodyShape& shape, BodyLandmarks& landmarks, BodyMeasurements& measurements) {
  const BodySlices& body = shape.slices;
  measurements.stature = body.stature;
  FindCrown(shape, landmarks);
  FindCrotch(shape, landmarks);
  FindArmpits(body, landmarks);
  double armpit_height = 0.0;
  int armpit_count = 0;
  for (const Side side : kSides) {
    const LandmarkEstimate& armpit = landmarks[OnSide(BodyLandmark::kArmpitLeft, side)];
    if (armpit.confidence == 0.0) continue;
    armpit_height += armpit.position.y();
    ++armpit_count;
  }
  armpit_height = armpit_count > 0 ? armpit_height / armpit_count : 0.753 * body.stature;
  const double crotch = landmarks[BodyLandmark::kCrotch].position.y();
  FindBust(body, armpit_height, landmarks, measurements);
  const double bust = measurements.bust.height > 0.0 ? measurements.bust.height : armpit_height - 0.02 * body.stature;
  FindWaist(body, crotch, bust, armpit_height, landmarks, measurements);
  FindHip(body, crotch, landmarks, measurements);
  MeasureNeck(body, measurements);
}

}  // namespace fitroom
