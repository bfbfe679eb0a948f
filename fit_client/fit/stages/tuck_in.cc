#include "fit_client/fit/stages/tuck_in.h"

#include <algorithm>
#include <cmath>
#include <set>
#include <utility>

#include "fit_client/fit/stages/lower_body.h"
#include "fit_client/fit/stages/place_bottom.h"
#include "fit_client/fit/stages/push_out.h"

namespace fitroom {
namespace {

using Eigen::Vector3d;

constexpr double kKeptGap = 0.08;         // Of what pressed cloth stands off, this share stays: folds keep their order.
constexpr double kUnderWaistband = 0.01;  // A tucked top is held from so far below the waist's edge (unit: metre).
constexpr double kAboveCrotch = 0.04;     // Its hem ends so far above the groin (unit: metre).
constexpr double kCoverReach = 0.06;  // A cover's start place within this way of a particle covers it (unit: metre).
constexpr int kSmoothing = 6;         // Passes over the ways, so that neighbours do not part.

std::vector<std::pair<int, int>> EdgesOf(const ClothMesh& cloth) {
  std::set<std::pair<int, int>> edges;
  for (const Eigen::Vector3i& triangle : cloth.triangles) {
    for (int k = 0; k < 3; ++k) edges.insert(std::minmax(triangle[k], triangle[(k + 1) % 3]));
  }
  for (const SeamPair& pair : cloth.seams) edges.insert(std::minmax(pair.a, pair.b));
  return {edges.begin(), edges.end()};
}

// Ways from where the cloth is to where it is pressed; where `is_held` is false there are none.
class Press {
 public:
  Press(const ClothMesh& cloth, const std::vector<Vector3d>& from, const SignedDistanceField& field, double gap)
      : cloth_(cloth), from_(from), field_(field), gap_(gap), to_(from), is_held_(from.size(), false) {}

  // Holds a particle, starting its way from `place`.
  void Hold(size_t particle, const Vector3d& place) {
    is_held_[particle] = true;
    const double stands_off = std::max(0.0, field_.Distance(place) - gap_);
    to_[particle] = PlaceAtDistance(field_, place, gap_ + kKeptGap * stands_off);
  }

  std::vector<Attachment> Finish() {
    Smooth();
    MeetAtSeams();
    std::vector<Attachment> attachments;
    for (size_t i = 0; i < to_.size(); ++i) {
      if (!is_held_[i]) continue;
      const double least = std::min(gap_, field_.Distance(from_[i]));
      if (field_.Distance(to_[i]) < least) to_[i] = PlaceAtDistance(field_, to_[i], gap_);
      attachments.push_back({static_cast<int>(i), to_[i]});
    }
    return attachments;
  }

 private:
  void Smooth() {
    const std::vector<std::pair<int, int>> edges = EdgesOf(cloth_);
    std::vector<Vector3d> sums(to_.size());
    std::vector<int> counts(to_.size());
    for (int pass = 0; pass < kSmoothing; ++pass) {
      for (size_t i = 0; i < to_.size(); ++i) sums[i] = to_[i] - from_[i];
      std::fill(counts.begin(), counts.end(), 1);
      for (const auto& [first, second] : edges) {
        const size_t a = static_cast<size_t>(first);
        const size_t b = static_cast<size_t>(second);
        if (is_held_[a] != is_held_[b]) continue;
        sums[a] += to_[b] - from_[b];
        sums[b] += to_[a] - from_[a];
        ++counts[a];
        ++counts[b];
      }
      for (size_t i = 0; i < to_.size(); ++i) {
        if (is_held_[i]) to_[i] = from_[i] + sums[i] / counts[i];
      }
    }
  }

  void MeetAtSeams() {
    for (const SeamPair& pair : cloth_.seams) {
      const size_t a = static_cast<size_t>(pair.a);
      const size_t b = static_cast<size_t>(pair.b);
      is_held_[a] = is_held_[b] = is_held_[a] && is_held_[b];
      to_[b] = to_[a];
    }
  }

  const ClothMesh& cloth_;
  const std::vector<Vector3d>& from_;
  const SignedDistanceField& field_;
  const double gap_;
  std::vector<Vector3d> to_;
  std::vector<bool> is_held_;
};

// Holds what is below the waistband, drawn up so that the hem ends above the crotch.
Status HoldBelowWaistband(const ClothMesh& bottom, const std::vector<Vector3d>& worn, const DressedBody& wearer,
                          const DressingOptions& options, Press& press) {
  FR_ASSIGN_OR_RETURN(const LowerBody lower, LowerBody::Cut(wearer.body, wearer.collider, wearer.layers));
  FR_ASSIGN_OR_RETURN(const BottomOutline outline, FindBottomOutline(bottom));
  FR_ASSIGN_OR_RETURN(const BottomPose pose, PlaceBottom(bottom, outline, lower, options.bottom_pose));
  const double waist = MeanWaistHeight(outline, pose.around) - kUnderWaistband;
  double hem = waist;
  for (const Vector3d& place : worn) hem = std::min(hem, place.y());
  const double lowest = std::min(waist, std::max(hem, lower.groin().y() + kAboveCrotch));
  const double scale = hem < waist ? (waist - lowest) / (waist - hem) : 1.0;
  for (size_t i = 0; i < worn.size(); ++i) {
    if (worn[i].y() >= waist) continue;
    press.Hold(i, {worn[i].x(), waist - scale * (waist - worn[i].y()), worn[i].z()});
  }
  return Status();
}

}  // namespace

Result<DrapeResult> TuckIn(const ClothMesh& cloth, const std::vector<Vector3d>& worn, const ClothMesh& bottom,
                           const DressedBody& wearer, const DressingOptions& options, Executor& executor) {
  FR_CHECK(worn.size() == cloth.rest_positions.size());
  Eigen::AlignedBox3d reach;
  for (const Vector3d& place : worn) reach.extend(place);
  reach.min().array() -= 0.06;
  reach.max().array() += 0.06;
  FR_ASSIGN_OR_RETURN(const SignedDistanceField field,
                      BuildDressedField(wearer.collider, wearer.layers, reach, options.field_pitch, executor));
  Press press(cloth, worn, field, options.drape.contact_offset);
  FR_RETURN_IF_ERROR(HoldBelowWaistband(bottom, worn, wearer, options, press));
  const std::vector<Attachment> attachments = press.Finish();
  DrapeOptions drape = options.drape;
  drape.relaxing_substeps = 0;
  drape.attach = [&attachments](std::span<const Vector3d>) -> Result<std::vector<Attachment>> { return attachments; };
  return Drape(cloth, worn, field, drape, executor, {});
}

}  // namespace fitroom
