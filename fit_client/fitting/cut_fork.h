#pragma once

#include <optional>
#include <string>
#include <vector>

#include "common/base/status.h"
#include "common/garment/garment.h"
#include "fit_client/fit/panels/fork.h"

namespace fitroom {

// Rebuilds the fork of trousers in one size from what their shop states of that size, or of the photographed one, or
// from the side-folded photograph, or, if nothing of that is there, by `rule`. `photographed` is the pattern of the
// photographs, `pattern` that of `size` (an empty name: as photographed). Nothing for kinds without legs and where the
// fork cannot be decided; `notes` then name what is missing. Fails like BuildFork() where what is stated contradicts
// the photographs.
Result<std::optional<ForkedPattern>> CutFork(const Garment& garment, const GarmentPattern& photographed,
                                             const GarmentPattern& pattern, const std::string& size,
                                             std::optional<ForkRule> rule, std::vector<std::string>& notes);

}  // namespace fitroom
