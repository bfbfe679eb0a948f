#include "shop_catalog/garment/drawn_sizes.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>

#include <nlohmann/json.hpp>

#include "common/base/check.h"
#include "shop_catalog/garment/flat_curve.h"
#include "shop_catalog/garment/garment_shape.h"

namespace fitroom::shop_catalog {
namespace {

struct NamedBody {
  const char* name;
  BodyGirths girths;
};

// EN 13402-3, women (unit: centimetre).
constexpr std::array<NamedBody, 10> kNumbers = {{{"6", {80, 64, 88}},
                                                 {"8", {84, 68, 92}},
                                                 {"10", {88, 72, 96}},
                                                 {"12", {92, 76, 100}},
                                                 {"14", {96, 80, 104}},
                                                 {"16", {100, 84, 108}},
                                                 {"18", {104, 88, 112}},
                                                 {"20", {110, 94, 118}},
                                                 {"22", {116, 100, 124}},
                                                 {"24", {122, 106, 132}}}};
constexpr std::array<NamedBody, 6> kLetters = {{{"XS", {78, 62, 86}},
                                                {"S", {86, 70, 94}},
                                                {"M", {94, 78, 102}},
                                                {"L", {102, 86.5, 110.5}},
                                                {"XL", {113, 97, 120}},
                                                {"XXL", {125, 109, 130}}}};

using Measures = std::vector<GarmentMeasure>;

// How much larger than size 12 a body is, in steps of 4 cm of girth.
double Steps(double girth, double of_size_12) { return (girth - of_size_12) / 4.0; }

void Add(Measures& measures, const char* name, double cm) {
  measures.push_back({name, cm / 100.0, Provenance::kStated});
}

// Knits, cut straight: chest 6 % over the bust, never narrower than the hip.
Measures TopMeasures(const BodyGirths& body, bool long_sleeve) {
  const double steps = Steps(body.bust, 92);
  const double chest = 0.5 * 1.06 * body.bust, hip = 0.5 * std::max(1.06 * body.bust, 1.02 * body.hip);
  const double length = 68.0 + 0.7 * steps;
  Measures measures;
  Add(measures, "shoulder_width", 41.2 + 1.0 * steps);
  Add(measures, "chest_width", chest);
  Add(measures, "waist_width", 0.5 * (chest + hip) - 0.5);
  Add(measures, "hip_width", hip);
  Add(measures, "hem_width", hip + 0.3);
  Add(measures, "sleeve_length", long_sleeve ? 59.0 + 0.4 * steps : 21.0 + 0.5 * steps);
  Add(measures, "sleeve_opening", long_sleeve ? 10.2 + 0.3 * steps : 16.4 + 0.7 * steps);
  Add(measures, "neck_width", 18.2 + 0.25 * steps);
  Add(measures, "front_length", length);
  Add(measures, "back_length", length);
  return measures;
}

// A woven dress, semi-fitted: 8 cm of ease at the bust and waist, 8 cm at the hip, flared below.
Measures DressMeasures(const BodyGirths& body, bool sleeved) {
  const double steps = Steps(body.bust, 92);
  const double hip = 0.5 * (body.hip + 8.0), length = 97.0 + 0.8 * steps;
  Measures measures;
  Add(measures, "shoulder_width", (sleeved ? 38.4 : 34.0) + 1.0 * steps);
  Add(measures, "chest_width", 0.5 * (body.bust + 8.0));
  Add(measures, "waist_width", 0.5 * (body.waist + 8.0));
  Add(measures, "hip_width", hip);
  Add(measures, "hem_width", hip + 11.0);
  if (sleeved) {
    Add(measures, "sleeve_length", 19.0 + 0.4 * steps);
    Add(measures, "sleeve_opening", 16.6 + 0.7 * steps);
  }
  Add(measures, "neck_width", 19.6 + 0.25 * steps);
  Add(measures, "front_length", length);
  Add(measures, "back_length", length);
  return measures;
}

// A woven A-line skirt: 2 cm of ease at the waist, 6 cm at the hip.
Measures SkirtMeasures(const BodyGirths& body) {
  const double hip = 0.5 * (body.hip + 6.0);
  Measures measures;
  Add(measures, "waist_width", 0.5 * (body.waist + 2.0));
  Add(measures, "hip_width", hip);
  Add(measures, "hem_width", hip + 9.0);
  Add(measures, "length", 58.0 + 0.5 * Steps(body.hip, 100));
  return measures;
}

// Denim: 2 cm of ease at the waist, 5 cm at the hip; the fork by its rule.
Measures TrouserMeasures(const BodyGirths& body, bool is_short, ForkRule rule) {
  const double steps = Steps(body.hip, 100);
  const double hip = 0.5 * (body.hip + 5.0), depth = 27.0 + 0.4 * steps, inseam = is_short ? 13.0 : 76.0;
  const ForkDraft fork = DraftFork(hip, depth, rule);
  Measures measures;
  Add(measures, "waist_width", 0.5 * (body.waist + 2.0));
  Add(measures, "hip_width", hip);
  Add(measures, "thigh_width", fork.thigh_width);
  Add(measures, "knee_width", is_short ? 27.4 + 1.1 * steps : 22.0 + 0.6 * steps);
  Add(measures, "hem_width", is_short ? 27.4 + 1.05 * steps : 18.5 + 0.4 * steps);
  Add(measures, "front_rise", fork.front_rise);
  Add(measures, "back_rise", fork.back_rise);
  Add(measures, "inseam", inseam);
  Add(measures, "length", depth + inseam);
  if (is_short) {
    // Shorts lie wider than the hip at the crotch's height, and the leg is wider by as much as they show.
    const GarmentShape shape = MakeGarmentShape(GarmentKind::kShorts, measures);
    for (GarmentMeasure& measure : measures) {
      if (measure.name == "thigh_width") measure.value += 0.01 * (AtHeight(shape.side, depth).x() - 0.5 * hip);
    }
  }
  return measures;
}

GarmentSize MakeSize(GarmentKind kind, const NamedBody& body, ForkRule rule) {
  GarmentSize size;
  size.name = body.name;
  size.measures = DrawnMeasures(kind, body.girths, rule);
  size.body = {{"bust", body.girths.bust / 100.0, Provenance::kStated},
               {"waist", body.girths.waist / 100.0, Provenance::kStated},
               {"hip", body.girths.hip / 100.0, Provenance::kStated}};
  return size;
}

nlohmann::ordered_json InCentimetres(const Measures& measures) {
  nlohmann::ordered_json json = nlohmann::ordered_json::object();
  for (const GarmentMeasure& measure : measures) json[measure.name] = std::round(measure.value * 1e4) / 100.0;
  return json;
}

}  // namespace

Measures DrawnMeasures(GarmentKind kind, const BodyGirths& body, ForkRule rule) {
  switch (kind) {
    case GarmentKind::kTShirt:
      return TopMeasures(body, /*long_sleeve=*/false);
    case GarmentKind::kLongSleeve:
      return TopMeasures(body, /*long_sleeve=*/true);
    case GarmentKind::kOnePiece:
      return DressMeasures(body, /*sleeved=*/false);
    case GarmentKind::kSleevedOnePiece:
      return DressMeasures(body, /*sleeved=*/true);
    case GarmentKind::kSkirt:
      return SkirtMeasures(body);
    case GarmentKind::kPants:
      return TrouserMeasures(body, /*is_short=*/false, rule);
    case GarmentKind::kShorts:
      return TrouserMeasures(body, /*is_short=*/true, rule);
  }
  return {};
}

Result<SizeChart> DrawnSizeChart(GarmentKind kind, std::string_view photographed_size, ForkRule rule) {
  SizeChart chart;
  chart.photographed_size = photographed_size;
  for (const NamedBody& body : kNumbers) chart.sizes.push_back(MakeSize(kind, body, rule));
  if (FindSize(chart, photographed_size) != nullptr) return chart;
  chart.sizes.clear();
  for (const NamedBody& body : kLetters) chart.sizes.push_back(MakeSize(kind, body, rule));
  if (FindSize(chart, photographed_size) != nullptr) return chart;
  return InvalidArgument("SIZE_UNKNOWN",
                         "there is no size \"" + std::string(photographed_size.substr(0, 20)) +
                             "\": give 6, 8, … 24 (women's, bust 80 to 122 cm) or XS, S, M, L, XL, XXL");
}

std::string_view DrawnFabric(GarmentKind kind) {
  if (HasLegs(kind)) return "denim";
  if (kind == GarmentKind::kTShirt || kind == GarmentKind::kLongSleeve) return "jersey";
  return "woven";
}

Status ValidateDrawnMeasures(GarmentKind kind, const Measures& measures) {
  const Measures least = DrawnMeasures(kind, kLetters.front().girths, ForkRule::kClose);
  const Measures most = DrawnMeasures(kind, kLetters.back().girths, ForkRule::kClassic);
  FR_CHECK(measures.size() == least.size());
  for (size_t i = 0; i < measures.size(); ++i) {
    FR_CHECK(measures[i].name == least[i].name);
    const double low = least[i].value * 2.0 / 3.0, high = most[i].value * 4.0 / 3.0;
    // Written so that it also fails for NaN.
    if (measures[i].value >= low && measures[i].value <= high) continue;
    std::array<char, 120> text;
    std::snprintf(text.data(), text.size(), "%s %.6g is out of range: give %.0f to %.0f cm", measures[i].name.c_str(),
                  100 * measures[i].value, std::ceil(100 * low), std::floor(100 * high));
    return InvalidArgument("MEASURE_OUT_OF_RANGE", text.data());
  }
  return {};
}

std::string SizeChartAsJson(const SizeChart& chart, std::string_view fabric) {
  nlohmann::ordered_json sizes = nlohmann::ordered_json::array();
  for (const GarmentSize& size : chart.sizes) {
    sizes.push_back(
        {{"name", size.name}, {"measures_cm", InCentimetres(size.measures)}, {"body_cm", InCentimetres(size.body)}});
  }
  const nlohmann::ordered_json json = {
      {"photographed_size", chart.photographed_size}, {"fabric", fabric}, {"sizes", std::move(sizes)}};
  return json.dump(1) + "\n";
}

}  // namespace fitroom::shop_catalog
