#pragma once

#include <string_view>
#include <vector>

#include "common/base/status.h"
#include "fit_client/fit/cloth_mesh.h"

namespace fitroom {

// The outline of one panel: its boundary particles in order, and where the named ones stand in it.
class PanelOutline {
 public:
  // Walks the boundary of `panel` (0 front, 1 back). INVALID_ARGUMENT (PANEL_OUTLINE) unless it is one closed loop.
  static Result<PanelOutline> Trace(const ClothMesh& cloth, int panel);

  // Returns the particles from one named point to another along the shorter way round, both ends included.
  // NOT_FOUND (POINT_MISSING) when the panel has no such point on its outline.
  Result<std::vector<int>> Section(std::string_view from, std::string_view to) const;

 private:
  PanelOutline(const ClothMesh& cloth, int panel, std::vector<int> loop)
      : cloth_(&cloth), panel_(panel), loop_(std::move(loop)) {}
  Result<size_t> PlaceOf(std::string_view name) const;

  const ClothMesh* cloth_;  // Not owned; outlives this object.
  int panel_;
  std::vector<int> loop_;
};

// Returns the arc length at each particle of a chain, in the rest shape (unit: metre).
std::vector<double> RestArcLengths(const ClothMesh& cloth, const std::vector<int>& chain);

}  // namespace fitroom
