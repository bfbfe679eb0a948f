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

}  // namespace

Result<std::optional<ForkedPattern>> CutFork(const Garment& garment, const GarmentPattern& photographed,
                                             const GarmentPattern& pattern, const std::string& size,
                                             std::optional<ForkRule> rule, std::vector<std::string>& notes) {
  std::optional<ForkedPattern> forked;
  if (!HasLegs(garment.kind)) return forked;
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
    notes.push_back("the photographs do not decide " + Joined(UndecidedByFolding(garment.kind, evidence)) +
                    ", which folding hides; cut of two panels without a fork");
    return forked;
  }
  notes.push_back(Account(*built));
  forked = std::move(built).value();
  return forked;
}

}  // namespace fitroom
