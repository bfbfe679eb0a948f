#pragma once

#include <array>
#include <cstdint>
#include <string_view>

namespace fitroom::paper {

// The stages of the method. A top goes through kMerging, kStitched, kDraping; a bottom through all.
enum class PaperStage {
  kStart,      // Panels at their start positions.
  kMerging,    // Equation (3): front and back are pulled together and sewn where they meet.
  kStitched,   // Sewn; nothing has moved since.
  kPullingUp,  // Equations (7) to (9): a bottom rises until its crotch touches the body.
  kBelted,     // The top edge has just been set on the belt.
  kDraping,    // Equations (5) and (10): gravity.
  kFinished,   // At rest, or out of steps.
};
inline constexpr int kPaperStageCount = static_cast<int>(PaperStage::kFinished) + 1;

// "start", "merging", "stitched", "pulling_up", "belted", "draping", "finished".
std::string_view PaperStageName(PaperStage stage);

// The forces of the method.
enum class PaperForce { kSpring, kStitching, kFriction, kGravity, kAntigravity };
inline constexpr int kPaperForceCount = static_cast<int>(PaperForce::kAntigravity) + 1;

// Which forces act.
struct StageForces {
  bool spring = false;
  bool stitching = false;
  bool friction = false;
  bool gravity = false;
  bool antigravity = false;
  bool pulled_up = false;  // The velocity follows (7) instead of (2).
};

// Returns the sums of the equations:
//   merging     (3)          spring + stitching + friction
//   pulling up  (7) (8) (9)  spring + friction + antigravity
//   draping     (5) (10)     spring + friction + gravity
// and none for the moments between.
StageForces ForcesOf(PaperStage stage);

// How often each force acted on a particle, other than with zero, by stage: the account that the audit looks at.
struct ForceAudit {
  std::array<std::array<int64_t, kPaperForceCount>, kPaperStageCount> counts = {};

  int64_t& At(PaperStage stage, PaperForce force) {
    return counts[static_cast<size_t>(stage)][static_cast<size_t>(force)];
  }
  int64_t At(PaperStage stage, PaperForce force) const {
    return counts[static_cast<size_t>(stage)][static_cast<size_t>(force)];
  }
};

}  // namespace fitroom::paper
