#include "fit_client/fitting/fit_outfit.h"

#include <algorithm>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "fit_client/fit/collision/body_repair.h"
#include "fit_client/fit/stages/press_under.h"
#include "fit_client/fit/stages/tuck_in.h"
#include "fit_client/fitting/describe_fit.h"
#include "fit_client/fitting/dress_by_profile.h"
#include "fit_client/fitting/judge_fit.h"

namespace fitroom {
namespace {

DressingFacts FactsOf(const Dressing& dressed) {
  DressingFacts facts;
  if (dressed.report.outcome == DrapeOutcome::kSeamsOpen) facts.open_gap = dressed.report.final_seam_gap_max;
  if (!dressed.report.openings.empty()) {
    const SeamOpening& widest = dressed.report.openings.front();
    facts.open_gap = widest.lacking_girth;
    facts.open_seam = OpeningName(widest);
    facts.open_length = widest.seam_length;
  }
  if (dressed.bottom) {
    facts.rise_short = dressed.bottom->rise_short;
    facts.is_belted = dressed.bottom->belt.ease() > 0.0;
  }
  return facts;
}

// Gives every report the list of all garments, the innermost first.
void ListLayers(Outfit& outfit) {
  std::vector<LayerReport> layers;
  for (const FittedGarment& worn : outfit.garments) {
    LayerReport layer;
    layer.garment = worn.report.garment;
    layer.kind = worn.report.garment_kind;
    layer.size = worn.cut.size;
    layer.outcome = worn.report.finishing_reason;
    if (worn.report.verdict) layer.verdict = FitVerdictName(worn.report.verdict->verdict);
    for (const double gap : worn.maps.gap) layer.gap_mean += gap / static_cast<double>(worn.maps.gap.size());
    layer.particle_count_inside = worn.report.penetration.particle_count_inside;
    layers.push_back(layer);
  }
  for (FittedGarment& worn : outfit.garments) worn.report.layers = layers;
}

// Tucks the tops that are worn already into the bottom that comes next, and closes them anew.
Status TuckInTops(const BodyInput& body, const CutGarment& bottom, const FitOptions& options, Executor& executor,
                  Outfit& outfit, std::vector<WornGarment>& worn_already) {
  for (size_t i = 0; i < outfit.garments.size(); ++i) {
    FittedGarment& worn = outfit.garments[i];
    if (worn.cut.kind != GarmentKind::kTShirt && worn.cut.kind != GarmentKind::kLongSleeve) continue;
    const DressedBody wearer{body.body, outfit.body_surface, std::span(worn_already).first(i)};
    DressingOptions tucking = options.dressing;
    tucking.drape.material = DrapeMaterial(FabricOf(worn.input->garment));
    FR_ASSIGN_OR_RETURN(DrapeResult tucked,
                        TuckIn(worn.cut.cloth, worn.stages.final, bottom.cloth, wearer, tucking, executor));
    worn.stages.final = std::move(tucked.positions);
    DescribeTuck(tucked.report, worn.report);
    FR_ASSIGN_OR_RETURN(worn_already[i], MakeWornGarment(worn.cut.kind, worn.cut.cloth, worn.stages.final));
  }
  return Status();
}

// Presses what yields under the garment that has just been put on over it, from the outermost inwards.
Status PressWorn(const BodyInput& body, const FittedGarment& over, const FitOptions& options, Executor& executor,
                 Outfit& outfit, std::vector<WornGarment>& worn_already) {
  const FittedGarment* outer = &over;
  for (size_t i = outfit.garments.size(); i-- > 0;) {
    FittedGarment& worn = outfit.garments[i];
    if (!YieldsToWhatIsOver(worn.cut.kind)) continue;
    const DressedBody wearer{body.body, outfit.body_surface, std::span(worn_already).first(i)};
    FR_ASSIGN_OR_RETURN(worn.stages.final,
                        PressUnder({worn.cut.cloth, worn.stages.final}, {outer->cut.cloth, outer->stages.final}, wearer,
                                   options.dressing.field_pitch, executor));
    FR_ASSIGN_OR_RETURN(worn_already[i], MakeWornGarment(worn.cut.kind, worn.cut.cloth, worn.stages.final));
    outer = &worn;
  }
  return Status();
}

// What the cutting and the body's repair, which know nothing of each other, leave behind.
struct Preparation {
  TriangleMesh body_surface;
  std::vector<CutGarment> cuts;  // One a layer.
};

// Repairs the body and cuts all garments, side by side.
Result<Preparation> Prepare(const BodyInput& body, const std::vector<Layer>& layers, const FitOptions& options,
                            Executor& executor) {
  const bool is_standard = options.profile == FitProfile::kStandard;
  std::optional<Result<TriangleMesh>> repaired;
  std::vector<std::optional<Result<CutGarment>>> cuts(layers.size());
  executor.Run(static_cast<int>(layers.size()) + 1, [&](int task) {
    if (task == 0) {
      repaired = RepairBody(body.body.mesh);
      return;
    }
    const size_t index = static_cast<size_t>(task) - 1;
    cuts[index] = CutGarmentToSize(
        layers[index].garment->garment,
        {options.pitch, layers[index].size, is_standard, options.fork_rule, options.coarse_to_fine && is_standard});
  });
  Preparation prepared;
  FR_ASSIGN_OR_RETURN(prepared.body_surface, std::move(*repaired));
  for (size_t index = 0; index < layers.size(); ++index) {
    if (!cuts[index]->ok()) return cuts[index]->status().At(layers[index].garment->garment.id);
    prepared.cuts.push_back(std::move(*cuts[index]).value());
  }
  return prepared;
}

// Measures garments once what they lie on and what they look like is settled: several, and the two halves of each, side
// by side. Refers to all it was given.
class Measuring {
 public:
  Measuring(const BodyInput& body, Executor& executor, Stopwatch& stopwatch)
      : body_(body), executor_(executor), stopwatch_(stopwatch) {}

  // The outfit's next garment has been dressed, with these facts.
  void Expect(DressingFacts facts) { facts_.push_back(std::move(facts)); }

  // Measures every garment of the outfit that has not been; `worn_already` holds what each lies on, as it is now.
  void CatchUp(const std::vector<WornGarment>& worn_already, Outfit& outfit) {
    const size_t begin = measured_count_;
    if (begin == outfit.garments.size()) return;
    executor_.Run(static_cast<int>(2 * (outfit.garments.size() - begin)), [&](int task) {
      const size_t index = begin + static_cast<size_t>(task) / 2;
      FittedGarment& worn = outfit.garments[index];
      // The halves fill different parts of one report.
      if (task % 2 == 1) {
        DescribeEase(body_.body.measurements, outfit.body_surface, worn);
      } else {
        JudgeWorn(body_.body, std::span(worn_already).first(index), facts_[index], worn);
        JudgeChart(body_.body, worn);
      }
    });
    measured_count_ = outfit.garments.size();
    stopwatch_.Lap("measuring");
  }

 private:
  const BodyInput& body_;
  Executor& executor_;
  Stopwatch& stopwatch_;
  std::vector<DressingFacts> facts_;  // One a garment.
  size_t measured_count_ = 0;
};

}  // namespace

Result<Outfit> FitOutfit(const BodyInput& body, const std::vector<Layer>& layers, const FitOptions& options,
                         Executor& executor, Stopwatch& stopwatch, const ProgressSink& progress) {
  const auto report_progress = [&progress](std::string_view stage, double done) {
    if (progress) progress(stage, done);
  };
  if (layers.empty()) return InvalidArgument("GARMENT_MISSING", "name at least one garment");
  Outfit outfit;
  report_progress("cutting panels", 0.0);
  FR_ASSIGN_OR_RETURN(Preparation prepared, Prepare(body, layers, options, executor));
  outfit.body_surface = std::move(prepared.body_surface);
  stopwatch.Lap("body without holes, panels");

  std::vector<WornGarment> worn_already;
  Measuring measuring(body, executor, stopwatch);
  const double share = 0.8 / static_cast<double>(layers.size());
  for (const Layer& layer : layers) {
    const double begin = share * static_cast<double>(outfit.garments.size());
    FittedGarment worn;
    worn.input = layer.garment;
    const Garment& garment = layer.garment->garment;
    worn.cut = std::move(prepared.cuts[outfit.garments.size()]);
    DescribeInputs(body, garment, worn.cut, worn.report);
    worn.report.thread_count = executor.thread_count();
    worn.report.profile = options.profile == FitProfile::kPaper ? "paper" : "standard";

    if (!worn_already.empty()) {
      FR_RETURN_IF_ERROR(CheckLayerOrder(garment.kind, worn_already).At(garment.id));
    }
    if (IsBottom(garment.kind) && !worn_already.empty()) {
      measuring.CatchUp(worn_already, outfit);  // As worn before they are tucked in.
      FR_RETURN_IF_ERROR(TuckInTops(body, worn.cut, options, executor, outfit, worn_already).At(garment.id));
      stopwatch.Lap("tucking in");
    }
    const auto dressing = [&](double done) { report_progress("dressing", begin + share * (0.05 + 0.95 * done)); };
    DressingOptions dressing_options = options.dressing;
    dressing_options.drape.material = DrapeMaterial(FabricOf(garment));
    dressing_options.drape.limit_strain = FabricOf(garment).limit_strain();
    Result<Dressing> dressed = DressByProfile(worn.cut, {body.body, outfit.body_surface, worn_already}, options,
                                              dressing_options, executor, dressing);
    if (!dressed.ok()) return dressed.status().At(garment.id);
    worn.stages = std::move(dressed->stages);
    worn.bottom = dressed->bottom;
    stopwatch.Lap("dressing");
    if (!IsBottom(garment.kind) && !worn_already.empty()) {
      const bool is_pressed =
          std::any_of(outfit.garments.begin(), outfit.garments.end(),
                      [](const FittedGarment& other) { return YieldsToWhatIsOver(other.cut.kind); });
      if (is_pressed) measuring.CatchUp(worn_already, outfit);  // As worn before they are pressed.
      FR_RETURN_IF_ERROR(PressWorn(body, worn, options, executor, outfit, worn_already).At(garment.id));
      stopwatch.Lap("pressing what is below");
    }

    DescribeOutcome(*dressed, IsBottom(garment.kind), options.dressing.drape, worn.report);
    measuring.Expect(FactsOf(*dressed));
    if (&layer != &layers.back()) {
      Result<WornGarment> closed = MakeWornGarment(garment.kind, worn.cut.cloth, worn.stages.final);
      if (!closed.ok()) return closed.status().At(garment.id);
      worn_already.push_back(std::move(closed).value());
      stopwatch.Lap("closing what is worn");
    }
    outfit.garments.push_back(std::move(worn));
  }
  measuring.CatchUp(worn_already, outfit);
  if (outfit.garments.size() > 1) ListLayers(outfit);
  return outfit;
}

Result<std::vector<Outfit>> FitAllSizes(const BodyInput& body, const GarmentInput& garment, const FitOptions& options,
                                        Executor& executor, Stopwatch& stopwatch, const ProgressSink& progress) {
  const std::vector<GarmentSize>& sizes = garment.garment.chart.sizes;
  if (sizes.empty()) {
    return FailedPrecondition("CHART_MISSING", garment.garment.id +
                                                   " was published without a size chart; fit the "
                                                   "photographed size alone");
  }
  std::vector<Outfit> outfits;
  std::vector<SizeVerdict> verdicts;
  for (size_t i = 0; i < sizes.size(); ++i) {
    const ProgressSink part = [&](std::string_view stage, double done) {
      if (progress) progress(stage, 0.8 * (static_cast<double>(i) + done) / static_cast<double>(sizes.size()));
    };
    Result<Outfit> outfit = FitOutfit(body, {{&garment, sizes[i].name}}, options, executor, stopwatch, part);
    if (!outfit.ok()) return outfit.status().At("size " + sizes[i].name);
    verdicts.push_back(*outfit->garments.front().report.verdict);
    outfits.push_back(std::move(outfit).value());
  }
  for (Outfit& outfit : outfits) {
    outfit.garments.front().report.sizes = verdicts;
    outfit.garments.front().report.recommendation = Recommend(verdicts);
  }
  return outfits;
}

}  // namespace fitroom
