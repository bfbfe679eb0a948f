#pragma once

#include <cstdint>
#include <vector>

#include "fit_client/render/projection.h"
#include "fit_client/render/scene.h"

namespace fitroom::render {

// Rows of floats and triangle corners, ready for the renderer. What a row holds is said by the function that makes it.
struct VertexRows {
  std::vector<float> rows;
  std::vector<uint32_t> indices;
};

// A garment's rows: position 3, normal 3, sky outside 1, sky inside 1, texture coordinates 2. The front panel's
// triangles come first.
struct GarmentRows {
  VertexRows rows;
  int front_index_count = 0;  // Corners of the front panel's triangles.
};

// The scene's body and garments with their soft shadows on each other.
struct SceneRows {
  VertexRows body;  // Position 3, normal 3, sky 1. Empty without a body.
  std::vector<GarmentRows> garments;
};

// Returns the rows of a scene whose parts have been checked.
SceneRows ComputeSceneRows(const Scene& scene);

// Returns the lines as quads of `pixel_width`, one camera's: clip position 4, colour 3.
VertexRows ComputeLineRows(const std::vector<LineSegment>& lines, const Camera& camera, double pixel_width);

}  // namespace fitroom::render
