#include "fit_client/fitting/judge_fit.h"

#include <utility>
#include <vector>

#include "fit_client/fit/measure/size_verdict.h"

namespace fitroom {
namespace {

// The measures of another size: what the chart says, and what it does not say as the photographed size differs from it.
std::vector<GarmentMeasure> MeasuresOfSize(const FittedGarment& fitted, const GarmentSize& size) {
  const SizeChart& chart = fitted.input->garment.chart;
  const GarmentSize* worn = FindSize(chart, fitted.cut.size);
  std::vector<GarmentMeasure> measures = fitted.cut.measures;
  for (GarmentMeasure& measure : measures) {
    const GarmentMeasure* to = FindMeasure(size.measures, measure.name);
    const GarmentMeasure* from = worn != nullptr ? FindMeasure(worn->measures, measure.name) : nullptr;
    if (to == nullptr) continue;
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

}  // namespace

const Fabric& FabricOf(const Garment& garment) {
  const Fabric* fabric = FindFabric(garment.fabric);
  return fabric != nullptr ? *fabric : FabricPresets().front();
}

void JudgeWorn(const Body& body, const DressingFacts& facts, FittedGarment& fitted) {
  const Garment& garment = fitted.input->garment;
  const Fabric& fabric = FabricOf(garment);
  AssessInput input;
  input.kind = garment.kind;
  input.fabric = &fabric;
  input.cloth = &fitted.cut.cloth;
  input.positions = &fitted.stages.final;
  input.body = &body;
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
  verdict.unknown = UnknownDimensions(garment.kind, fitted.cut.measures);
  const size_t index = IndexOf(garment.chart, fitted.cut.size);
  if (index < garment.chart.sizes.size()) verdict.intended = IntendedGirths(garment.chart, index);
  fitted.report.verdict = JudgeSize(verdict);
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
    verdict.unknown = UnknownDimensions(garment.kind, measures);
    verdict.intended = IntendedGirths(garment.chart, i);
    fitted.report.sizes.push_back(JudgeSize(verdict));
  }
  if (!fitted.report.sizes.empty()) fitted.report.recommendation = Recommend(fitted.report.sizes);
}

}  // namespace fitroom
