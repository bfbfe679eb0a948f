#include "tests/bench/ease_table.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <map>
#include <tuple>

namespace fitroom {
namespace {

constexpr double kShownStretch = 1e-3;  // Less is no stretch to speak of (unit: metre).
constexpr double kGoal = 0.01;          // (unit: metre)

bool IsOfTable(const ZoneFit& zone) {
  const bool is_torso = zone.zone == FitZone::kBust || zone.zone == FitZone::kWaist || zone.zone == FitZone::kHip;
  return is_torso && zone.measured && zone.worn_girth > 0.0;
}

// One column of the table.
struct Errors {
  int count = 0;
  int over = 0;
  double sum = 0.0;
  double largest = 0.0;

  void Add(double error) {
    ++count;
    over += std::abs(error) > kGoal;
    sum += std::abs(error);
    largest = std::max(largest, std::abs(error));
  }
  void Print() const {
    if (count == 0) {
      std::printf(" | %30s", "");
    } else {
      std::printf(" | %5d %7.1f %7.1f %8d", count, 1e3 * sum / count, 1e3 * largest, over);
    }
  }
};

}  // namespace

LineState StateOf(const ZoneFit& zone) {
  if (zone.is_belted) return LineState::kBelted;
  return zone.least_worn_girth > zone.garment_girth + kShownStretch ? LineState::kStretched : LineState::kFree;
}

double LineError(const ZoneFit& zone) {
  return zone.worn_girth - (StateOf(zone) == LineState::kFree ? zone.garment_girth : zone.least_worn_girth);
}

void PrintEaseTable(const std::vector<WornZones>& worn) {
  std::map<std::tuple<std::string, std::string, FitZone>, std::array<Errors, 4>> lines;
  for (const WornZones& garment : worn) {
    for (const ZoneFit& zone : garment.zones) {
      if (!IsOfTable(zone)) continue;
      std::array<Errors, 4>& line = lines[{garment.outfit, garment.garment, zone.zone}];
      line[static_cast<size_t>(StateOf(zone))].Add(LineError(zone));
      if (zone.is_belted) line[3].Add(garment.belt_ease - zone.ease());
    }
  }
  std::printf("\nworn girth from the drape (mm)\n%-34s | %-30s | %-30s | %-30s | %s\n", "", "hangs free: worn - flat",
              "stretched: worn - round body", "belted: worn - belt", "waist's ease before the belt");
  std::printf("%-14s %-12s %-6s", "outfit", "garment", "zone");
  for (int k = 0; k < 4; ++k) std::printf(" | %5s %7s %7s %8s", "zones", "mean", "largest", "> 10 mm");
  std::printf("\n");
  for (const auto& [key, line] : lines) {
    const auto& [outfit, garment, zone] = key;
    std::printf("%-14s %-12s %-6s", outfit.c_str(), garment.c_str(), std::string(FitZoneName(zone)).c_str());
    for (const Errors& errors : line) errors.Print();
    std::printf("\n");
  }
}

void PrintEaseOfSizes(const std::vector<WornZones>& worn) {
  struct Sizes {
    std::vector<const ZoneFit*> zones;
    std::vector<std::string> names;
  };
  std::map<std::tuple<std::string, std::string, FitZone>, Sizes> lines;
  for (const WornZones& garment : worn) {
    for (const ZoneFit& zone : garment.zones) {
      if (!IsOfTable(zone)) continue;
      Sizes& sizes = lines[{garment.body, garment.garment, zone.zone}];
      sizes.zones.push_back(&zone);
      sizes.names.push_back(garment.size);
    }
  }
  std::printf(
      "\nease of all sizes (mm): garment girth less body girth, worn girth less body girth; * not above the last\n");
  int falls = 0;
  for (const auto& [key, sizes] : lines) {
    const auto& [body, garment, zone] = key;
    for (const bool is_worn : {false, true}) {
      std::printf("%-6s %-12s %-6s %-7s", body.c_str(), garment.c_str(), std::string(FitZoneName(zone)).c_str(),
                  is_worn ? "worn" : "garment");
      for (size_t i = 0; i < sizes.zones.size(); ++i) {
        const ZoneFit& now = *sizes.zones[i];
        const double ease = is_worn ? now.worn_ease() : now.ease();
        // Cloth that is stretched, or held by a belt, is as long as what it lies on: equal, not growing.
        const bool is_held = is_worn && StateOf(now) != LineState::kFree;
        const bool falls_short =
            i > 0 && !is_held && ease <= (is_worn ? sizes.zones[i - 1]->worn_ease() : sizes.zones[i - 1]->ease());
        falls += falls_short;
        std::printf(" %s:%.0f%s", sizes.names[i].c_str(), ease * 1e3, falls_short ? "*" : is_held ? "=" : "");
      }
      std::printf("\n");
    }
  }
  std::printf("%d places where ease does not grow with the size (= stretched or belted: as long as what it lies on)\n",
              falls);
}

}  // namespace fitroom
