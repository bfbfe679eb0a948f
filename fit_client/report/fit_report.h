#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "common/garment/garment.h"
#include "fit_client/fit/measure/size_verdict.h"
#include "fit_client/fit/measure/zone_fit.h"

namespace fitroom {

// How far apart the particles of the seam pairs ended, and how many pairs stayed open.
struct SeamGapSummary {
  int pair_count = 0;
  int open_pair_count = 0;  // Pairs that are apart at the end.
  double mean = 0.0;        // (unit: metre)
  double p95 = 0.0;         // (unit: metre)
  double max = 0.0;         // (unit: metre)
  // Where a seam gave way because girth is missing: how much, and over how much seam. 0: nowhere (unit: metre).
  double lacking_girth = 0.0;
  double open_length = 0.0;
};

// What of the garment ended inside the body. Depths are positive; zero when nothing is inside.
struct PenetrationSummary {
  int particle_count_inside = 0;  // By however little.
  int triangle_sample_count = 0;  // Points looked at on the triangles, beside the particles.
  int triangle_sample_count_inside = 0;
  double deepest = 0.0;  // (unit: metre)
};

// Edge strain over the whole garment: 0.05 means 5 % longer than at rest.
struct StrainSummary {
  double p50 = 0.0;
  double p95 = 0.0;
  double p99 = 0.0;
  double max = 0.0;
};

// The room a garment leaves at one place: ease = garment girth - body girth.
struct EaseAtPlace {
  std::string place;           // "bust", "waist", "hip".
  bool measured = false;       // False: the garment does not reach there or does not close; `note` says which.
  double height = 0.0;         // Where the garment was measured, above the floor (unit: metre).
  double garment_girth = 0.0;  // Length of the draped cloth round the torso (unit: metre).
  double body_girth = 0.0;     // What a tape measures (unit: metre).
  std::string note;

  double ease() const { return garment_girth - body_girth; }                             // (unit: metre)
  double relative_ease() const { return body_girth > 0.0 ? ease() / body_girth : 0.0; }  // Part of the body's girth.
};

// A quantity that had to fall below a limit for the fit to be called finished.
struct Residual {
  std::string name;    // For people: "shoulder points to body", "speed of 99 % of the particles".
  std::string symbol;  // For programs, [a-z0-9_]+: "shoulder_distance", "speed_p99".
  double value = 0.0;  // In the residual's own unit, SI.
  double limit = 0.0;  // In the same unit.
  std::string unit;    // "m", "m/s".
};

// One stage of the process, in the order in which they ran.
struct StageOutcome {
  std::string name;     // "placing", "merging", "stitching", "gravity", "rest".
  std::string outcome;  // How it ended, for people: "all seams closed after 212 substeps".
  int substep_count = 0;
};

// One garment of several that are worn over each other, the innermost first.
struct LayerReport {
  std::string garment;            // Id.
  std::string kind;               // "pants", …
  std::string size;               // Of its chart; may be empty.
  std::string outcome;            // "AT_REST", …
  std::string verdict;            // "good", "tight", …; empty where it was not judged.
  double gap_mean = 0.0;          // From the body (unit: metre).
  int particle_count_inside = 0;  // In what lies under it.
};

// How long a part of the whole command took.
struct StageTime {
  std::string name;      // "read", "body field", "panels", "drape", "pictures", …
  double seconds = 0.0;  // Wall clock (unit: second).
};

// A file that the command wrote, relative to the output folder.
struct OutputFile {
  std::string name;         // "front.png"
  std::string description;  // "front view"
  int64_t size = 0;         // (unit: byte)
};

// Everything a fit has to say about itself. Plain values that the command fills in; WriteJson() and WriteText() print
// them. No value is rounded here.
struct FitReport {
  std::string program_version;

  // What was fitted on what.
  std::string body;           // Name or file.
  double body_stature = 0.0;  // (unit: metre)
  int64_t body_triangle_count = 0;
  std::vector<std::string> body_notes;  // What was decided about axis, facing and unit; holes.
  std::string garment;                  // Id.
  std::string garment_title;
  std::string garment_kind;     // "tshirt", …
  double garment_length = 0.0;  // (unit: metre)
  std::string profile;          // "standard" or "paper".
  int thread_count = 0;

  // How it ended.
  bool finished = false;         // The finishing condition was met and the garment is at rest.
  std::string finishing_reason;  // UPPER_SNAKE_CASE: "AT_REST", "SEAMS_DO_NOT_CLOSE", "STEP_LIMIT", …
  std::string finishing_text;    // The same for a person, with the numbers.
  std::vector<StageOutcome> stages;
  std::vector<Residual> residuals;

  // What came out.
  SeamGapSummary seams;
  PenetrationSummary penetration;
  StrainSummary strain;
  int self_crossing_count = 0;  // Edges of the cloth that pass through it.
  std::vector<EaseAtPlace> ease;
  std::vector<ZoneFit> zones;          // From AssessFit(); empty: not assessed.
  std::string fabric;                  // "jersey", …
  std::optional<SizeVerdict> verdict;  // Of the size that was worn.
  std::vector<SizeVerdict> sizes;      // Of all sizes of the chart, the smallest first.
  std::optional<SizeRecommendation> recommendation;
  std::vector<GarmentMeasure> measures;  // Flat measures with their provenance.
  std::vector<LayerReport> layers;       // Two or more: garments worn over each other.
  int euler_characteristic = 0;          // Of the sewn garment.
  int expected_euler_characteristic = 0;
  int boundary_loop_count = 0;  // Openings: neck, hem, two sleeve ends, … 0 when not counted.
  int particle_count = 0;       // Before sewing.
  int triangle_count = 0;
  double mean_edge_length = 0.0;  // At rest (unit: metre).

  // What it cost.
  int substep_count = 0;
  std::vector<StageTime> times;
  double total_seconds = 0.0;  // (unit: second)
  int64_t peak_rss_bytes = 0;  // (unit: byte)

  std::vector<std::string> warnings;  // What a shopper should know before trusting the picture.
  std::vector<std::string> notes;     // What is merely good to know.
  std::vector<OutputFile> files;
};

// Returns the report as one JSON object, two-space indented, lengths with a unit suffix (_mm, _cm, _s, _mb, _percent),
// ending in a newline. Non-finite numbers become null.
std::string WriteJson(const FitReport& report);

// Returns the report as plain text for a terminal, at most 100 columns, ending in a newline.
std::string WriteText(const FitReport& report);

}  // namespace fitroom
