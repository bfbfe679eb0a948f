#pragma once

#include <cstdint>
#include <vector>

#include <Eigen/Core>
#include <Eigen/Geometry>

#include "common/base/status.h"
#include "common/geometry/triangle_mesh.h"
#include "common/image/image.h"
#include "fit_client/fit/cloth_mesh.h"

namespace fitroom::render {

// The body as it is drawn: a mesh light enough for a picture, with smooth normals and the part of the sky that each
// vertex sees. Made once by PrepareBody() and used for every picture and for the GLB. Plain values; safe to share
// between threads while nobody writes.
struct DisplayBody {
  TriangleMesh mesh;                     // Canonical frame (unit: metre).
  std::vector<Eigen::Vector3d> normals;  // Unit length, one a vertex.
};

// How many triangles a picture of the body needs. Below 30,000 the fingers and the outline turn angular at 1200 rows.
inline constexpr int kDisplayBodyTriangleCount = 50000;

// Returns `body` with at most about `triangle_count` triangles (a mesh that has fewer is kept as it is); the surface
// moves by less than 0.5 mm, and where that does not suffice the count is exceeded. Normals are those of the full mesh.
// Islands smaller than 0.1 % of the triangles, which scanners leave floating, are not shown.
DisplayBody PrepareBody(const TriangleMesh& body, int triangle_count = kDisplayBodyTriangleCount);

// A colour, sRGB, each 0 to 1.
using Colour = Eigen::Vector3f;

// A garment at one moment. Views of what the caller owns: everything pointed to outlives the scene.
struct GarmentShape {
  const ClothMesh* cloth = nullptr;        // Triangles, texture coordinates, panels and seams.
  std::vector<Eigen::Vector3d> positions;  // One a particle, now (canonical frame, unit: metre).
  const Image* front_texture = nullptr;    // Of panel 0; null: plain cloth.
  const Image* back_texture = nullptr;     // Of panel 1; null: the front's texture.
  float opacity = 1.0F;                    // Below 1 the body shows through.
};

// A straight line in the scene: a stitch. Drawn 2 pixels wide over everything behind it.
struct LineSegment {
  Eigen::Vector3d from = Eigen::Vector3d::Zero();
  Eigen::Vector3d to = Eigen::Vector3d::Zero();
  Colour colour = Colour(0.85F, 0.1F, 0.1F);
};

// What is drawn. Views of what the caller owns.
struct Scene {
  const DisplayBody* body = nullptr;  // Null: no body.
  // The body is drawn this much deeper than it is: it is a simplified surface, and cloth lies 1 to 3 mm above the true
  // one. What is inside what is measured elsewhere, never on a picture (unit: metre).
  double body_depth_bias = 3e-3;
  std::vector<GarmentShape> garments;
  std::vector<LineSegment> lines;
};

// Checks that the parts of a scene fit each other: counts, indices, finite numbers. INVALID_ARGUMENT with the reason
// BAD_BODY_SHAPE, BAD_GARMENT_SHAPE or BAD_LINE names what does not.
Status CheckScene(const Scene& scene);

// From where the scene is looked at. "Side" looks at the body's left, "three-quarter" at its front from its left.
enum class ViewDirection { kFront, kSide, kBack, kThreeQuarter };

// Returns "front", "side", "back" or "three_quarter".
const char* ViewName(ViewDirection view);

// A camera with a long lens on a tripod, looking level at the middle of `subject`. Everything inside `subject` (its
// vertical cylinder, so that the scale is the same from every side) is inside the picture.
struct Camera {
  ViewDirection view = ViewDirection::kFront;
  Eigen::AlignedBox3d subject;  // What has to be in the picture (canonical frame, unit: metre).
  int width = 800;              // (unit: pixel)
  int height = 1200;            // (unit: pixel)
  int samples_across = 2;       // A pixel is the mean of so many samples each way: 2, or 1 where speed counts.
};

}  // namespace fitroom::render
