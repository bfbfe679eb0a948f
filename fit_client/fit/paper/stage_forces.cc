#include "fit_client/fit/paper/stage_forces.h"

namespace fitroom::paper {

std::string_view PaperStageName(PaperStage stage) {
  switch (stage) {
    case PaperStage::kStart:
      return "start";
    case PaperStage::kMerging:
      return "merging";
    case PaperStage::kStitched:
      return "stitched";
    case PaperStage::kPullingUp:
      return "pulling_up";
    case PaperStage::kBelted:
      return "belted";
    case PaperStage::kDraping:
      return "draping";
    case PaperStage::kFinished:
      return "finished";
  }
  return "";
}

StageForces ForcesOf(PaperStage stage) {
  StageForces forces;
  switch (stage) {
    case PaperStage::kMerging:
      forces.spring = forces.stitching = forces.friction = true;
      break;
    case PaperStage::kPullingUp:
      forces.spring = forces.friction = forces.antigravity = forces.pulled_up = true;
      break;
    case PaperStage::kDraping:
      forces.spring = forces.friction = forces.gravity = true;
      break;
    case PaperStage::kStart:
    case PaperStage::kStitched:
    case PaperStage::kBelted:
    case PaperStage::kFinished:
      break;
  }
  return forces;
}

}  // namespace fitroom::paper
