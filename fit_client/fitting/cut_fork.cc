#include "fit_client/fitting/cut_fork.h"

namespace fitroom {
namespace {

std::string Joined(const std::vector<std::string>& names) {
  std::string joined;
  for (size_t i = 0; i < names.size(); ++i) {
    joined += (i == 0 ? "" : i + 1 == names.size() ? " and " : ", ") + names[i];
  }
  return joined;
}

// How the fork came to be known, for people.
std::string Account(const ForkedPattern& forked) {
  const Provenance thigh = FindMeasure(forked.measures, "thigh_width")->provenance;
  if (forked.extension_clamped) {
    return "the thigh does not go with the hip; the fork was held to what trousers have";
  }
  if (thigh == Provenance::kMeasured) return "the fork was rebuilt from the side-folded photograph";
  if (thigh == Provenance::kStated) return "the fork was rebuilt from the stated measures";
  return "the fork was estimated; state thigh_width, front_rise and back_rise of this size for a verdict there";
}

// The rule by which trousers of a fabric are usually drafted.
ForkRule UsualRule(const std::string& fabric) {
  return fabric == "denim" || fabric == "stretch" || fabric == "jersey" ? ForkRule::kClose : ForkRule::kTrouser;
}

// Drafts a fork of which nothing is known, for the picture's sake.
CutForkResult AssumeFork(const Garment& garment, const GarmentPattern& pattern, ForkEvidence evidence,
                         std::vector<std::string>& notes) {
  CutForkResult cut;
  const std::string undecided =
      "the photographs do not decide " + Joined(UndecidedByFolding(garment.kind, evidence)) + ", which folding hides; ";
  evidence.rule = UsualRule(garment.fabric);
  Result<ForkedPattern> built = BuildFork(pattern, evidence);
  if (!built.ok()) {
    notes.push_back(undecided + "cut of two panels without a fork");
    return cut;
  }
  notes.push_back(undecided + "the garment is shown with a fork by the drafting rule \"" +
                  std::string(ForkRuleName(*evidence.rule)) +
                  "\", which is not judged: state those measures, add a side-folded photograph, or take an estimate "
                  "with --fork");
  cut.forked = std::move(built).value();
  cut.is_assumed = true;
  return cut;
}

}  // namespace

Result<CutForkResult> CutFork(const Garment& garment, const GarmentPattern& photographed, const GarmentPattern& pattern,
                              const std::string& size, std::optional<ForkRule> rule, std::vector<std::string>& notes) {
  CutForkResult cut;
  if (!HasLegs(garment.kind)) return cut;
  const std::string& photographed_size = garment.chart.photographed_size;
  ForkEvidence evidence = EvidenceFrom(garment, FindSize(garment.chart, size));
  if (size != photographed_size && !UndecidedByFolding(garment.kind, evidence).empty()) {
    const Result<ForkedPattern> shown =
        BuildFork(photographed, EvidenceFrom(garment, FindSize(garment.chart, photographed_size)));
    if (shown.ok()) evidence = EvidenceForSize(*shown, pattern, evidence);
  }
  evidence.rule = rule;
  Result<ForkedPattern> built = BuildFork(pattern, evidence);
  if (!built.ok()) {
    if (built.status().reason() != "FORK_UNKNOWN") return built.status().At(garment.id);
    return AssumeFork(garment, pattern, evidence, notes);
  }
  notes.push_back(Account(*built));
  cut.forked = std::move(built).value();
  return cut;
}

}  // namespace fitroom
