#include "fit_client/report/fit_page.h"

#include <algorithm>
#include <string_view>

#include "fit_client/report/fit_words.h"
#include "fit_client/report/page.h"

namespace fitroom {
namespace {

constexpr std::string_view kStyle = R"(
body { font: 16px/1.5 system-ui, sans-serif; color: #222; background: #fafafa; margin: 0 auto; max-width: 68rem; padding: 1rem; }
h1 { font-size: 1.6rem; } h2 { font-size: 1.2rem; margin-top: 2rem; }
.verdict { font-size: 1.3rem; padding: .6rem 1rem; border-left: .4rem solid #888; background: #fff; }
.good { border-color: #2e7d32; } .tight, .loose { border-color: #e09f1f; }
.does_not_fit { border-color: #b3261e; } .undecided { border-color: #888; }
.warning { background: #fdecea; padding: .5rem 1rem; }
.pictures { display: grid; grid-template-columns: repeat(auto-fill, minmax(14rem, 1fr)); gap: .6rem; }
figure { margin: 0; background: #fff; } figure.wide { grid-column: 1 / -1; }
img { width: 100%; height: auto; display: block; } figcaption { padding: .2rem .6rem; font-size: .85rem; color: #555; }
table { border-collapse: collapse; background: #fff; } td, th { padding: .3rem .7rem; text-align: left; border-bottom: 1px solid #ddd; }
td.n, th.n { text-align: right; font-variant-numeric: tabular-nums; }
.mine { font-weight: 600; background: #eef6ee; } small { color: #666; }
)";

// Text from anywhere as text of a page.
std::string Escaped(std::string_view text) {
  std::string safe;
  for (const char letter : Printable(text)) {
    switch (letter) {
      case '&':
        safe += "&amp;";
        break;
      case '<':
        safe += "&lt;";
        break;
      case '>':
        safe += "&gt;";
        break;
      case '"':
        safe += "&quot;";
        break;
      case '\'':
        safe += "&#39;";
        break;
      default:
        safe += letter;
    }
  }
  return safe;
}

std::string Element(std::string_view name, std::string_view attributes, const std::string& content) {
  return "<" + std::string(name) + (attributes.empty() ? "" : " " + std::string(attributes)) + ">" + content + "</" +
         std::string(name) + ">\n";
}

std::string Named(const FitReport& report) {
  return report.garment_title.empty() ? report.garment : report.garment_title;
}

bool IsPicture(const OutputFile& file) { return file.name.ends_with(".png") || file.name.ends_with(".webp"); }

// The stages' single views are one picture together.
bool IsShown(const OutputFile& file) { return IsPicture(file) && !file.name.starts_with("stage_"); }

// Sheets that are wider than high: the stages, maps and all sizes. They explain what the views show.
bool IsSheet(const OutputFile& file) {
  return file.name == "stages.png" || file.name == "sizes.png" || file.name.starts_with("map_");
}

std::string Pictures(const FitReport& report, bool sheets) {
  std::string figures;
  for (const OutputFile& file : report.files) {
    if (!IsShown(file) || IsSheet(file) != sheets) continue;
    const std::string name = Escaped(file.name), what = Escaped(file.description);
    figures += Element("figure", sheets ? "class=\"wide\"" : "",
                       "<a href=\"" + name + "\"><img src=\"" + name + "\" alt=\"" + what + "\"></a>" +
                           Element("figcaption", "", what));
  }
  return figures.empty() ? "" : Element("div", "class=\"pictures\"", figures);
}

std::string Sizes(const FitReport& report) {
  if (report.sizes.size() < 2) return "";
  std::string rows = Element("tr", "", Element("th", "", "size") + Element("th", "", "how it fits this body"));
  for (const SizeVerdict& size : report.sizes) {
    const bool is_mine = report.recommendation && report.recommendation->found &&
                         (size.size == report.recommendation->size || size.size == report.recommendation->between);
    rows += Element("tr", is_mine ? "class=\"mine\"" : "",
                    Element("td", "", Escaped(size.size)) + Element("td", "", Escaped(VerdictWords(size))));
  }
  return Element("h2", "", "Sizes") + Element("table", "", rows);
}

std::string ZoneRow(const ZoneFit& zone) {
  const auto number = [](double metres, const char* format) {
    return Element("td", "class=\"n\"", Format(format, metres * 1e2));
  };
  std::string row = Element("td", "", std::string(FitZoneWords(zone.zone)));
  if (!zone.measured) {
    return row + Element("td", "colspan=\"6\"",
                         "not measured" + (zone.note.empty() ? std::string() : ": " + Escaped(zone.note)));
  }
  row += number(zone.body_girth, "%.1f") + number(zone.garment_girth, "%.1f");
  row += zone.worn_girth > 0.0 ? number(zone.worn_girth, "%.1f") : Element("td", "class=\"n\"", "&ndash;");
  row += number(zone.ease(), "%+.1f");
  if (!zone.has_strain) return row + Element("td", "", "") + Element("td", "", "");
  return row + Element("td", "class=\"n\"", Format("%.1f %%", zone.strain_p95 * 1e2)) +
         Element("td", "", zone.contact_share > 0.02 ? Escaped(PressureWords(zone.laplace_pressure)) : "hangs free");
}

std::string Zones(const FitReport& report) {
  if (report.zones.empty()) return "";
  std::string head;
  for (const char* title :
       {"zone", "body, cm", "garment flat, cm", "as worn, cm", "room, cm", "stretch (95 %)", "pressure"}) {
    head += Element("th", "", title);
  }
  std::string rows = Element("tr", "", head);
  for (const ZoneFit& zone : report.zones) rows += Element("tr", "", ZoneRow(zone));
  std::string section = Element("h2", "", "Zone by zone") + Element("table", "", rows);
  const std::string ruled = MeasuresKnownAs(report, Provenance::kRuled);
  const std::string unknown = MeasuresKnownAs(report, Provenance::kUnknown);
  if (!ruled.empty()) section += Element("p", "", "Estimated by a drafting rule: " + Escaped(ruled) + ".");
  if (!unknown.empty()) section += Element("p", "", "Not known, because folding hides it: " + Escaped(unknown) + ".");
  return section;
}

std::string GarmentSection(const FitReport& report) {
  std::string section = Element("h2", "", Escaped(Named(report)));
  if (report.verdict) {
    const std::string size = report.verdict->size.empty() ? "" : "size " + Escaped(report.verdict->size) + ": ";
    section += Element("p", "class=\"verdict " + std::string(FitVerdictName(report.verdict->verdict)) + "\"",
                       size + Escaped(VerdictWords(*report.verdict)));
  }
  if (report.recommendation) {
    section += Element("p", "", "Your size: " + Element("b", "", Escaped(report.recommendation->text)));
  }
  if (!report.finished) section += Element("p", "class=\"warning\"", Escaped(report.finishing_text));
  for (const std::string& warning : report.warnings) section += Element("p", "class=\"warning\"", Escaped(warning));
  section += Sizes(report) + Zones(report);
  for (const std::string& note : report.notes) section += Element("p", "", Element("small", "", Escaped(note)));
  return section;
}

}  // namespace

std::string WriteFitPage(std::span<const FitReport> garments) {
  std::string title;
  for (const FitReport& report : garments) title += (title.empty() ? "" : ", ") + Escaped(Named(report));
  const std::string body = garments.empty() ? "" : Escaped(garments.front().body);
  std::string page = Element("h1", "", title + " on " + body);
  if (!garments.empty()) page += Pictures(garments.back(), /*sheets=*/false);
  for (const FitReport& report : garments) page += GarmentSection(report);
  if (!garments.empty()) {
    page += Element("h2", "", "How it was put on and how it lies") + Pictures(garments.back(), /*sheets=*/true);
    std::string links;
    for (const OutputFile& file : garments.back().files) {
      if (IsPicture(file)) continue;
      links += Element(
          "li", "",
          Element("a", "href=\"" + Escaped(file.name) + "\"", Escaped(file.name)) + ": " + Escaped(file.description));
    }
    page += Element("h2", "", "Files") + Element("ul", "", links);
    page += Element("p", "",
                    Element("small", "",
                            "fitroom " + Escaped(garments.back().program_version) +
                                ". Made on this computer; nothing was sent anywhere."));
  }
  return "<!doctype html>\n<html lang=\"en\"><head><meta charset=\"utf-8\">"
         "<meta name=\"viewport\" content=\"width=device-width\">"
         "<meta http-equiv=\"Content-Security-Policy\" content=\"default-src 'none'; img-src 'self' file:; "
         "style-src 'unsafe-inline'\">\n" +
         Element("title", "", title + " on " + body) + Element("style", "", std::string(kStyle)) + "</head><body>\n" +
         page + "</body></html>\n";
}

}  // namespace fitroom
