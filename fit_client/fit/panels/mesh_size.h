#pragma once

#include <array>
#include <vector>

#include <Eigen/Core>

#include "fit_client/fit/panels/pattern.h"

namespace fitroom::panels {

// How long the edges of a panel's mesh are to be: the pitch, and halved until they are no longer than `tight_pitch`
// where the body leaves cloth little room or few edges go round a tube: sleeves, armholes, straps, the crotch.
class MeshSize {
 public:
  // One length everywhere (unit: metre).
  explicit MeshSize(double pitch) : pitch_(pitch) {}
  MeshSize(const PanelPattern& panel, double pitch, double tight_pitch);

  double pitch() const { return pitch_; }
  // How often the pitch is halved where it is halved most often; 0: one length everywhere.
  int level_count() const { return places_.empty() ? 0 : level_count_; }
  double PitchOf(int level) const { return pitch_ / static_cast<double>(1 << level); }
  int LevelAt(const Eigen::Vector2d& point) const;
  double At(const Eigen::Vector2d& point) const { return PitchOf(LevelAt(point)); }

 private:
  double pitch_ = 0.0;
  int level_count_ = 0;
  std::vector<std::array<Eigen::Vector2d, 2>> places_;  // What is near one of these ways is tight.
};

}  // namespace fitroom::panels
