#include "fit_client/fitting/dress_by_profile.h"

#include <utility>
#include <vector>

#include "fit_client/fit/paper/dress_as_printed.h"
#include "fit_client/fit/refine/dress_coarse_to_fine.h"

namespace fitroom {
namespace {

// Where the printed method starts: round the body, seams nearly meeting.
Result<std::vector<Eigen::Vector3d>> StartOf(const CutGarment& cut, const DressedBody& wearer,
                                             const DressingOptions& options) {
  if (!IsBottom(cut.kind)) {
    FR_ASSIGN_OR_RETURN(StartPose pose, PlaceTop(cut.cloth, cut.kind, wearer.body, wearer.collider, options.top_pose));
    return std::move(pose.around);
  }
  FR_ASSIGN_OR_RETURN(const LowerBody lower, LowerBody::Cut(wearer.body, wearer.collider, {}));
  FR_ASSIGN_OR_RETURN(const BottomOutline outline, FindBottomOutline(cut.cloth));
  FR_ASSIGN_OR_RETURN(BottomPose pose, PlaceBottom(cut.cloth, outline, lower, options.bottom_pose));
  return std::move(pose.around);
}

Result<Dressing> DressOnPaper(const CutGarment& cut, const DressedBody& wearer, const DressingOptions& options,
                              Executor& executor, const std::function<void(double done)>& progress) {
  if (!wearer.layers.empty()) {
    return FailedPrecondition("PAPER_HAS_NO_LAYERS",
                              "the profile \"paper\" dresses a body in one garment; take the profile \"standard\"");
  }
  FR_ASSIGN_OR_RETURN(const std::vector<Eigen::Vector3d> start, StartOf(cut, wearer, options));
  const auto stage_progress = [&](paper::PaperStage stage, int) {
    if (progress) progress(0.2 * static_cast<double>(static_cast<int>(stage)));
  };
  FR_ASSIGN_OR_RETURN(paper::DressedAsPrinted dressed,
                      paper::DressAsPrinted(cut.cloth, wearer.body, wearer.collider, start,
                                            paper::RunnablePaperOptions(), executor, stage_progress));
  Dressing dressing;
  dressing.stages.start = std::move(dressed.start);
  dressing.stages.merging = std::move(dressed.merging);
  dressing.stages.stitched = std::move(dressed.stitched);
  dressing.stages.pulled_up = std::move(dressed.pulled_up);
  dressing.stages.final = std::move(dressed.final);
  dressing.report = std::move(dressed.report);
  if (!IsBottom(cut.kind)) {
    dressing.shoulder_point_count = static_cast<int>(paper::ShoulderVertices(cut.cloth, wearer.body, start).size());
  }
  return dressing;
}

}  // namespace

Result<Dressing> DressByProfile(const CutGarment& cut, const DressedBody& wearer, const FitOptions& options,
                                const DressingOptions& dressing, Executor& executor,
                                const std::function<void(double done)>& progress) {
  if (options.profile == FitProfile::kPaper) return DressOnPaper(cut, wearer, dressing, executor, progress);
  std::vector<const ClothMesh*> meshes;
  for (const ClothMesh& coarse : cut.coarser) meshes.push_back(&coarse);
  meshes.push_back(&cut.cloth);
  return DressCoarseToFine(meshes, cut.kind, wearer, dressing, executor, progress);
}

}  // namespace fitroom
