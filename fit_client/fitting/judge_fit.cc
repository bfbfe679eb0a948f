#include "fit_client/fitting/judge_fit.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>
#include <utility>
#include <vector>

#include "fit_client/fit/measure/size_verdict.h"

namespace fitroom {
namespace {

// How much wider another size is than the worn one, by the widths that the chart gives for both; 1 if it gives none.
double WidthRatio(const GarmentSize* worn, const GarmentSize& size) {
  double sum = 0.0;
  int count = 0;
  for (const GarmentMeasure& to : size.measures) {
    const GarmentMeasure* from = worn != nullptr ? FindMeasure(worn->measures, to.name) : nullptr;
    if (from == nullptr || !(from->value > 0.0) || !to.name.ends_with("_width")) continue;
    sum += to.value / from->value;
    ++count;
  }
  return count > 0 ? sum / count : 1.0;
}

// The measures of another size: what the chart says, by its difference to the worn size; widths that it does not give
// follow the others in proportion, and are unknown where it gives no width at all.
std::vector<GarmentMeasure> MeasuresOfSize(const FittedGarment& fitted, const GarmentSize& size) {
  const SizeChart& chart = fitted.input->garment.chart;
  const GarmentSize* worn = FindSize(chart, fitted.cut.size);
  const double ratio = WidthRatio(worn, size);
  std::vector<GarmentMeasure> measures = fitted.cut.measures;
  for (GarmentMeasure& measure : measures) {
    const GarmentMeasure* to = FindMeasure(size.measures, measure.name);
    const GarmentMeasure* from = worn != nullptr ? FindMeasure(worn->measures, measure.name) : nullptr;
    if (to == nullptr) {
      if (!measure.name.ends_with("_width") || measure.provenance == Provenance::kUnknown) continue;
      measure.value *= ratio;
      measure.provenance = ratio == 1.0 ? Provenance::kUnknown : Provenance::kRuled;
      continue;
    }
    measure.value = from != nullptr ? measure.value + to->value - from->value : to->value;
    measure.provenance = Provenance::kStated;
  }
  return measures;
}

size_t IndexOf(const SizeChart& chart, const std::string& size) {
  for (size_t i = 0; i < chart.sizes.size(); ++i) {
    if (chart.sizes[i].name == size) return i;
  }
  return chart.sizes.size();
}

// The measured zone nearest to the widest open seam.
FitZone ZoneOfOpenSeam(const FittedGarment& fitted) {
  const std::vector<Eigen::Vector3d>& places = fitted.stages.final;
  const std::vector<double>& left = fitted.cut.cloth.left_sleeve_weights;
  const std::vector<double>& right = fitted.cut.cloth.right_sleeve_weights;
  double widest = -1.0;
  double height = 0.0;
  bool is_sleeve = false;
  for (const SeamPair& pair : fitted.cut.cloth.seams) {
    const Eigen::Vector3d& a = places[static_cast<size_t>(pair.a)];
    const Eigen::Vector3d& b = places[static_cast<size_t>(pair.b)];
    if ((a - b).norm() <= widest) continue;
    widest = (a - b).norm();
    height = 0.5 * (a.y() + b.y());
    const size_t vertex = static_cast<size_t>(pair.a);
    is_sleeve = left.size() == places.size() && right.size() == places.size() && left[vertex] + right[vertex] > 0.5;
  }
  if (is_sleeve) return FitZone::kUpperArm;
  FitZone nearest = PrimaryZone(fitted.input->garment.kind);
  double distance = std::numeric_limits<double>::infinity();
  for (const ZoneFit& zone : fitted.report.zones) {
    if (!zone.measured || std::abs(zone.height - height) >= distance) continue;
    distance = std::abs(zone.height - height);
    nearest = zone.zone;
  }
  return nearest;
}

// Another size lies over the same garments as the worn one.
void TakeLayers(const std::vector<ZoneFit>& worn, std::vector<ZoneFit>& zones) {
  for (ZoneFit& zone : zones) {
    const auto same =
        std::find_if(worn.begin(), worn.end(), [&zone](const ZoneFit& other) { return other.zone == zone.zone; });
    if (same != worn.end()) zone.layered_girth = same->layered_girth;
  }
}

// What else helps where cloth is caught on the body. By girth alone: a size that is too large tears as well.
std::string OtherSizeAdvice(const SizeVerdict& verdict) {
  switch (verdict.verdict) {
    case FitVerdict::kTight:
    case FitVerdict::kDoesNotFit:
      return ", or take a larger size (" + verdict.reason + ")";
    case FitVerdict::kLoose:
      return ", or take a smaller size (" + verdict.reason + ")";
    default:
      return "";
  }
}

}  // namespace

const Fabric& FabricOf(const Garment& garment) {
  const Fabric* fabric = FindFabric(garment.fabric);
  return fabric != nullptr ? *fabric : FabricPresets().front();
}

void JudgeWorn(const Body& body, std::span<const WornGarment> layers, const DressingFacts& facts,
               FittedGarment& fitted) {
  const Garment& garment = fitted.input->garment;
  const Fabric& fabric = FabricOf(garment);
  AssessInput input;
  input.kind = garment.kind;
  input.fabric = &fabric;
  input.cloth = &fitted.cut.cloth;
  input.positions = &fitted.stages.final;
  input.body = &body;
  for (const WornGarment& layer : layers) input.layers.push_back(&layer.surface);
  input.measures = fitted.cut.measures;
  FitAssessment assessment = AssessFit(input);
  fitted.maps = std::move(assessment.maps);
  fitted.report.zones = std::move(assessment.zones);
  fitted.report.fabric = fabric.name;
  fitted.report.measures = fitted.cut.measures;

  VerdictInput verdict;
  verdict.size = fitted.cut.size;
  verdict.kind = garment.kind;
  verdict.fabric = fabric;
  verdict.zones = fitted.report.zones;
  verdict.facts = facts;
  if (facts.open_gap > 0.0) verdict.facts.open_zone = ZoneOfOpenSeam(fitted);
  verdict.unknown = UnknownDimensions(garment.kind, fitted.cut.measures);
  const size_t index = IndexOf(garment.chart, fitted.cut.size);
  if (index < garment.chart.sizes.size()) verdict.intended = IntendedGirths(garment.chart, index);
  fitted.report.verdict = JudgeSize(verdict);
  // The drape knows of no zones: the verdict's sentence says where.
  if (!facts.open_seam.empty()) {
    char gap[48];
    std::snprintf(gap, sizeof(gap), "; the seam gapes by %.0f mm", 1000.0 * fitted.report.seams.max);
    fitted.report.finishing_text = fitted.report.verdict->reason + gap;
  }
  if (fitted.report.finishing_reason == "CAUGHT_ON_BODY") {
    fitted.report.finishing_text += OtherSizeAdvice(*fitted.report.verdict);
  }
}

void JudgeChart(const Body& body, FittedGarment& fitted) {
  const Garment& garment = fitted.input->garment;
  fitted.report.sizes.clear();
  for (size_t i = 0; i < garment.chart.sizes.size(); ++i) {
    const GarmentSize& size = garment.chart.sizes[i];
    if (size.name == fitted.cut.size && fitted.report.verdict) {
      fitted.report.sizes.push_back(*fitted.report.verdict);
      continue;
    }
    VerdictInput verdict;
    verdict.size = size.name;
    verdict.kind = garment.kind;
    verdict.fabric = FabricOf(garment);
    const std::vector<GarmentMeasure> measures = MeasuresOfSize(fitted, size);
    verdict.zones = ZonesFromMeasures(garment.kind, measures, body);
    TakeLayers(fitted.report.zones, verdict.zones);
    verdict.unknown = UnknownDimensions(garment.kind, measures);
    verdict.intended = IntendedGirths(garment.chart, i);
    fitted.report.sizes.push_back(JudgeSize(verdict));
  }
  if (!fitted.report.sizes.empty()) fitted.report.recommendation = Recommend(fitted.report.sizes);
}

}  // namespace fitroom
