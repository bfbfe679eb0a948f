#pragma once

#include <array>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "common/base/executor.h"
#include "common/base/status.h"
#include "common/geometry/triangle_mesh.h"
#include "fit_client/fit/cloth_mesh.h"
#include "fit_client/fit/paper/belt.h"
#include "fit_client/fit/paper/finishing.h"
#include "fit_client/fit/paper/paper_cloth.h"
#include "fit_client/fit/paper/paper_motion.h"
#include "fit_client/fit/solver/drape.h"

namespace fitroom::paper {

// What the run has to know of a bottom: a skirt, shorts or trousers. All numbers are vertices of the mesh. Where the
// top edge crosses a seam it names both partners, one after the other.
struct PaperBottom {
  std::vector<int> crotch;                          // Whose first contact ends pulling up; of a skirt: its seat.
  Eigen::Vector3d groin = Eigen::Vector3d::Zero();  // Where the crotch is to go (unit: metre).
  std::vector<int> top_edge;                        // Closed, from the centre front round over the wearer's left.
  std::array<std::vector<int>, 2> outseams;         // From e1 to e2 and from e3 to e4.
};

// The profile `paper`: the method as printed. Each switch has the printed reading as its default.
struct PaperOptions {
  ClothMaterial material;
  MassLaw masses = MassLaw::kUnit;
  StiffnessLaw stiffness = StiffnessLaw::kOneForAll;
  // Of a damper: this part of 1/omega_max times the stiffness, so that the fastest mode is damped by half of it (unit:
  // 1; 0 to 1, where the scheme is stable for omega dt <= 1).
  double damping = 1.0;
  double frequency_times_step = 1.0;  // omega_max dt (unit: 1).
  PaperMotionOptions motion;
  CollisionOptions collision;

  std::optional<PaperBottom> bottom;   // None: a top.
  std::vector<int> shoulder_vertices;  // The shoulder-sleeve points of equation (6), of a top.
  double shoulder_epsilon = 0.02;      // Of equation (6) (unit: metre).
  double crotch_epsilon = 0.01;        // Of the end of pulling up (unit: metre).
  double outseam_epsilon = 0.005;      // Of equation (11), as part of the mean rest length (unit: 1).
  bool waits_for_rest = true;          // False: stops at once when (6) or (11) holds.
  RestOptions rest;

  int merging_step_limit = 60000;
  int pulling_up_step_limit = 60000;
  int draping_step_limit = 200000;
  double patience = 1.0;  // Merging is given up after so long without a seam pair closed or nearer (unit: second).
};

// Returns the profile for those who want to see it at work: as printed, but for the two things without which it does
// not end, springs that push when compressed, and a drag of the air.
PaperOptions RunnablePaperOptions();

// Returns the profile with every correction that is a one-line difference: signed springs, lumped masses, stiffness by
// the edge, seam pairs alone pulled, Coulomb friction, registration by overlap, swept contact with the standard's
// offset, friction once, and a drag of the air.
PaperOptions CorrectedPaperOptions();

// What the method's own numbers were; beside the DrapeReport that both profiles fill.
struct PaperReport {
  double time_step = 0.0;          // (unit: second)
  double highest_frequency = 0.0;  // The bound that it was chosen by (unit: rad/s).
  int pulling_up_steps = 0;
  bool crotch_arrived = false;      // On contact or within epsilon of the groin; else out of steps.
  double crotch_distance = 0.0;     // Of crotch and groin when pulling up ended (unit: metre).
  bool condition_met = false;       // (6) or (11), at any moment.
  double condition_time = 0.0;      // When it first held, since gravity acts (unit: second).
  double condition_value = 0.0;     // At the end: largest shoulder distance, or ||dd1|| + ||dd2|| (unit: metre).
  double belt_height = 0.0;         // (unit: metre)
  double belt_body_girth = 0.0;     // (unit: metre)
  double belt_garment_girth = 0.0;  // Of the top edge at rest; less the body's it is the waist's size answer.
  ForceAudit audit;
};

struct PaperResult {
  std::vector<Eigen::Vector3d> positions;  // One a vertex of the mesh (unit: metre).
  DrapeReport report;                      // Steps are the method's; penetration is measured, not corrected.
  PaperReport paper;
};

// A picture of a run. Views are valid during the call only.
struct PaperSnapshot {
  PaperStage stage = PaperStage::kStart;
  int step = 0;                                // Since the start.
  std::span<const Eigen::Vector3d> positions;  // One a vertex of the mesh (unit: metre).
};
// Called from the thread that drapes: at the start, and each sixtieth of a second of the stages.
using PaperObserver = std::function<void(const PaperSnapshot&)>;

// Dresses `body` in `mesh` by the method as printed, from `start_positions` (one a vertex of the mesh), in the frame of
// the body: merges and sews by (3), pulls a bottom up by (7) and (8) and sets its belt, lets gravity act by (5) or (10)
// until (6) or (11) holds, and then until rest. Every stage has a step limit; the report says how it ended. The
// `executor` serves the closing measurements only.
// INVALID_ARGUMENT for empty, mismatched, non-finite or out-of-range input; RESOURCE_EXHAUSTED where the dense voxel
// grid would be too large; FAILED_PRECONDITION where the top edge ends above or below the body; INTERNAL
// (CLOTH_STATE_NOT_FINITE) if the state stops being finite.
Result<PaperResult> PaperDrape(const ClothMesh& mesh, std::span<const Eigen::Vector3d> start_positions,
                               const TriangleMesh& body, const PaperOptions& options, Executor& executor,
                               const PaperObserver& observer);

}  // namespace fitroom::paper
