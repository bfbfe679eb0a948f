#pragma once

#include <string>

#include "common/base/status.h"
#include "fit_client/render/scene.h"

namespace fitroom::render {

// What a viewer on the web is ready to load (Khronos 3D Commerce asset guidelines).
inline constexpr int kGlbTriangleLimit = 100000;

// Returns a binary glTF 2.0 file of the scene's body and garments: metres, +Y up, facing +Z, with normals, the
// photographs as embedded JPEGs of at most 2048 pixels a side. The body is simplified further where both together would
// pass kGlbTriangleLimit. Lines and opacity are not written; a garment's inside shows its outside's photograph.
// `title` names the scene. The same scene gives the same bytes. Fails like Renderer::Draw() for a scene whose parts do
// not fit each other; INVALID_ARGUMENT [EMPTY_SCENE] for nothing to write.
Result<std::string> WriteGlb(const Scene& scene, const std::string& title);

}  // namespace fitroom::render
