#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "common/base/status.h"
#include "common/body/body.h"
#include "common/body/body_frame.h"
#include "common/garment/garment.h"
#include "common/image/image.h"

namespace fitroom {

// A body to be dressed, and how it was come by.
struct BodyInput {
  std::string name;  // Of the pulled scan, or the file.
  Body body;
  std::vector<std::string> notes;  // What was decided about axis, facing and unit.
};

// A garment to be worn, with the photographs as the panels show them.
struct GarmentInput {
  Garment garment;
  Image front_texture;
  Image back_texture;  // Empty (width 0) where the garment has no back photograph.
};

// Reads a scan file and finds frame, landmarks and limbs in it; what the user knows of the frame comes first. Fails
// like ReadScanFile() and AnalyseScan(); the message names the file.
Result<BodyInput> LoadScan(const std::filesystem::path& file, const FrameOverrides& overrides = {});

// Reads a garment's folder, as `shop_catalog extract` and `fit_client pull` write it. Fails like ReadGarmentFolder()
// and ReadGarmentTexture().
Result<GarmentInput> LoadGarment(const std::filesystem::path& folder);

}  // namespace fitroom
