#include "fit_client/fit/panels/mesh_size.h"

#include <algorithm>
#include <limits>
#include <string>
#include <string_view>
#include <utility>

#include "fit_client/fit/panels/polyline.h"

namespace fitroom::panels {
namespace {

constexpr double kReach = 0.12;      // Of a tight place, to all sides (unit: metre).
constexpr double kLevelWidth = 2.0;  // A level is so much wider than the next finer one (unit: its own pitch).
constexpr int kMostLevels = 3;

// Ways between named points of all kinds; a panel has those whose both ends it has. Twice the same: a single point.
// Shoulder tips are e3 and e7 of tops, e2 and e6 of one-pieces.
constexpr std::array<std::pair<std::string_view, std::string_view>, 13> kTightWays = {{
    {"underarm_L", "e3"},
    {"underarm_R", "e7"},
    {"underarm_L", "e2"},
    {"underarm_R", "e6"},
    {"underarm_L", "sleeve_bottom_L"},
    {"underarm_R", "sleeve_bottom_R"},
    {"P2", "e2"},
    {"P1", "e6"},
    {"e3", "e4"},
    {"e7", "e8"},
    {"e2", "sleeve_top_L"},
    {"e6", "sleeve_top_R"},
    {"crotch", "crotch"},
}};

}  // namespace

MeshSize::MeshSize(const PanelPattern& panel, double pitch, double tight_pitch) : pitch_(pitch) {
  while (level_count_ < kMostLevels && PitchOf(level_count_) > tight_pitch) ++level_count_;
  if (level_count_ == 0) return;
  const bool is_bottom = FindSection(panel, "neck") == nullptr;
  for (const auto& [from_name, to_name] : kTightWays) {
    const Eigen::Vector2d* from = FindPatternPoint(panel, from_name);
    const Eigen::Vector2d* to = FindPatternPoint(panel, to_name);
    if (from == nullptr || to == nullptr || is_bottom != (from_name == "crotch")) continue;
    places_.push_back({*from, *to});
  }
}

int MeshSize::LevelAt(const Eigen::Vector2d& point) const {
  if (level_count_ == 0) return 0;
  double nearest = std::numeric_limits<double>::infinity();
  for (const auto& [from, to] : places_) nearest = std::min(nearest, DistanceToSegment(point, from, to));
  double reach = kReach;
  for (int level = level_count_; level > 0; --level) {
    if (nearest <= reach) return level;
    reach += kLevelWidth * PitchOf(level - 1);
  }
  return 0;
}

}  // namespace fitroom::panels
