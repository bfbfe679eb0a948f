#include "fit_client/report/fit_text.h"

#include "fit_client/report/fit_words.h"

namespace fitroom {

void WriteVerdictText(const FitReport& report, Page& page) {
  if (report.verdict) {
    const SizeVerdict& verdict = *report.verdict;
    page.Heading("How it fits" + (verdict.size.empty() ? std::string() : ", size " + Printable(verdict.size)));
    page.Entry("verdict", VerdictWords(verdict));
    for (const ZoneVerdict& zone : verdict.zones) {
      if (zone.reason.empty() || (verdict.has_deciding_zone && zone.zone == verdict.deciding_zone)) continue;
      page.Entry("also", std::string(FitZoneWords(zone.zone)) + ": " + zone.reason);
    }
  }
  if (report.recommendation) page.Entry("your size", report.recommendation->text);
  if (report.sizes.size() > 1) {
    page.Heading("Sizes");
    for (const SizeVerdict& size : report.sizes) page.Entry(size.size, VerdictWords(size));
  }
  if (report.layers.size() > 1) {
    page.Heading("Worn over each other, from the skin outwards");
    for (const LayerReport& layer : report.layers) {
      page.Entry(layer.kind, layer.garment + (layer.size.empty() ? "" : ", size " + layer.size) +
                                 (layer.verdict.empty() ? "" : ": " + layer.verdict) +
                                 Format(", %.0f mm from what is under it", layer.gap_mean * 1e3) +
                                 (layer.particle_count_inside > 0
                                      ? ", NOT GOOD: " + Count(layer.particle_count_inside) + " particles inside it"
                                      : ""));
    }
  }
}

void WriteZonesText(const FitReport& report, Page& page) {
  if (!report.zones.empty()) {
    page.Heading("Zone by zone" + (report.fabric.empty() ? std::string() : ", " + Printable(report.fabric)));
    page.Line(
        Format("  %-12s%8s%9s%9s%9s  %-23s%s", "", "body", "flat", "worn", "ease", "strain mean/95 %", "pressure"));
    for (const ZoneFit& zone : report.zones) {
      const std::string name(FitZoneWords(zone.zone));
      if (!zone.measured) {
        page.Entry(name, "not measured" + (zone.note.empty() ? std::string() : ": " + zone.note));
        continue;
      }
      std::string line =
          Format("  %-12s%5.1f cm%6.1f cm", name.c_str(), zone.body_girth * 1e2, zone.garment_girth * 1e2);
      line += zone.worn_girth > 0.0 ? Format("%6.1f cm", zone.worn_girth * 1e2) : Format("%9s", "-");
      line += Format("%+6.1f cm", zone.ease() * 1e2);
      if (zone.has_strain) {
        line += Format("  %-23s", Format("%.1f / %.1f %% %s", zone.strain_mean * 1e2, zone.strain_p95 * 1e2,
                                         DirectionWords(zone.strain_angle))
                                      .c_str());
        line += zone.contact_share > 0.02 ? PressureWords(zone.laplace_pressure) : std::string("hangs free");
      }
      while (line.back() == ' ') line.pop_back();
      page.Line(line);
      if (!zone.note.empty()) page.Entry("", zone.note);
    }
  }
  const std::string ruled = MeasuresKnownAs(report, Provenance::kRuled);
  const std::string unknown = MeasuresKnownAs(report, Provenance::kUnknown);
  if (ruled.empty() && unknown.empty()) return;
  page.Heading("How the garment's measures are known");
  if (!ruled.empty()) page.Entry("estimated", ruled + " (by a drafting rule)");
  if (!unknown.empty()) page.Entry("unknown", unknown + " (folding hides it: state it, or photograph it side-folded)");
}

}  // namespace fitroom
