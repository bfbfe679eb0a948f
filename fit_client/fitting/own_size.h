#pragma once

#include "common/base/status.h"
#include "common/body/body.h"
#include "common/garment/garment.h"
#include "common/garment/size_choice.h"

namespace fitroom {

// What users type for the size that a garment's chart names for their body.
inline constexpr char kOwnSize[] = "auto";

// Returns the size of the garment's chart for the body by its primary dimension (ISO 8559-2). Fails like ChooseSize();
// the message names the garment.
Result<SizeChoice> ChooseOwnSize(const Garment& garment, const Body& body);

}  // namespace fitroom
