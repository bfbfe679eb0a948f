#include "fit_client/report/fit_report.h"

#include <algorithm>
#include <limits>
#include <sstream>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "fit_client/report/fit_page.h"

namespace fitroom {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

FitReport MakeReport() {
  FitReport report;
  report.program_version = "1.2.3";
  report.body = "p001";
  report.body_stature = 1.612;
  report.body_triangle_count = 257308;
  report.garment = "cubes";
  report.garment_title = "White cubes";
  report.garment_kind = "tshirt";
  report.garment_length = 0.68;
  report.profile = "standard";
  report.thread_count = 2;
  report.finished = true;
  report.finishing_reason = "AT_REST";
  report.finishing_text = "The shoulders lie on the body and 98.6 % of the particles rest.";
  report.stages = {{"stitching", "all seams closed", 1212}};
  report.residuals = {{"shoulder points to body", "shoulder_distance", 0.004, 0.005, "m"},
                      {"speed of 98.5 % of the particles", "speed_p985", 0.03, 0.018, "m/s"}};
  report.seams = {412, 0, 0.0001, 0.0002, 0.0004};
  report.penetration = {0, 16000, 3, 0.0007};
  report.strain = {0.01, 0.03, 0.06, 0.12};
  report.ease = {{"bust", true, 1.18, 0.98, 0.86, ""}, {"hip", false, 0, 0, 0, "the garment ends above it"}};
  report.euler_characteristic = -2;
  report.expected_euler_characteristic = -2;
  report.particle_count = 8574;
  report.triangle_count = 16500;
  report.mean_edge_length = 0.01;
  report.substep_count = 2000;
  report.times = {{"drape", 1.5}, {"pictures", 0.75}};
  report.total_seconds = 3.25;
  report.peak_rss_bytes = 321000000;
  report.warnings = {"The hem was cropped."};
  report.files = {{"front.png", "front view", 123456}};
  return report;
}

TEST(FitReportJson, HoldsTheValuesInTheUnitsOfItsNames) {
  const nlohmann::json json = nlohmann::json::parse(WriteJson(MakeReport()));
  EXPECT_NEAR(json["body"]["stature_cm"].get<double>(), 161.2, 1e-9);
  EXPECT_NEAR(json["garment"]["length_cm"].get<double>(), 68.0, 1e-9);
  EXPECT_NEAR(json["seams"]["gap_p95_mm"].get<double>(), 0.2, 1e-12);
  EXPECT_NEAR(json["penetration"]["deepest_mm"].get<double>(), 0.7, 1e-12);
  EXPECT_NEAR(json["strain"]["p95_percent"].get<double>(), 3.0, 1e-12);
  EXPECT_NEAR(json["ease"]["bust"]["ease_cm"].get<double>(), 12.0, 1e-9);
  EXPECT_NEAR(json["ease"]["bust"]["ease_percent"].get<double>(), 100.0 * 0.12 / 0.86, 1e-9);
  EXPECT_NEAR(json["peak_rss_mb"].get<double>(), 321.0, 1e-9);
  EXPECT_EQ(json["penetration"]["triangle_sample_count_inside"], 3);
  EXPECT_EQ(json["finishing_reason"], "AT_REST");
  EXPECT_EQ(json["finished"], true);
  EXPECT_EQ(json["files"][0]["size_bytes"], 123456);
  EXPECT_EQ(json["times"][1]["name"], "pictures");
  EXPECT_EQ(json["mesh"]["euler_characteristic"], -2);
}

TEST(FitReportJson, APlaceThatWasNotMeasuredHasNoNumbers) {
  const nlohmann::json json = nlohmann::json::parse(WriteJson(MakeReport()));
  EXPECT_EQ(json["ease"]["hip"]["measured"], false);
  EXPECT_FALSE(json["ease"]["hip"].contains("ease_cm"));
  EXPECT_EQ(json["ease"]["hip"]["note"], "the garment ends above it");
}

TEST(FitReportJson, StaysJsonWhateverComesIn) {
  FitReport report = MakeReport();
  report.garment_title = "\xFF\xFE \"quoted\"\n";
  report.strain.max = std::numeric_limits<double>::quiet_NaN();
  report.residuals[0].value = std::numeric_limits<double>::infinity();
  const nlohmann::json json = nlohmann::json::parse(WriteJson(report));
  EXPECT_TRUE(json["strain"]["max_percent"].is_null());
  EXPECT_TRUE(json["residuals"][0]["value"].is_null());
  EXPECT_EQ(json["residuals"][0]["met"], false);
}

TEST(FitReportText, SaysWhatAShopperAsks) {
  const std::string text = WriteText(MakeReport());
  EXPECT_THAT(text, HasSubstr("Fit of White cubes on p001\n"));
  EXPECT_THAT(text, HasSubstr("Result: worn and at rest"));
  EXPECT_THAT(text, HasSubstr("98.0 cm"));
  EXPECT_THAT(text, HasSubstr("+12.0 cm"));
  EXPECT_THAT(text, HasSubstr("+14.0 %"));
  EXPECT_THAT(text, HasSubstr("not measured: the garment ends above it"));
  EXPECT_THAT(text, HasSubstr("257,308 triangles"));
  EXPECT_THAT(text, HasSubstr("3.25 s on 2 threads"));
  EXPECT_THAT(text, HasSubstr("The hem was cropped."));
}

TEST(FitReportText, DoesNotCallGoodWhatIsNot) {
  FitReport report = MakeReport();
  // Three points inside the body, and a residual above its limit, are in the report already.
  EXPECT_THAT(WriteText(report), HasSubstr("NOT GOOD: 0 of 8,574 particles, 3 of 16,000 points"));
  EXPECT_THAT(WriteText(report), HasSubstr("NOT MET: 30 mm/s, limit 18 mm/s"));
  report.penetration = {0, 16000, 3, 0.0001};
  report.residuals.clear();
  EXPECT_THAT(WriteText(report), Not(HasSubstr("NOT")));
  report.seams.max = 0.0006;
  EXPECT_THAT(WriteText(report), HasSubstr("NOT GOOD: 412 pairs, 0 open"));
  report.seams.max = 0.0004;
  report.seams.open_pair_count = 1;
  EXPECT_THAT(WriteText(report), HasSubstr("NOT GOOD: 412 pairs, 1 open"));
  report.seams.open_pair_count = 0;
  report.strain.p95 = 0.051;
  EXPECT_THAT(WriteText(report), HasSubstr("NOT GOOD: half below"));
  report.strain.p95 = 0.03;
  report.euler_characteristic = -1;
  EXPECT_THAT(WriteText(report), HasSubstr("NOT GOOD: 8,574 particles"));
  report.finished = false;
  EXPECT_THAT(WriteText(report), HasSubstr("Result: NOT FINISHED"));
}

TEST(FitReportText, FitsATerminalAndCannotSteerIt) {
  FitReport report = MakeReport();
  report.finishing_text =
      "The seams do not close: a gap of 31 mm stays at the left underarm, at a height of 128 cm, "
      "because the garment is too small for this body by more than its cloth can stretch.";
  report.garment_title =
      "red \x1B[31mred\x07 \xC2\x9B"
      "31m";
  report.notes = {std::string(300, 'x') + " tail"};
  const std::string text = WriteText(report);
  for (const char c : text) EXPECT_TRUE(c == '\n' || static_cast<unsigned char>(c) >= 0x20);
  EXPECT_THAT(text, Not(HasSubstr("\xC2\x9B")));
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) {
    const bool is_one_long_word = line.find("xxx") != std::string::npos;
    EXPECT_TRUE(is_one_long_word || line.size() <= 100U) << line;
  }
  EXPECT_EQ(text.back(), '\n');
}

ZoneFit MakeZone() {
  ZoneFit zone;
  zone.zone = FitZone::kHip;
  zone.measured = true;
  zone.height = 0.80;
  zone.body_girth = 0.96;
  zone.garment_girth = 0.991;
  zone.worn_girth = 0.993;
  zone.has_strain = true;
  zone.strain_mean = 0.011;
  zone.strain_p95 = 0.034;
  zone.strain_angle = 0.1;
  zone.contact_share = 0.5;
  zone.laplace_pressure = 930.0;
  zone.contact_pressure = 910.0;
  return zone;
}

FitReport MakeJudgedReport() {
  FitReport report = MakeReport();
  report.fabric = "woven";
  ZoneFit thigh;
  thigh.zone = FitZone::kThigh;
  thigh.provenance = Provenance::kUnknown;
  thigh.note = "the garment's thigh is not known";
  report.zones = {MakeZone(), thigh};
  SizeVerdict verdict;
  verdict.size = "M";
  verdict.verdict = FitVerdict::kTight;
  verdict.has_deciding_zone = true;
  verdict.deciding_zone = FitZone::kHip;
  verdict.reason = "tight at the hip: 2 cm less than the 5 cm a woven needs";
  verdict.is_close = true;
  verdict.has_primary = true;
  verdict.primary_offset = 0.02;
  SizeVerdict larger = verdict;
  larger.size = "L";
  larger.verdict = FitVerdict::kGood;
  larger.reason = "6 cm of room at the hip";
  larger.is_close = false;
  report.verdict = verdict;
  report.sizes = {verdict, larger};
  report.recommendation = SizeRecommendation{true, "L", "M", "between M and L"};
  report.measures = {
      {"hip_width", 0.4955}, {"thigh_width", 0.0, Provenance::kUnknown}, {"back_rise", 0.36, Provenance::kRuled}};
  report.layers = {{"jeans", "pants", "M", "AT_REST", "good", 0.004, 0},
                   {"tee", "tshirt", "S", "AT_REST", "", 0.012, 3}};
  return report;
}

TEST(FitReportJson, SaysHowItFitsZoneByZoneAndSizeBySize) {
  const nlohmann::json json = nlohmann::json::parse(WriteJson(MakeJudgedReport()));
  EXPECT_EQ(json["zones"][0]["zone"], "hip");
  EXPECT_NEAR(json["zones"][0]["ease_cm"].get<double>(), 3.1, 1e-9);
  EXPECT_NEAR(json["zones"][0]["worn_ease_cm"].get<double>(), 3.3, 1e-9);
  EXPECT_NEAR(json["zones"][0]["strain"]["p95_percent"].get<double>(), 3.4, 1e-9);
  EXPECT_NEAR(json["zones"][0]["pressure"]["laplace_kpa"].get<double>(), 0.93, 1e-9);
  EXPECT_EQ(json["zones"][0]["pressure"]["band"], "comfortable");
  EXPECT_EQ(json["zones"][1]["provenance"], "unknown");
  EXPECT_FALSE(json["zones"][1].contains("ease_cm"));
  EXPECT_EQ(json["verdict"]["verdict"], "tight");
  EXPECT_EQ(json["verdict"]["deciding_zone"], "hip");
  EXPECT_NEAR(json["verdict"]["uncertainty_mm"].get<double>(), 14.35, 0.01);
  EXPECT_EQ(json["sizes"].size(), 2U);
  EXPECT_EQ(json["recommendation"]["between"], "M");
  EXPECT_EQ(json["measures"][2]["provenance"], "ruled");
  EXPECT_EQ(json["layers"][1]["particle_count_inside"], 3);
  // A fit that nobody judged says so, under the same names.
  const nlohmann::json plain = nlohmann::json::parse(WriteJson(MakeReport()));
  EXPECT_TRUE(plain["verdict"].is_null());
  EXPECT_TRUE(plain["recommendation"].is_null());
  EXPECT_TRUE(plain["sizes"].empty());
}

TEST(FitReportText, TellsTheShopperFirst) {
  const std::string text = WriteText(MakeJudgedReport());
  EXPECT_THAT(text, HasSubstr("How it fits, size M\n"));
  EXPECT_THAT(text, HasSubstr("tight at the hip: 2 cm less than the 5 cm a woven needs"));
  EXPECT_THAT(text, HasSubstr("a close call"));
  EXPECT_THAT(text, HasSubstr("between M and L"));
  EXPECT_LT(text.find("between M and L"), text.find("Zone by zone, woven"));
  EXPECT_THAT(text, HasSubstr("comfortable (0.4-1.3)"));
  EXPECT_THAT(text, Not(HasSubstr("0.93")));  // A band, never two digits.
  EXPECT_THAT(text, HasSubstr("not measured: the garment's thigh is not known"));
  EXPECT_THAT(text, HasSubstr("back rise (by a drafting rule)"));
  EXPECT_THAT(text, HasSubstr("thigh width (folding hides it"));
  EXPECT_THAT(text, HasSubstr("NOT GOOD: 3 particles inside it"));
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) EXPECT_LE(line.size(), 100U) << line;
}

TEST(FitReportText, AnEmptyReportIsStillAReport) {
  EXPECT_THAT(WriteText(FitReport()), HasSubstr("Result: NOT FINISHED"));
  EXPECT_FALSE(nlohmann::json::parse(WriteJson(FitReport())).empty());
}

// Every element that is opened is closed, in order; those without content are left out.
bool IsBalanced(const std::string& page) {
  std::vector<std::string> open;
  for (size_t at = page.find('<'); at != std::string::npos; at = page.find('<', at + 1)) {
    const size_t end = page.find_first_of(" >", at);
    const std::string name = page.substr(at + 1, end - at - 1);
    if (name == "!doctype" || name == "meta" || name == "img") continue;
    if (!name.starts_with("/")) {
      open.push_back(name);
    } else {
      if (open.empty() || open.back() != name.substr(1)) return false;
      open.pop_back();
    }
  }
  return open.empty();
}

TEST(FitReportPage, ShowsEveryPictureAndLinksEveryFile) {
  FitReport report = MakeReport();
  report.files = {{"front.png", "front view", 10}, {"map_strain.png", "stretch", 10}, {"fitted.glb", "3D model", 10}};
  const std::string page = WriteFitPage(std::vector<FitReport>{report});
  EXPECT_TRUE(IsBalanced(page));
  EXPECT_THAT(page, HasSubstr("<img src=\"front.png\""));
  EXPECT_THAT(page, HasSubstr("<img src=\"map_strain.png\""));
  EXPECT_THAT(page, HasSubstr("href=\"fitted.glb\""));
  EXPECT_THAT(page, Not(HasSubstr("<img src=\"fitted.glb\"")));
  EXPECT_THAT(page, HasSubstr("White cubes"));
}

TEST(FitReportPage, NothingFromOutsideBecomesMarkup) {
  FitReport report = MakeReport();
  const std::string hostile = "\"><script>alert('1')</script>&\x1b[2J";
  report.garment_title = hostile;
  report.body = hostile;
  report.warnings = {hostile};
  report.finished = false;
  report.finishing_text = hostile;
  SizeVerdict verdict;
  verdict.size = hostile;
  verdict.reason = hostile;
  report.verdict = verdict;
  report.sizes = {verdict, verdict};
  report.files = {{hostile, hostile, 1}};
  const std::string page = WriteFitPage(std::vector<FitReport>{report});
  EXPECT_TRUE(IsBalanced(page));
  EXPECT_THAT(page, Not(HasSubstr("<script")));
  EXPECT_THAT(page, Not(HasSubstr("\x1b")));
  EXPECT_THAT(page, Not(HasSubstr("http://")));
  EXPECT_TRUE(IsBalanced(WriteFitPage({})));
}

// Whatever stands in the words from outside, the page has the marks of its own markup, no more and no fewer.
TEST(FitReportPage, WordsFromOutsideAddNoMarks) {
  const auto page_of = [](const std::string& words) {
    FitReport report = MakeReport();
    report.garment_title = report.body = report.program_version = words;
    report.warnings = report.notes = {words};
    report.finished = false;
    report.finishing_text = words;
    SizeVerdict verdict;
    verdict.size = verdict.reason = words;
    report.verdict = verdict;
    report.sizes = {verdict, verdict};
    report.recommendation = SizeRecommendation{true, words, "", words};
    ZoneFit zone;
    zone.note = words;
    report.zones = {zone};
    report.measures = {{words, 0.5, Provenance::kRuled}, {words, 0.0, Provenance::kUnknown}};
    report.files = {{words, words, 1}, {words + ".png", words, 1}, {"map_" + words + ".png", words, 1}};
    return WriteFitPage(std::vector<FitReport>{report});
  };
  const std::string harmless = page_of("words"), hostile = page_of("<b>\"it's\"</b> x=y");
  for (const char mark : {'<', '>', '"', '\''}) {
    EXPECT_EQ(std::count(hostile.begin(), hostile.end(), mark), std::count(harmless.begin(), harmless.end(), mark))
        << mark;
  }
}

}  // namespace
}  // namespace fitroom
