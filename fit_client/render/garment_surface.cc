#include "fit_client/render/garment_surface.h"

#include <algorithm>
#include <cstdint>
#include <numeric>
#include <string>

namespace fitroom::render {
namespace {

const Colour kPlainCloth(0.72F, 0.74F, 0.78F);

Status BadShape(const std::string& what) {
  return InvalidArgument("BAD_GARMENT_SHAPE", "the garment cannot be drawn: " + what);
}

Status CheckTexture(const Image* texture, const char* name) {
  if (texture == nullptr) return Status();
  if (texture->width <= 0 || texture->height <= 0 ||
      (texture->channels != 1 && texture->channels != 3 && texture->channels != 4)) {
    return BadShape(std::string("the ") + name + " texture is empty or has an unknown number of channels");
  }
  const size_t expected = static_cast<size_t>(texture->width) * static_cast<size_t>(texture->height) *
                          static_cast<size_t>(texture->channels);
  if (texture->pixels.size() != expected) return BadShape(std::string("the ") + name + " texture has lost pixels");
  return Status();
}

bool IsIndex(int index, size_t count) { return index >= 0 && static_cast<size_t>(index) < count; }

}  // namespace

Status CheckGarmentShape(const GarmentShape& garment) {
  if (garment.cloth == nullptr) return BadShape("it has no cloth");
  const ClothMesh& cloth = *garment.cloth;
  const size_t count = garment.positions.size();
  if (count == 0 || cloth.triangles.empty()) return BadShape("it is empty");
  if (cloth.panel_of_particle.size() != count || cloth.texture_coordinates.size() != count) {
    return BadShape("it has " + std::to_string(count) + " positions, " +
                    std::to_string(cloth.panel_of_particle.size()) + " panel numbers and " +
                    std::to_string(cloth.texture_coordinates.size()) + " texture coordinates");
  }
  for (const Eigen::Vector3i& triangle : cloth.triangles) {
    for (const int corner : triangle) {
      if (!IsIndex(corner, count)) return BadShape("a triangle names particle " + std::to_string(corner));
    }
  }
  for (const SeamPair& pair : cloth.seams) {
    if (!IsIndex(pair.a, count) || !IsIndex(pair.b, count))
      return BadShape("a seam names a particle that is not there");
  }
  for (size_t i = 0; i < count; ++i) {
    if (!garment.positions[i].allFinite() || !cloth.texture_coordinates[i].allFinite()) {
      return BadShape("particle " + std::to_string(i) + " is nowhere (not a number)");
    }
    if (cloth.panel_of_particle[i] != 0 && cloth.panel_of_particle[i] != 1) {
      return BadShape("particle " + std::to_string(i) + " is of panel " + std::to_string(cloth.panel_of_particle[i]));
    }
  }
  FR_RETURN_IF_ERROR(CheckTexture(garment.front_texture, "front"));
  return CheckTexture(garment.back_texture, "back");
}

std::vector<int> WeldParticles(const ClothMesh& cloth, const std::vector<Eigen::Vector3d>& positions) {
  std::vector<int> roots(positions.size());
  std::iota(roots.begin(), roots.end(), 0);
  const auto root_of = [&roots](int particle) {
    while (roots[static_cast<size_t>(particle)] != particle) particle = roots[static_cast<size_t>(particle)];
    return particle;
  };
  for (const SeamPair& pair : cloth.seams) {
    const Eigen::Vector3d gap = positions[static_cast<size_t>(pair.a)] - positions[static_cast<size_t>(pair.b)];
    if (gap.norm() > kWeldedGap) continue;
    const int a = root_of(pair.a);
    const int b = root_of(pair.b);
    roots[static_cast<size_t>(std::max(a, b))] = std::min(a, b);
  }
  for (size_t i = 0; i < roots.size(); ++i) roots[i] = root_of(static_cast<int>(i));
  return roots;
}

std::vector<Eigen::Vector3d> ComputeGarmentNormals(const ClothMesh& cloth,
                                                   const std::vector<Eigen::Vector3d>& positions) {
  const std::vector<int> welded = WeldParticles(cloth, positions);
  std::vector<Eigen::Vector3d> sums(positions.size(), Eigen::Vector3d::Zero());
  for (const Eigen::Vector3i& t : cloth.triangles) {
    const Eigen::Vector3d& a = positions[static_cast<size_t>(t[0])];
    const Eigen::Vector3d twice_area_normal =
        (positions[static_cast<size_t>(t[1])] - a).cross(positions[static_cast<size_t>(t[2])] - a);
    for (const int corner : t) sums[static_cast<size_t>(welded[static_cast<size_t>(corner)])] += twice_area_normal;
  }
  std::vector<Eigen::Vector3d> normals(positions.size(), Eigen::Vector3d::Zero());
  for (size_t i = 0; i < positions.size(); ++i) {
    const Eigen::Vector3d& sum = sums[static_cast<size_t>(welded[i])];
    const double length = sum.norm();
    if (length > 0.0) normals[i] = sum / length;
  }
  return normals;
}

Colour ComputePanelColour(const ClothMesh& cloth, int panel, const Image* texture) {
  if (texture == nullptr) return kPlainCloth;
  std::array<std::vector<uint8_t>, 3> values;
  for (size_t i = 0; i < cloth.panel_of_particle.size(); ++i) {
    if (cloth.panel_of_particle[i] != panel) continue;
    const Eigen::Vector2d uv = cloth.texture_coordinates[i].cwiseMax(0.0).cwiseMin(1.0);
    const int x = std::min(static_cast<int>(uv.x() * texture->width), texture->width - 1);
    const int y = std::min(static_cast<int>(uv.y() * texture->height), texture->height - 1);
    const uint8_t* pixel = texture->at(x, y);
    for (size_t c = 0; c < 3; ++c) values[c].push_back(texture->channels == 1 ? pixel[0] : pixel[c]);
  }
  if (values[0].empty()) return kPlainCloth;
  Colour colour;
  for (size_t c = 0; c < 3; ++c) {
    const auto middle = values[c].begin() + static_cast<ptrdiff_t>(values[c].size() / 2);
    std::nth_element(values[c].begin(), middle, values[c].end());
    colour[static_cast<Eigen::Index>(c)] = static_cast<float>(*middle) / 255.0F;
  }
  return colour;
}

}  // namespace fitroom::render
