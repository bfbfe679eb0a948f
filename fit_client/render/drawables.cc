#include "fit_client/render/drawables.h"

#include <cmath>

#include "fit_client/render/garment_surface.h"
#include "fit_client/render/sky_visibility.h"

namespace fitroom::render {
namespace {

void Append(std::vector<float>& rows, const Eigen::Vector3d& vector) {
  for (const double value : vector) rows.push_back(static_cast<float>(value));
}

Eigen::AlignedBox3d ComputeSceneBounds(const Scene& scene) {
  Eigen::AlignedBox3d bounds;
  if (scene.body != nullptr) bounds = ComputeBounds(scene.body->mesh);
  for (const GarmentShape& garment : scene.garments) {
    for (const Eigen::Vector3d& position : garment.positions) bounds.extend(position);
  }
  return bounds;
}

VertexRows ComputeBodyRows(const DisplayBody& body, const SkyVisibility& sky) {
  const std::vector<float> sky_parts = sky.Compute(body.mesh.vertices, body.normals);
  VertexRows rows;
  rows.rows.reserve(body.mesh.vertices.size() * 7);
  for (size_t i = 0; i < body.mesh.vertices.size(); ++i) {
    Append(rows.rows, body.mesh.vertices[i]);
    Append(rows.rows, body.normals[i]);
    rows.rows.push_back(sky_parts[i]);
  }
  rows.indices.reserve(body.mesh.triangles.size() * 3);
  for (const Eigen::Vector3i& t : body.mesh.triangles) {
    for (const int corner : t) rows.indices.push_back(static_cast<uint32_t>(corner));
  }
  return rows;
}

// A triangle belongs to the panel of its first corner: triangles never cross a seam.
GarmentRows ComputeGarmentRows(const GarmentShape& garment, const SkyVisibility& sky) {
  const ClothMesh& cloth = *garment.cloth;
  std::vector<Eigen::Vector3d> normals = ComputeGarmentNormals(cloth, garment.positions);
  const std::vector<float> outside = sky.Compute(garment.positions, normals);
  std::vector<Eigen::Vector3d> inward = normals;
  for (Eigen::Vector3d& normal : inward) normal = -normal;
  const std::vector<float> inside = sky.Compute(garment.positions, inward);

  GarmentRows result;
  std::vector<float>& rows = result.rows.rows;
  rows.reserve(garment.positions.size() * 10);
  for (size_t i = 0; i < garment.positions.size(); ++i) {
    Append(rows, garment.positions[i]);
    Append(rows, normals[i]);
    rows.push_back(outside[i]);
    rows.push_back(inside[i]);
    rows.push_back(static_cast<float>(cloth.texture_coordinates[i].x()));
    rows.push_back(static_cast<float>(cloth.texture_coordinates[i].y()));
  }
  for (const int panel : {0, 1}) {
    for (const Eigen::Vector3i& t : cloth.triangles) {
      if (cloth.panel_of_particle[static_cast<size_t>(t[0])] != panel) continue;
      for (const int corner : t) result.rows.indices.push_back(static_cast<uint32_t>(corner));
    }
    if (panel == 0) result.front_index_count = static_cast<int>(result.rows.indices.size());
  }
  return result;
}

}  // namespace

SceneRows ComputeSceneRows(const Scene& scene) {
  SceneRows rows;
  const Eigen::AlignedBox3d bounds = ComputeSceneBounds(scene);
  if (bounds.isEmpty()) return rows;
  SkyVisibility sky(bounds.min(), bounds.max());
  if (scene.body != nullptr) sky.AddOccluder(scene.body->mesh.vertices, scene.body->mesh.triangles);
  for (const GarmentShape& garment : scene.garments) {
    // A garment that is drawn see-through is a diagram; it casts no shadow.
    if (garment.opacity >= 1.0F) sky.AddOccluder(garment.positions, garment.cloth->triangles);
  }
  if (scene.body != nullptr) rows.body = ComputeBodyRows(*scene.body, sky);
  for (const GarmentShape& garment : scene.garments) rows.garments.push_back(ComputeGarmentRows(garment, sky));
  return rows;
}

VertexRows ComputeLineRows(const std::vector<LineSegment>& lines, const Camera& camera, double pixel_width) {
  const Eigen::Matrix4d clip_from_world = ComputeProjection(camera).clip_from_world();
  const Eigen::Vector2d half_picture(0.5 * camera.width, 0.5 * camera.height);
  VertexRows result;
  for (const LineSegment& line : lines) {
    const Eigen::Vector4d from = clip_from_world * line.from.homogeneous();
    const Eigen::Vector4d to = clip_from_world * line.to.homogeneous();
    if (from.w() <= 0.0 || to.w() <= 0.0) continue;  // Behind the camera.
    const Eigen::Vector2d along = (to.head<2>() / to.w() - from.head<2>() / from.w()).cwiseProduct(half_picture);
    const double length = along.norm();
    // A line seen end on is drawn as a dot of its width.
    const Eigen::Vector2d direction =
        length > 1e-9 ? Eigen::Vector2d(along / length) : Eigen::Vector2d(Eigen::Vector2d::UnitX());
    const Eigen::Vector2d normal(-direction.y(), direction.x());
    const uint32_t first = static_cast<uint32_t>(result.rows.size() / 7);
    for (int k = 0; k < 4; ++k) {
      const Eigen::Vector4d& end = k < 2 ? from : to;
      const Eigen::Vector2d offset =
          (k % 2 == 0 ? 0.5 : -0.5) * pixel_width * normal + (k < 2 ? -0.5 : 0.5) * pixel_width * direction;
      Eigen::Vector4d corner = end;
      corner.head<2>() += offset.cwiseQuotient(half_picture) * end.w();
      for (const double value : corner) result.rows.push_back(static_cast<float>(value));
      for (const float value : line.colour) result.rows.push_back(value);
    }
    for (const uint32_t corner : {0U, 1U, 2U, 2U, 1U, 3U}) result.indices.push_back(first + corner);
  }
  return result;
}

}  // namespace fitroom::render
