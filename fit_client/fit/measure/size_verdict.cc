#include "fit_client/fit/measure/size_verdict.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <optional>

#include "fit_client/fit/measure/ease_bands.h"

namespace fitroom {
namespace {

constexpr std::array<std::string_view, 5> kNames = {"good", "tight", "loose", "does_not_fit", "undecided"};
constexpr std::array<std::string_view, 5> kWords = {"good", "tight", "loose", "does not fit", "cannot be told"};
// A rise that is shorter than this below the waist sits low; by more it is not worn where it belongs (unit: metre).
constexpr double kLowRise = 0.05;

std::string Centimetres(double length) {
  char text[32];
  const double cm = 100.0 * length;
  std::snprintf(text, sizeof(text), std::abs(cm) < 1.0 ? "%.1f cm" : "%.0f cm", cm);
  return text;
}

std::string Millimetres(double length) { return std::to_string(std::lround(1000.0 * length)) + " mm"; }

std::string FabricWords(const Fabric& fabric) { return fabric.is_knit ? "a knit" : "a woven"; }

const IntendedGirth* FindIntended(const VerdictInput& input, FitZone zone) {
  for (const IntendedGirth& intended : input.intended) {
    if (intended.zone == zone && intended.girth > 0.0) return &intended;
  }
  return nullptr;
}

// The trade's band, widened to what the maker cuts this size for: a body up to half a size step larger than the
// chart's must not be called tight, nor one as much smaller be called loose.
std::optional<EaseBand> BandOf(const VerdictInput& input, const ZoneFit& fit) {
  std::optional<EaseBand> band = EaseBandOf(input.kind, input.fabric, fit.zone, fit.body_girth);
  const IntendedGirth* intended = FindIntended(input, fit.zone);
  if (!band || intended == nullptr) return band;
  const double design_ease = fit.garment_girth - intended->girth;
  band->least = std::min(band->least, design_ease - intended->half_step);
  band->most = std::max(band->most, design_ease + intended->half_step);
  band->target = design_ease;
  return band;
}

std::string TightReason(const VerdictInput& input, const ZoneFit& fit, const EaseBand& band) {
  const double missing = band.least - fit.ease();
  if (fit.needed_strain() > (input.fabric.is_knit ? 0.02 : 0.0)) {
    char text[80];
    std::snprintf(text, sizeof(text), "%s narrower than the body, stretched by %.0f %%",
                  Centimetres(-fit.ease()).c_str(), 100.0 * fit.needed_strain());
    return text;
  }
  return Centimetres(missing) + " less than the " + Centimetres(std::max(band.least, 0.0)) + " " +
         FabricWords(input.fabric) + " needs";
}

std::string LooseReason(const VerdictInput& input, const ZoneFit& fit, const EaseBand& band, double excess) {
  if (IsBottom(input.kind) && fit.zone == FitZone::kWaist) {
    return Centimetres(excess) + " too wide" + (input.facts.is_belted ? ", belted" : "");
  }
  const std::string name(EaseClassName(input.fabric, fit.zone, fit.ease(), fit.body_girth));
  return Centimetres(fit.ease()) + " wider than the body, " + Centimetres(fit.ease() - band.most) +
         " more than is usual" + (name.empty() ? "" : " (" + name + ")");
}

ZoneVerdict JudgeZone(const VerdictInput& input, const ZoneFit& fit, const EaseBand& band) {
  ZoneVerdict verdict;
  verdict.zone = fit.zone;
  const double ease = fit.ease();
  const double ending = fit.body_girth / (1.0 + input.fabric.limit_strain()) - fit.body_girth;
  for (const double limit : {ending, band.least, band.most}) {
    verdict.is_close = verdict.is_close || std::abs(ease - limit) < kFitUncertainty;
  }
  if (ease < ending) {
    verdict.verdict = FitVerdict::kDoesNotFit;
    verdict.amount = fit.body_girth - fit.garment_girth * (1.0 + input.fabric.limit_strain());
    verdict.reason = "does not close by " + Millimetres(verdict.amount);
  } else if (ease < band.least) {
    verdict.verdict = FitVerdict::kTight;
    verdict.amount = band.least - ease;
    verdict.reason = TightReason(input, fit, band);
  } else if (ease > band.most) {
    verdict.verdict = FitVerdict::kLoose;
    // A belt takes in all that the waist is wider than the body.
    verdict.amount = IsBottom(input.kind) && fit.zone == FitZone::kWaist ? ease : ease - band.most;
    verdict.reason = LooseReason(input, fit, band, verdict.amount);
  }
  return verdict;
}

// What is worn below needs room as well: the garment has to go round body and layers, stretched by no more than its
// band allows round the body. The room to move in is the body's, so that a woven's least ease is not asked twice.
void JudgeLayers(const VerdictInput& input, const ZoneFit& fit, ZoneVerdict& verdict) {
  if (fit.layered_girth <= fit.body_girth || verdict.verdict == FitVerdict::kDoesNotFit) return;
  const std::optional<EaseBand> band = EaseBandOf(input.kind, input.fabric, fit.zone, fit.layered_girth);
  if (!band) return;
  const double lacking = fit.layered_girth + std::min(0.0, band->least) - fit.garment_girth;
  verdict.is_close = verdict.is_close || std::abs(lacking) < kFitUncertainty;
  if (lacking <= 0.0 || (verdict.verdict == FitVerdict::kTight && verdict.amount >= lacking)) return;
  verdict.verdict = FitVerdict::kTight;
  verdict.amount = lacking;
  verdict.reason =
      Centimetres(fit.layered_girth - fit.garment_girth) + " narrower than the body with what is worn below";
}

// What decides first: cannot be put on, then tight, then loose.
int Rank(FitVerdict verdict) {
  switch (verdict) {
    case FitVerdict::kDoesNotFit:
      return 3;
    case FitVerdict::kTight:
      return 2;
    case FitVerdict::kLoose:
      return 1;
    default:
      return 0;
  }
}

// Words for a zone's verdict, the zone named: "tight at the hip: …", "waist 6 cm too wide, belted".
std::string Sentence(const VerdictInput& input, const ZoneVerdict& zone) {
  const std::string name(FitZoneWords(zone.zone));
  switch (zone.verdict) {
    case FitVerdict::kDoesNotFit:
      return zone.reason + " at the " + name;
    case FitVerdict::kTight:
      return "tight at the " + name + ": " + zone.reason;
    case FitVerdict::kLoose:
      return IsBottom(input.kind) && zone.zone == FitZone::kWaist ? name + " " + zone.reason
                                                                  : "loose at the " + name + ": " + zone.reason;
    default:
      return "";
  }
}

void AddUnknown(const VerdictInput& input, SizeVerdict& verdict) {
  for (const ZoneFit& fit : input.zones) {
    if (fit.provenance != Provenance::kUnknown) continue;
    if (!EaseBandOf(input.kind, input.fabric, fit.zone, 1.0)) continue;
    verdict.unknown.emplace_back(FitZoneWords(fit.zone));
  }
  verdict.unknown.insert(verdict.unknown.end(), input.unknown.begin(), input.unknown.end());
}

void SetPrimary(const VerdictInput& input, SizeVerdict& verdict) {
  const FitZone primary = PrimaryZone(input.kind);
  for (const ZoneFit& fit : input.zones) {
    if (fit.zone != primary || !fit.measured) continue;
    const IntendedGirth* intended = FindIntended(input, primary);
    const std::optional<EaseBand> band = EaseBandOf(input.kind, input.fabric, primary, fit.body_girth);
    if (intended == nullptr && !band) return;
    verdict.has_primary = true;
    verdict.primary_offset = intended != nullptr ? fit.body_girth - intended->girth : band->target - fit.ease();
  }
}

std::string GoodSentence(const VerdictInput& input) {
  for (const ZoneFit& fit : input.zones) {
    if (fit.zone != PrimaryZone(input.kind) || !fit.measured) continue;
    const std::string name(EaseClassName(input.fabric, fit.zone, fit.ease(), fit.body_girth));
    return Centimetres(fit.ease()) + " of room at the " + std::string(FitZoneWords(fit.zone)) +
           (name.empty() ? "" : " (" + name + ")");
  }
  return "nothing pulls and nothing hangs";
}

// " (left side seam, open over 12 cm)".
std::string OpenSeamWords(const DressingFacts& facts) {
  if (facts.open_seam.empty()) return "";
  return " (" + facts.open_seam + ", open over " + Centimetres(facts.open_length) + ")";
}

// What dressing itself found weighs like a zone's word.
std::optional<ZoneVerdict> JudgeFacts(const VerdictInput& input) {
  ZoneVerdict verdict;
  if (input.facts.open_gap > 0.0) {
    verdict.zone = input.facts.open_zone;
    verdict.verdict = FitVerdict::kDoesNotFit;
    verdict.amount = input.facts.open_gap;
    verdict.reason = "does not close by " + Millimetres(input.facts.open_gap);
    return verdict;
  }
  if (input.facts.rise_short <= kFitUncertainty) return std::nullopt;
  verdict.zone = FitZone::kWaist;
  verdict.verdict = input.facts.rise_short > kLowRise ? FitVerdict::kDoesNotFit : FitVerdict::kTight;
  verdict.amount = input.facts.rise_short;
  verdict.reason = "rise short by " + Millimetres(input.facts.rise_short);
  return verdict;
}

}  // namespace

std::string_view FitVerdictName(FitVerdict verdict) { return kNames[static_cast<size_t>(verdict)]; }
std::string_view FitVerdictWords(FitVerdict verdict) { return kWords[static_cast<size_t>(verdict)]; }

SizeVerdict JudgeSize(const VerdictInput& input) {
  SizeVerdict result;
  result.size = input.size;
  const ZoneVerdict* worst = nullptr;
  for (const ZoneFit& fit : input.zones) {
    if (!fit.measured || fit.provenance == Provenance::kUnknown) continue;
    const std::optional<EaseBand> band = BandOf(input, fit);
    if (!band) continue;
    result.zones.push_back(JudgeZone(input, fit, *band));
    JudgeLayers(input, fit, result.zones.back());
  }
  for (const ZoneVerdict& zone : result.zones) {
    result.is_close = result.is_close || zone.is_close;
    if (zone.verdict == FitVerdict::kTight) result.shortfall = std::max(result.shortfall, zone.amount);
    const int rank = Rank(zone.verdict);
    if (rank == 0) continue;
    if (worst == nullptr || rank > Rank(worst->verdict) ||
        (rank == Rank(worst->verdict) && zone.amount > worst->amount)) {
      worst = &zone;
    }
  }
  AddUnknown(input, result);
  SetPrimary(input, result);
  const std::optional<ZoneVerdict> facts = JudgeFacts(input);
  if (facts && facts->verdict == FitVerdict::kTight) result.shortfall = std::max(result.shortfall, facts->amount);
  if (facts && (worst == nullptr || Rank(facts->verdict) >= Rank(worst->verdict))) {
    result.verdict = facts->verdict;
    result.has_deciding_zone = true;
    result.deciding_zone = facts->zone;
    result.reason = facts->verdict == FitVerdict::kDoesNotFit && input.facts.open_gap > 0.0
                        ? Sentence(input, *facts) + OpenSeamWords(input.facts)
                        : facts->reason;
    result.is_close = false;
  } else if (worst != nullptr) {
    result.verdict = worst->verdict;
    result.has_deciding_zone = true;
    result.deciding_zone = worst->zone;
    result.reason = Sentence(input, *worst);
    result.is_close = worst->is_close;
  } else if (!result.zones.empty()) {
    result.verdict = FitVerdict::kGood;
    result.reason = GoodSentence(input);
  } else {
    result.reason = "no girth of this garment could be measured";
  }
  if (!result.unknown.empty() && result.verdict != FitVerdict::kDoesNotFit) {
    std::string names;
    for (const std::string& name : result.unknown) names += (names.empty() ? "" : ", ") + name;
    result.verdict = FitVerdict::kUndecided;
    result.reason = "not known: " + names + (result.reason.empty() ? "" : "; otherwise " + result.reason);
  }
  return result;
}

std::vector<IntendedGirth> IntendedGirths(const SizeChart& chart, size_t index) {
  std::vector<IntendedGirth> girths;
  if (index >= chart.sizes.size()) return girths;
  for (const GarmentMeasure& measure : chart.sizes[index].body) {
    const std::optional<FitZone> zone = FitZoneFromName(measure.name);
    if (!zone || !(measure.value > 0.0)) continue;
    double step = 0.0;
    for (const size_t other : {index + 1, index - 1}) {  // Of the largest size, the way down.
      if (other >= chart.sizes.size() || step > 0.0) continue;
      const GarmentMeasure* next = FindMeasure(chart.sizes[other].body, measure.name);
      if (next != nullptr) step = std::abs(next->value - measure.value);
    }
    girths.push_back({*zone, measure.value, 0.5 * step});
  }
  return girths;
}

SizeRecommendation Recommend(std::span<const SizeVerdict> verdicts) {
  SizeRecommendation result;
  const auto is_wearable = [](const SizeVerdict& v) {
    return v.verdict != FitVerdict::kDoesNotFit && v.shortfall <= kPassedOverShortfall;
  };
  std::optional<size_t> best;
  for (size_t i = 0; i < verdicts.size(); ++i) {
    if (!verdicts[i].has_primary) continue;
    if (!best || std::abs(verdicts[i].primary_offset) < std::abs(verdicts[*best].primary_offset)) best = i;
  }
  if (!best) {
    result.text = "no size can be recommended: the primary girth of body or garment is not known";
    return result;
  }
  const size_t nearest = *best;
  while (*best < verdicts.size() && !is_wearable(verdicts[*best])) ++*best;
  if (*best == verdicts.size()) {
    const SizeVerdict& largest = verdicts.back();
    result.size = largest.size;
    result.text =
        "no size fits: even " + (largest.size.empty() ? "the largest" : largest.size) + " is wrong: " + largest.reason;
    return result;
  }
  result.found = true;
  result.size = verdicts[*best].size;
  result.text = result.size;
  if (*best == nearest) {
    // The neighbour on the side to which the body leans.
    const size_t other = verdicts[nearest].primary_offset > 0.0 ? nearest + 1 : nearest - 1;
    if (other < verdicts.size() && verdicts[other].has_primary && is_wearable(verdicts[other]) &&
        std::abs(verdicts[other].primary_offset) - std::abs(verdicts[nearest].primary_offset) < kFitUncertainty) {
      result.between = verdicts[other].size;
      result.text =
          "between " + verdicts[std::min(nearest, other)].size + " and " + verdicts[std::max(nearest, other)].size;
    }
  }
  if (verdicts[*best].verdict == FitVerdict::kUndecided) {
    result.text += " by the primary girth alone; " + verdicts[*best].reason;
  } else if (verdicts[*best].verdict != FitVerdict::kGood) {
    result.text += " (" + verdicts[*best].reason + ")";
  }
  return result;
}

}  // namespace fitroom
