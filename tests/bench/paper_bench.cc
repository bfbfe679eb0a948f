// Holds the profile `paper` against `standard`: prints, for cases that both can end, how far apart their ends are, and
// what each difference between them changes, switched one at a time.
//   paper_bench [FOLDER]     with the folder of other programs' cases (body13k.obj.zst, shirt_0.02.obj) also their
//   shirt
#include <chrono>
#include <cstdio>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "common/scan_file/scan_file.h"
#include "fit_client/fit/paper/paper_drape.h"
#include "tests/fit_client/paper/common_case.h"

namespace fitroom::paper {
namespace {

double Now() { return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count(); }

using Places = std::vector<Eigen::Vector3d>;

void PrintHeader(const char* title) {
  std::printf("\n%s\n%-44s %8s %-12s %9s %6s %7s %8s %8s %7s\n", title, "", "RMS mm", "outcome", "steps", "inside",
              "deep mm", "p50", "p95", "seconds");
}

void PrintRow(const std::string& name, const Places& reference, const Places& places, const DrapeReport& report,
              double seconds) {
  std::printf("%-44s %8.1f %-12s %9d %6d %7.1f %7.1f%% %7.1f%% %7.1f\n", name.c_str(),
              reference.empty() ? 0.0 : 1e3 * testing::RmsDistance(reference, places),
              std::string(DrapeOutcomeName(report.outcome)).c_str(), report.merging_substeps + report.draping_substeps,
              report.particles_inside, report.deepest_penetration * 1e3, report.strain_p50 * 100.0,
              report.strain_p95 * 100.0, seconds);
  std::fflush(stdout);
}

// A garment, where it starts, and what both profiles are told of it.
struct Case {
  TriangleMesh body;
  ClothMesh mesh;
  Places start;
  PaperFrame frame;
};

Places RunStandard(const Case& fit, const std::string& name, const DrapeOptions& options, const Places& reference,
                   Executor& executor, Places* stitched) {
  const double begin = Now();
  const SignedDistanceField field = SignedDistanceField::Build(fit.body, {}, executor).value();
  const DrapeObserver observer = [&](const DrapeSnapshot& snapshot) {
    if (snapshot.stage == DrapeStage::kStitched && stitched != nullptr) {
      stitched->assign(snapshot.positions.begin(), snapshot.positions.end());
    }
  };
  const Result<DrapeResult> result = Drape(fit.mesh, fit.start, field, options, executor, observer);
  if (!result.ok()) {
    std::printf("%-44s %s\n", name.c_str(), result.status().ToString().c_str());
    return {};
  }
  PrintRow(name, reference, result->positions, result->report, Now() - begin);
  return result->positions;
}

void RunPaper(const Case& fit, const std::string& name, const PaperOptions& options, const Places& reference,
              Executor& executor) {
  const double begin = Now();
  const Result<PaperResult> result = PaperDrape(fit.mesh, fit.start, fit.body, options, executor, {});
  if (!result.ok()) {
    std::printf("%-44s %s\n", name.c_str(), result.status().ToString().c_str());
    return;
  }
  PrintRow(name, reference, result->positions, result->report, Now() - begin);
}

struct Difference {
  const char* name;
  std::function<void(PaperOptions&)> apply;
};

// From the base towards what is printed, and towards what the standard adds.
std::vector<Difference> Differences() {
  return {
      {"+ bars of (1)", [](PaperOptions& o) { o.motion.spring = SpringLaw::kPrinted; }},
      {"+ unit masses", [](PaperOptions& o) { o.masses = MassLaw::kUnit; }},
      {"+ one k for all springs", [](PaperOptions& o) { o.stiffness = StiffnessLaw::kOneForAll; }},
      {"+ registration by centroid, no sweep",
       [](PaperOptions& o) {
         o.collision.registration = Registration::kCentroid;
         o.collision.swept = false;
       }},
      {"+ stitching of seam pairs alone", [](PaperOptions& o) { o.motion.stitching.law = StitchingLaw::kSeamsOnly; }},
      {"+ explicit Euler", [](PaperOptions& o) { o.motion.integration = IntegrationLaw::kExplicit; }},
      {"+ no drag of the air", [](PaperOptions& o) { o.motion.air_drag = 0.0; }},
      {"+ friction of the ground plane", [](PaperOptions& o) { o.motion.friction_axes = FrictionAxes::kGroundPlane; }},
      {"+ Coulomb's friction, 0.35", [](PaperOptions& o) { o.motion.friction = FrictionLaw::kCoulomb; }},
      {"+ contact offset of 3 mm", [](PaperOptions& o) { o.collision.contact_offset = 0.003; }},
  };
}

// Sheets that slide without friction creep on for long while they count as being at rest: wait ten times as strictly.
constexpr double kStrictRest = 0.0018;  // (unit: m/s)

DrapeOptions WithoutExtras(DrapeOptions options) {
  options.rest_speed = kStrictRest;
  options.rest_speed_of_99_percent = kStrictRest;
  options.friction_coefficient = 0.0;
  options.stitching_friction_coefficient = 0.0;
  options.contact_offset = 0.0005;
  options.sample_clearance = 0.0;
  options.material.bending_stiffness = 1e-9;
  return options;
}

// What the two have in common: signed springs, the fabric's masses and stiffness, no offset, no friction to speak of.
PaperOptions Base(const PaperFrame& frame) {
  PaperOptions options = CorrectedPaperOptions();
  options.material.stretch_stiffness = 200.0;
  options.motion.frame = frame;
  options.motion.friction = FrictionLaw::kPrinted;
  options.motion.stitching.law = StitchingLaw::kPrinted;
  options.collision.contact_offset = 0.0;
  options.rest.speed = kStrictRest;
  options.merging_step_limit = 30000;
  options.draping_step_limit = 40000;
  return options;
}

// As printed, but for the sign of the springs and a drag of the air, without which nothing comes to rest.
PaperOptions NearlyPrinted(const PaperFrame& frame) {
  PaperOptions options;
  options.material.stretch_stiffness = 200.0;
  options.motion.frame = frame;
  options.motion.spring = SpringLaw::kSigned;
  options.motion.air_drag = 12.0;
  options.rest.speed = kStrictRest;
  options.merging_step_limit = 30000;
  options.draping_step_limit = 40000;
  return options;
}

DrapeOptions StandardOptions(const PaperFrame& frame) {
  DrapeOptions options;
  options.material.stretch_stiffness = 200.0;
  options.gravity = -9.81 * frame.Up();
  return options;
}

void CompareOnCone(double refinement, Executor& executor) {
  Case fit;
  fit.body = testing::CommonCone();
  fit.mesh = testing::CommonSkirt(refinement);
  fit.start = fit.mesh.rest_positions;
  char title[120];
  std::snprintf(title, sizeof(title), "A skirt on an elliptic cone, %.0f cm. RMS: from `standard` without extras.",
                3.0 / refinement);
  PrintHeader(title);
  const DrapeOptions standard = StandardOptions(fit.frame);
  const Places reference =
      RunStandard(fit, "standard without friction, offset, bending", WithoutExtras(standard), {}, executor, nullptr);
  RunStandard(fit, "standard as users run it", standard, reference, executor, nullptr);
  PaperOptions printed = NearlyPrinted(fit.frame);
  printed.motion.spring = SpringLaw::kPrinted;
  printed.motion.air_drag = 0.0;
  RunPaper(fit, "paper, as printed", printed, reference, executor);
  RunPaper(fit, "paper, but for signed springs and air drag", NearlyPrinted(fit.frame), reference, executor);
  RunPaper(fit, "paper, common base", Base(fit.frame), reference, executor);
  for (const Difference& difference : Differences()) {
    PaperOptions options = Base(fit.frame);
    difference.apply(options);
    RunPaper(fit, std::string("  base ") + difference.name, options, reference, executor);
  }
}

void CompareOnShirt(const std::filesystem::path& folder, Executor& executor) {
  Case fit;
  fit.frame = PaperFrame::ZUp();
  fit.body = testing::Refined(ReadScanFile(folder / "body13k.obj.zst").value().mesh, 1);
  fit.mesh = testing::LoadPeerShirt(folder, "0.02").value();
  fit.start = fit.mesh.rest_positions;
  PrintHeader("A T-shirt of 2 cm on a body, from flat panels. RMS: from `standard` without friction, offset, bending.");
  Places stitched;
  const DrapeOptions standard = WithoutExtras(StandardOptions(fit.frame));
  const Places reference =
      RunStandard(fit, "standard without friction, offset, bending", standard, {}, executor, &stitched);
  RunStandard(fit, "standard as users run it", StandardOptions(fit.frame), reference, executor, nullptr);
  RunPaper(fit, "paper, but for signed springs and air drag", NearlyPrinted(fit.frame), reference, executor);
  std::printf("The same from where `standard` had sewn it: equation (5) alone.\n");
  fit.start = stitched;
  RunPaper(fit, "paper, but for signed springs and air drag", NearlyPrinted(fit.frame), reference, executor);
  RunPaper(fit, "paper, common base", Base(fit.frame), reference, executor);
}

}  // namespace
}  // namespace fitroom::paper

int main(int argc, char** argv) {
  fitroom::SerialExecutor executor;
  fitroom::paper::CompareOnCone(1.0, executor);
  fitroom::paper::CompareOnCone(1.5, executor);
  if (argc > 1) fitroom::paper::CompareOnShirt(argv[1], executor);
  return 0;
}
