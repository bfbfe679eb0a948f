#pragma once

#include <functional>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include <Eigen/Core>

#include "common/base/executor.h"
#include "common/base/status.h"
#include "fit_client/fit/cloth_mesh.h"
#include "fit_client/fit/collision/signed_distance_field.h"
#include "fit_client/fit/solver/cloth_model.h"
#include "fit_client/fit/solver/cloth_solver.h"

namespace fitroom {

// The stages of dressing, in order.
enum class DrapeStage {
  kStart,     // Panels at their start positions.
  kMerging,   // Seam pairs are being drawn together; no gravity.
  kStitched,  // Closed pairs have just been welded.
  kPulledUp,  // A bottom has come as far up as it goes, under antigravity.
  kBelted,    // The belt holds the waist.
  kDraping,   // Gravity pulls the garment onto the body.
  kFinished,  // At rest, or out of steps.
};

// "start", "merging", "stitched", "pulled_up", "belted", "draping", "finished".
std::string_view DrapeStageName(DrapeStage stage);

// How a run ended.
enum class DrapeOutcome {
  kAtRest,     // Every seam is closed and the cloth is at rest.
  kSeamsOpen,  // Some seam does not close: the garment is too small here, or caught.
  kNotAtRest,  // Closed, but still moving at the step limit.
};

// "at_rest", "seams_open", "not_at_rest".
std::string_view DrapeOutcomeName(DrapeOutcome outcome);

// A picture of a run for the observer. Views are valid during the call only.
struct DrapeSnapshot {
  DrapeStage stage = DrapeStage::kStart;
  int substep = 0;                             // Since the start.
  double progress = 0.0;                       // Part of the whole, 0 to 1, an estimate.
  std::span<const Eigen::Vector3d> positions;  // One a vertex of the mesh (unit: metre).
};
// Called from the thread that drapes, at the start and end of each stage and some ten times in between.
using DrapeObserver = std::function<void(const DrapeSnapshot&)>;

// What ended the pulling up of a bottom.
enum class PullEnd {
  kNotPulled,      // There was nothing to pull.
  kCrotchContact,  // The crotch met the groin from below.
  kEdgeAtHeight,   // The waist's edge reached its height.
  kStuck,          // Nothing rose any more: the garment is too narrow to come up farther.
  kStepLimit,
};

// "not_pulled", "crotch_contact", "edge_at_height", "stuck", "step_limit".
std::string_view PullEndName(PullEnd end);

// Pulls a stitched bottom up under antigravity (equations 7 to 9): its waist follows an upward wind, the rest of the
// cloth follows the waist. Vertices of the mesh.
struct PullUpOptions {
  double speed = 0.25;               // Of the wind at the waist (unit: m/s).
  double grip_length = 0.15;         // The wind falls to nothing so far below the waist's edge (unit: metre).
  std::vector<int> crotch_vertices;  // One of these has to touch the body from below, and the waist to rise no more,
  double contact_distance = 0.007;   // to end the pull; touching is a signed distance up to this (unit: metre).
  std::vector<int> edge_vertices;    // The waist's edge; its mean height
  double edge_height = 1e9;          // at this place ends the pull as well (unit: metre).
  int substep_limit = 1200;          // Of 0.5 ms.
};

// How far the wearer of a garment that hangs from the shoulders may pull it up where its girth does not close.
struct TugOptions {
  std::vector<int> waist_vertices;  // Of the mesh, the garment's waist; their mean height
  double highest = 1e9;             // at this place ends the tug (unit: metre),
  double longest_way = 0.05;        // or so far above where it hung: more would lie in rolls, and nobody wears it so.
  int substep_limit = 1200;         // Of 0.5 ms.
};

// Says where vertices of the mesh are to be held, once the garment is pulled up: `positions` holds one place a vertex.
using AttachFunction = std::function<Result<std::vector<Attachment>>(std::span<const Eigen::Vector3d> positions)>;

// A chain of vertices whose length is compared with its length at rest: an outseam of condition (11).
using VertexChain = std::vector<int>;

// A stretch of seam that stays open because the garment lacks girth there.
struct SeamOpening {
  double lacking_girth = 0.0;  // Of the body with its layer, to the garment at its fabric's limit (unit: metre).
  double gap = 0.0;            // Between the two sides there, along the body (unit: metre).
  double seam_length = 0.0;    // Of open seam, at rest (unit: metre).
  Eigen::Vector3d place = Eigen::Vector3d::Zero();  // Where most is missing (unit: metre).
  bool is_left = true;                              // The wearer's left.
  bool is_sleeve = false;                           // A sleeve's underside; else a side seam or outseam.
};

// "left side seam", "right sleeve's seam".
std::string OpeningName(const SeamOpening& opening);

// How and when dressing ends. Rates are per second and sizes in metres, so that they fit any mesh.
struct DrapeOptions {
  ClothMaterial material;
  Eigen::Vector3d gravity = Eigen::Vector3d(0.0, -9.81, 0.0);  // (unit: m/s^2)

  double friction_coefficient = 0.35;  // Cloth on skin once stitched (unit: 1).
  double stitching_friction_coefficient =
      0.05;                         // While seams are drawn together: hardly any, or the underarm is caught.
  double contact_offset = 0.003;    // Particles stay this far outside the body (unit: metre).
  double sample_clearance = 0.001;  // Edge middles and triangle centres stay this far outside (unit: metre).

  // How far the fabric can be stretched. A hoop of the garment that would have to be longer to close round the body
  // opens its seam by what is missing (unit: 1). 0: seams hold whatever they are put to.
  double limit_strain = 0.0;

  bool self_collision = true;  // Layers of the cloth keep apart from each other once stitched.

  double closing_speed = 1.6;  // Largest speed at which a pair is drawn together (unit: m/s).
  double closed_gap = 0.0005;  // A pair closer than this is closed (unit: metre).
  int merging_substep_limit = 3000;
  // After sewing and before gravity: substeps of 0.5 ms in which cloth that starts stretched or creased shrinks onto
  // the body, strongly damped and at the stitching friction, so that no stretch is frozen in by friction. 0: none.
  int relaxing_substeps = 0;
  int draping_substep_limit = 20000;

  double rest_speed = 0.018;               // 0.03 cm per 1/60 s (unit: m/s).
  double rest_share = 0.985;               // This part of the particles must be slower than rest_speed,
  double rest_speed_of_99_percent = 0.02;  // and 99 % slower than this (unit: m/s).

  // A further condition for the end, equation (6) of the method: every one of these vertices of the mesh must be within
  // `touching_distance` of the body (unit: metre). Where one is not, rest has to hold for a second before the run ends,
  // because a garment may still be sliding down. Whether the condition was met is reported.
  std::vector<int> touching_vertices;
  double touching_distance = 0.02;

  // Bottoms, between sewing and gravity: first pulled up, then held. `attach` returns vertices with their targets.
  std::optional<PullUpOptions> pull_up;
  AttachFunction attach;

  // Tops, once sewn and at rest: where a hoop would have to be longer than `limit_strain` allows, the garment is pulled
  // up and hung again before a seam opens. What closes at once is not touched.
  std::optional<TugOptions> tug;
  // Condition (11): the lengths of these chains differ from those at rest by less than this part, all together.
  std::vector<VertexChain> measured_chains;
  double length_tolerance = 0.005;  // (unit: 1)
};

// What happened, in numbers. Strain is that of an edge against its rest length, stretched positive.
struct DrapeReport {
  DrapeOutcome outcome = DrapeOutcome::kNotAtRest;
  std::string finishing_reason;  // A sentence for a person; names gap and place where a seam does not close.

  int merging_substeps = 0;
  int relaxing_substeps = 0;
  int pulling_substeps = 0;
  PullEnd pull_end = PullEnd::kNotPulled;
  int belting_substeps = 0;
  int tugging_substeps = 0;
  double tugged_way = 0.0;  // How far up the garment's waist was pulled so that it closes; 0: it was not (unit: metre).
  int draping_substeps = 0;
  double simulated_seconds = 0.0;  // In which gravity acted.

  int seam_pair_count = 0;
  int open_seam_count = 0;
  double seam_gap_mean = 0.0;  // When merging ended; the welded ones then coincide (unit: metre).
  double seam_gap_p95 = 0.0;
  double seam_gap_max = 0.0;
  double final_seam_gap_max = 0.0;    // In the result (unit: metre).
  std::vector<SeamOpening> openings;  // Where girth is missing, the most first; only with a limit strain.
  bool is_open_at_rest = false;       // Seams are open and the cloth is at rest all the same.

  double speed_p99 = 0.0;  // At the end (unit: m/s).
  double speed_max = 0.0;
  double share_at_rest = 0.0;  // Part of the particles slower than the rest speed.
  bool touching_condition_met = true;
  double touching_distance_max = 0.0;  // Largest distance of a touching vertex (unit: metre).

  // Condition (11): sum |l - l0| / sum l0 over the measured chains, and whether it was met when the run ended.
  double length_residual = 0.0;  // (unit: 1)
  bool length_condition_met = true;

  double deepest_penetration = 0.0;  // Over particles and samples; 0 if none is inside (unit: metre).
  int particles_inside = 0;
  int samples_inside = 0;  // Edge middles and triangle centres.

  double strain_p50 = 0.0;
  double strain_p95 = 0.0;
  double strain_p99 = 0.0;
  double strain_max = 0.0;
  int self_crossing_count = 0;  // Pairs of an edge and a triangle of the cloth that cross.
};

struct DrapeResult {
  std::vector<Eigen::Vector3d> positions;  // One a vertex of the mesh; sewn partners coincide (unit: metre).
  DrapeReport report;
};

// Dresses `body` in `mesh`, from `start_positions` (one a vertex of the mesh), in the frame of the body: draws seam
// pairs together without gravity, strongly damped; welds the closed ones; pulls a bottom up and holds its waist, where
// the options say so; lets gravity act until the cloth is at rest.
// Always ends: every stage has a step limit, and a garment that does not close ends with that outcome.
// The same result for any executor.
// INVALID_ARGUMENT for empty, mismatched, non-finite or out-of-range input; INTERNAL if the state stops being finite.
Result<DrapeResult> Drape(const ClothMesh& mesh, std::span<const Eigen::Vector3d> start_positions,
                          const SignedDistanceField& body, const DrapeOptions& options, Executor& executor,
                          const DrapeObserver& observer);

// Lets a garment that is worn already settle on a finer mesh: `worn_positions` are where the same garment lies on a
// coarser one. Pairs that are closed there are welded at once, `attach` holds the waist from the start, and gravity
// acts until the cloth is at rest; nothing is relaxed or pulled up. Else like Drape().
Result<DrapeResult> Settle(const ClothMesh& mesh, std::span<const Eigen::Vector3d> worn_positions,
                           const SignedDistanceField& body, const DrapeOptions& options, Executor& executor,
                           const DrapeObserver& observer);

// Returns the positions with the two sides of each seam drawn apart by `gap`, each into its own panel, so that a
// program that takes them for two sheets does not see them cross.
std::vector<Eigen::Vector3d> SeparateSeamPartners(const ClothMesh& mesh, std::span<const Eigen::Vector3d> positions,
                                                  double gap);

}  // namespace fitroom
