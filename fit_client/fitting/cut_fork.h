#pragma once

#include <optional>
#include <string>
#include <vector>

#include "common/base/status.h"
#include "common/garment/garment.h"
#include "fit_client/fit/fork/fork.h"

namespace fitroom {

// A fork, and whether anything is known of it.
struct CutForkResult {
  std::optional<ForkedPattern> forked;  // Nothing for kinds without legs.
  // Nothing decides the fork and nobody asked for an estimate: it was drafted by the fabric's rule so that the garment
  // can be worn at all. Its measures say nothing of the garment and must not be judged.
  bool is_assumed = false;
};

// Rebuilds the fork of trousers in one size from what their shop states of that size, or of the photographed one, or
// from the side-folded photograph, or, if nothing of that is there, by `rule`: an estimate that may be judged. Without
// a rule the fork is assumed after the fabric (close for denim and stretch, else trouser) and `notes` name what is
// missing; where no fork can be drafted at all, the two panels remain. `photographed` is the pattern of the
// photographs, `pattern` that of `size` (an empty name: as photographed). Fails like BuildFork() where what is stated
// contradicts the photographs.
Result<CutForkResult> CutFork(const Garment& garment, const GarmentPattern& photographed, const GarmentPattern& pattern,
                              const std::string& size, std::optional<ForkRule> rule, std::vector<std::string>& notes);

}  // namespace fitroom
