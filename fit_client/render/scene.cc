#include "fit_client/render/scene.h"

#include "fit_client/render/garment_surface.h"

namespace fitroom::render {

Status CheckScene(const Scene& scene) {
  if (scene.body != nullptr) {
    if (scene.body->normals.size() != scene.body->mesh.vertices.size()) {
      return InvalidArgument("BAD_BODY_SHAPE", "the body cannot be drawn: it needs one normal a vertex");
    }
    for (const Eigen::Vector3d& vertex : scene.body->mesh.vertices) {
      if (!vertex.allFinite()) return InvalidArgument("BAD_BODY_SHAPE", "the body has a vertex that is nowhere");
    }
    const int count = static_cast<int>(scene.body->mesh.vertices.size());
    for (const Eigen::Vector3i& triangle : scene.body->mesh.triangles) {
      if (triangle.minCoeff() < 0 || triangle.maxCoeff() >= count) {
        return InvalidArgument("BAD_BODY_SHAPE", "the body has a triangle without a corner");
      }
    }
  }
  for (const GarmentShape& garment : scene.garments) FR_RETURN_IF_ERROR(CheckGarmentShape(garment));
  for (const LineSegment& line : scene.lines) {
    if (!line.from.allFinite() || !line.to.allFinite()) {
      return InvalidArgument("BAD_LINE", "a line of the scene ends nowhere (not a number)");
    }
  }
  return Status();
}

}  // namespace fitroom::render
