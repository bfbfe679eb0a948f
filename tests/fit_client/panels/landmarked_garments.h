#pragma once

#include <string>
#include <vector>

#include "common/garment/garment.h"
#include "common/image/image.h"

namespace fitroom::testing {

// A garment of the external test data with a mask and corners drawn by hand, laid flat and photographed by a shopper.
struct LandmarkedGarment {
  Garment garment;  // Front only.
  Image mask;
  std::string name;
};

struct LandmarkedFile {
  GarmentKind kind = GarmentKind::kTShirt;
  const char* file = "";  // Below the garments' folder, without ".landmarks.json".
  double length = 0.0;    // A plausible one (unit: metre).
};

// All files with landmarks that show a kind of garment.
const std::vector<LandmarkedFile>& LandmarkedFiles();

// Reads one: its outline follows the mask's pixels, the corners are the landmarks moved onto it, and the other points
// are spaced evenly between them. Throws std::runtime_error where the data is not as described.
LandmarkedGarment ReadLandmarkedGarment(const LandmarkedFile& file);

}  // namespace fitroom::testing
