#include "fit_client/fit/stages/lower_body.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <string>

#include "common/body/body_slices.h"
#include "common/body/plane_section.h"
#include "common/body/polygon.h"

namespace fitroom {
namespace {

using Eigen::Vector2d;

// A bottom's waist is worn no higher than this part of the way from the hip's height to the bust's: the narrowest place
// of a body without much of a waist lies right under the bust.
constexpr double kHighestWaist = 0.70;
constexpr double kFarthestFromTrunk = 0.12;  // Of a loop's middle from the trunk's, if it belongs to it (unit: metre).
constexpr double kLeastArea = 4e-4;          // Of an outline of the lower body (unit: square metre).

void Append(const std::vector<Vector2d>& points, std::vector<Vector2d>& to) {
  to.insert(to.end(), points.begin(), points.end());
}

void Split(const std::vector<Vector2d>& points, double x, LowerBody::Level& level) {
  for (const Vector2d& point : points) level.leg[point.x() >= x ? 0 : 1].push_back(point);
}

// Front and back of an outline where it crosses x.
void AddMidline(const SectionLoop& loop, double x, LowerBody::Level& level) {
  for (size_t k = 0; k < loop.points.size(); ++k) {
    const Vector2d& a = loop.points[k];
    const Vector2d& b = loop.points[(k + 1) % loop.points.size()];
    if ((a.x() < x) == (b.x() < x)) continue;
    const double z = a.y() + (x - a.x()) / (b.x() - a.x()) * (b.y() - a.y());
    level.front = level.has_midline ? std::max(level.front, z) : z;
    level.back = level.has_midline ? std::min(level.back, z) : z;
    level.has_midline = true;
  }
}

Status RequireLandmark(const Body& body, BodyLandmark landmark) {
  if (body.landmarks[landmark].confidence > 0.0) return Status();
  return FailedPrecondition("LANDMARK_MISSING", "the scan shows no " + std::string(LandmarkName(landmark)) +
                                                    "; a bottom cannot be placed without it; scan again with the feet "
                                                    "apart");
}

}  // namespace

Result<LowerBody> LowerBody::Cut(const Body& body, const TriangleMesh& collider, std::span<const WornGarment> layers) {
  FR_RETURN_IF_ERROR(RequireLandmark(body, BodyLandmark::kCrotch));
  if (body.measurements.waist.girth <= 0.0 || body.measurements.hip.girth <= 0.0) {
    return FailedPrecondition("LANDMARK_MISSING", "the scan shows no waist or no hip; a bottom cannot be placed");
  }
  LowerBody lower;
  lower.groin_ = body.landmarks[BodyLandmark::kCrotch].position;
  lower.waist_height_ = body.measurements.waist.height;
  lower.hip_height_ = body.measurements.hip.height;
  if (body.measurements.bust.girth > 0.0) {
    const double highest = std::lerp(lower.hip_height_, body.measurements.bust.height, kHighestWaist);
    lower.waist_height_ = std::min(lower.waist_height_, std::max(highest, lower.hip_height_));
  }
  constexpr int kSlabs = 256;
  const HeightIndex index(collider, kSlabs);
  FR_ASSIGN_OR_RETURN(const BodySlices slices, SliceBody(index));
  std::vector<HeightIndex> layer_indices;
  for (const WornGarment& layer : layers) {
    if (!layer.surface.triangles.empty()) layer_indices.emplace_back(layer.surface, kSlabs);
  }
  const double top = lower.waist_height_ + 0.15;
  const double middle = lower.groin_.x();
  for (int k = 0; k * kStep <= top; ++k) {
    const double height = k * kStep;
    const BodySlice& slice = slices.At(height);
    Level level;
    const bool below_groin = height < lower.groin_.y();
    if (slice.TrunkLoop() != nullptr) {
      Append(slice.TrunkLoop()->points, level.trunk);
      AddMidline(*slice.TrunkLoop(), middle, level);
      if (below_groin) Split(slice.TrunkLoop()->points, middle, level);
    }
    for (const Side side : kSides) {
      if (slice.LegLoop(side) == nullptr) continue;
      Append(slice.LegLoop(side)->points, level.trunk);
      Append(slice.LegLoop(side)->points, level.leg[IndexOf(side)]);
    }
    for (const HeightIndex& layer : layer_indices) {
      for (const SectionLoop& loop : layer.CutAt(height, {.min_area = kLeastArea})) {
        const bool near_middle = std::abs(loop.centroid.x() - middle) < kFarthestFromTrunk;
        if (!near_middle && !below_groin) continue;  // A sleeve.
        Append(loop.points, level.trunk);
        if (near_middle && !below_groin) AddMidline(loop, middle, level);
        if (below_groin) Split(loop.points, middle, level);
      }
    }
    lower.levels_.push_back(std::move(level));
  }
  return lower;
}

const LowerBody::Level& LowerBody::At(double height) const {
  const double place = std::clamp(height / kStep, 0.0, static_cast<double>(levels_.size() - 1));
  return levels_[static_cast<size_t>(std::lround(place))];
}

double LowerBody::TrunkGirth(double height) const { return TapeLength(At(height).trunk); }

}  // namespace fitroom
