#include "fit_client/fit/stages/dress_top.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "fit_client/fit/stages/press_under.h"

namespace fitroom {
namespace {

constexpr double kMergingPicture = 0.45;  // How far the panels have come in the picture of the merging, 0 to 1.

// A worn top or one-piece takes so much room below another top, which presses it to the body (unit: metre).
constexpr double kYieldingThickness = 0.0025;

// Where the cloth can get to: round the start pose, and lower, because it falls.
Eigen::AlignedBox3d ReachOf(const StartPose& pose) {
  Eigen::AlignedBox3d reach;
  for (const Eigen::Vector3d& place : pose.around) reach.extend(place);
  reach.min() -= Eigen::Vector3d(0.06, 0.12, 0.06);
  reach.max() += Eigen::Vector3d(0.06, 0.04, 0.06);
  return reach;
}

std::vector<Eigen::Vector3d> Between(const std::vector<Eigen::Vector3d>& from, const std::vector<Eigen::Vector3d>& to,
                                     double t) {
  std::vector<Eigen::Vector3d> places(from.size());
  for (size_t i = 0; i < from.size(); ++i) places[i] = (1.0 - t) * from[i] + t * to[i];
  return places;
}

// The shoulder-sleeve points of both panels that start over the shoulder; the others belong to the arm.
std::vector<int> ShoulderPoints(const ClothMesh& cloth, const Body& body, const StartPose& pose) {
  std::vector<int> points;
  for (const NamedParticle& named : cloth.named_particles) {
    const std::string name = named.name.substr(named.name.find('/') + 1);
    if (name.size() != 2 || name[0] != 'e') continue;
    const double x = pose.around[static_cast<size_t>(named.particle)].x();
    const BodyLandmark acromion = x > 0.0 ? BodyLandmark::kAcromionLeft : BodyLandmark::kAcromionRight;
    if (std::abs(x) <= std::abs(body.landmarks[acromion].position.x())) points.push_back(named.particle);
  }
  return points;
}

// A wearer pulls a dress up until its waist is where the body's is, and no farther.
std::optional<TugOptions> TugOf(const ClothMesh& cloth, const Body& body) {
  TugOptions tug;
  for (const NamedParticle& named : cloth.named_particles) {
    const std::string name = named.name.substr(named.name.find('/') + 1);
    if (name == "waist_L" || name == "waist_R") tug.waist_vertices.push_back(named.particle);
  }
  if (tug.waist_vertices.empty()) return std::nullopt;
  tug.highest = body.landmarks[BodyLandmark::kWaistFront].position.y();
  return tug;
}

// Body and layers as one mesh, to be looked at.
TriangleMesh Together(const TriangleMesh& collider, const std::vector<WornGarment>& layers) {
  TriangleMesh all = collider;
  for (const WornGarment& layer : layers) {
    const int first = static_cast<int>(all.vertices.size());
    all.vertices.insert(all.vertices.end(), layer.surface.vertices.begin(), layer.surface.vertices.end());
    for (const Eigen::Vector3i& triangle : layer.surface.triangles) {
      all.triangles.emplace_back(triangle + Eigen::Vector3i::Constant(first));
    }
  }
  return all;
}

}  // namespace

Result<Dressing> DressTop(const ClothMesh& cloth, GarmentKind kind, const DressedBody& wearer,
                          const DressingOptions& options, Executor& executor,
                          const std::function<void(double done)>& progress) {
  std::vector<WornGarment> firm;
  for (const WornGarment& layer : wearer.layers) {
    if (!YieldsToWhatIsOver(layer.kind)) firm.push_back(layer);
  }
  const double below = kYieldingThickness * static_cast<double>(wearer.layers.size() - firm.size());
  StartPoseOptions pose_options = options.top_pose;
  pose_options.clearance += below;
  FR_ASSIGN_OR_RETURN(const StartPose pose,
                      PlaceTop(cloth, kind, wearer.body,
                               firm.empty() ? wearer.collider : Together(wearer.collider, firm), pose_options));
  FR_ASSIGN_OR_RETURN(SignedDistanceField field,
                      BuildDressedField(wearer.collider, firm, ReachOf(pose), options.field_pitch, executor));
  Dressing result;
  result.field = std::make_shared<const SignedDistanceField>(std::move(field));
  result.stages.start = pose.apart;
  result.stages.merging = Between(pose.apart, pose.around, kMergingPicture);
  DrapeOptions drape_options = options.drape;
  result.yielding_below = below;
  drape_options.contact_offset += below;
  drape_options.touching_distance += below;
  drape_options.touching_vertices = ShoulderPoints(cloth, wearer.body, pose);
  if (kind == GarmentKind::kOnePiece || kind == GarmentKind::kSleevedOnePiece) {
    drape_options.tug = TugOf(cloth, wearer.body);
  }
  result.shoulder_point_count = static_cast<int>(drape_options.touching_vertices.size());
  for (const NamedParticle& named : cloth.named_particles) {
    const std::vector<int>& touching = drape_options.touching_vertices;
    if (std::find(touching.begin(), touching.end(), named.particle) == touching.end()) continue;
    result.shoulder_points.push_back(named.name);
  }
  const DrapeObserver observer = [&](const DrapeSnapshot& snapshot) {
    if (snapshot.stage == DrapeStage::kStitched) {
      result.stages.stitched.assign(snapshot.positions.begin(), snapshot.positions.end());
    }
    if (progress) progress(snapshot.progress);
  };
  FR_ASSIGN_OR_RETURN(DrapeResult drape, Drape(cloth, pose.around, *result.field, drape_options, executor, observer));
  result.stages.final = std::move(drape.positions);
  if (result.stages.stitched.empty()) result.stages.stitched = result.stages.final;
  result.report = std::move(drape.report);
  return result;
}

}  // namespace fitroom
