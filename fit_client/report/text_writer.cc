#include <algorithm>
#include <cstddef>

#include "fit_client/report/fit_report.h"
#include "fit_client/report/fit_text.h"
#include "fit_client/report/page.h"

namespace fitroom {
namespace {

// Limits that the text judges by; the method asks for them of every garment that is large enough.
constexpr double kSeamGapLimit = 5e-4;      // (unit: metre)
constexpr double kPenetrationLimit = 1e-4;  // (unit: metre)
constexpr double kStrainLimit = 0.05;       // Of the 95th percentile.

void WriteWhat(const FitReport& report, Page& page) {
  const std::string title = Printable(report.garment_title.empty() ? report.garment : report.garment_title);
  page.Heading("Fit of " + title + " on " + Printable(report.body));
  page.Entry("garment", Printable(report.garment) + ", " + Printable(report.garment_kind) + ", length " +
                            Quantity(report.garment_length * 1e2, 1, "cm"));
  page.Entry("body", "stature " + Quantity(report.body_stature * 1e2, 1, "cm") + ", " +
                         Count(report.body_triangle_count) + " triangles");
  for (const std::string& note : report.body_notes) page.Entry("", note);
  page.Entry("profile", report.profile);
}

void WriteHow(const FitReport& report, Page& page) {
  page.Heading(report.finished ? "Result: worn and at rest" : "Result: NOT FINISHED");
  page.Entry(report.finished ? "ended" : "why", report.finishing_text + " [" + report.finishing_reason + "]");
  for (const StageOutcome& stage : report.stages) {
    page.Entry(stage.name, stage.substep_count > 0 ? stage.outcome + " (" + Count(stage.substep_count) + " substeps)"
                                                   : stage.outcome);
  }
  for (const Residual& residual : report.residuals) {
    const bool met = residual.value <= residual.limit;
    const bool is_length = residual.unit == "m" || residual.unit == "m/s";
    const double scale = is_length ? 1e3 : 1.0;
    const std::string unit = (is_length ? "m" : "") + residual.unit;
    page.Entry("condition", Format("%s: %.3g %s, limit %.3g %s: ", met ? "met" : "NOT MET", residual.value * scale,
                                   unit.c_str(), residual.limit * scale, unit.c_str()) +
                                residual.name);
  }
}

void WriteEase(const FitReport& report, Page& page) {
  if (report.ease.empty()) return;
  page.Heading("Ease: how much wider the worn garment is than the body");
  page.Line(Format("  %-14s%8s%13s%13s%11s%13s", "", "garment", "body", "ease", "", "at height"));
  for (const EaseAtPlace& ease : report.ease) {
    if (!ease.measured) {
      page.Entry(ease.place, "not measured" + (ease.note.empty() ? std::string() : ": " + ease.note));
      continue;
    }
    page.Line(Format("  %-14s%5.1f cm%10.1f cm%+10.1f cm%+9.1f %%%10.1f cm", Printable(ease.place).c_str(),
                     ease.garment_girth * 1e2, ease.body_girth * 1e2, ease.ease() * 1e2, ease.relative_ease() * 1e2,
                     ease.height * 1e2));
    if (!ease.note.empty()) page.Entry("", ease.note);
  }
}

void WriteChecks(const FitReport& report, Page& page) {
  const auto verdict = [](bool good) { return std::string(good ? "good: " : "NOT GOOD: "); };
  page.Heading("What came out");
  const SeamGapSummary& seams = report.seams;
  page.Entry("seams",
             verdict(seams.open_pair_count == 0 && seams.max <= kSeamGapLimit) + Count(seams.pair_count) + " pairs, " +
                 Count(seams.open_pair_count) + " open; gap mean " +
                 Format("%.2f, 95 %% below %.2f, largest %.2f mm", seams.mean * 1e3, seams.p95 * 1e3, seams.max * 1e3));
  const PenetrationSummary& inside = report.penetration;
  page.Entry("inside body", verdict(inside.deepest <= kPenetrationLimit) + Count(inside.particle_count_inside) +
                                " of " + Count(report.particle_count) + " particles, " +
                                Count(inside.triangle_sample_count_inside) + " of " +
                                Count(inside.triangle_sample_count) + " points between them; deepest " +
                                Format("%.2f mm", inside.deepest * 1e3));
  const StrainSummary& strain = report.strain;
  page.Entry("strain", verdict(strain.p95 < kStrainLimit) +
                           Format("half below %.1f %%, 95 %% below %.1f %%, 99 %% below %.1f %%, most %.1f %%",
                                  strain.p50 * 1e2, strain.p95 * 1e2, strain.p99 * 1e2, strain.max * 1e2));
  page.Entry("folds", report.self_crossing_count == 0 ? "good: the cloth passes through itself nowhere"
                                                      : "the cloth passes through itself at " +
                                                            std::to_string(report.self_crossing_count) + " edges");
  page.Entry("cloth", verdict(report.euler_characteristic == report.expected_euler_characteristic) +
                          Count(report.particle_count) + " particles, " + Count(report.triangle_count) +
                          " triangles, edges of " + Quantity(report.mean_edge_length * 1e3, 1, "mm") +
                          Format("; Euler characteristic %d, expected %d", report.euler_characteristic,
                                 report.expected_euler_characteristic));
}

void WriteCost(const FitReport& report, Page& page) {
  page.Heading("Time and memory");
  std::string times;
  for (const StageTime& time : report.times) {
    times += (times.empty() ? "" : ", ") + time.name + Format(" %.2f s", time.seconds);
  }
  page.Entry("total", Quantity(report.total_seconds, 2, "s") +
                          Format(" on %d thread%s", report.thread_count, report.thread_count == 1 ? "" : "s"));
  if (!times.empty()) page.Entry("of which", times);
  page.Entry("memory", Quantity(static_cast<double>(report.peak_rss_bytes) / 1e6, 0, "MB at most"));
}

}  // namespace

std::string WriteText(const FitReport& report) {
  Page page;
  WriteWhat(report, page);
  WriteVerdictText(report, page);
  if (!report.warnings.empty()) {
    page.Heading("Take care");
    for (const std::string& warning : report.warnings) page.Bullet(warning);
  }
  WriteHow(report, page);
  WriteEase(report, page);
  WriteZonesText(report, page);
  WriteChecks(report, page);
  if (!report.notes.empty()) {
    page.Heading("Good to know");
    for (const std::string& note : report.notes) page.Bullet(note);
  }
  WriteCost(report, page);
  if (!report.files.empty()) {
    page.Heading("Files");
    size_t longest = 0;
    for (const OutputFile& file : report.files) longest = std::max(longest, file.name.size());
    for (const OutputFile& file : report.files) {
      std::string name = file.name;
      name.resize(longest, ' ');
      page.Entry(Printable(name), file.description);
    }
  }
  return page.text();
}

}  // namespace fitroom
