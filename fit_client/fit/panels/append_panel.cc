#include "fit_client/fit/panels/append_panel.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <numeric>
#include <string>

#include "fit_client/fit/panels/panel_mesher.h"
#include "fit_client/fit/panels/panel_pixels.h"
#include "fit_client/fit/panels/sleeve_weights.h"
#include "fit_client/fit/panels/topology.h"

namespace fitroom::panels {
namespace {

constexpr double kLeastPitch = 0.002;   // (unit: metre)
constexpr double kLargestPitch = 0.05;  // (unit: metre)

// Returns the points' places in an order by rows of the lattice upwards, each from right to left of the wearer.
std::vector<int> RowOrder(const std::vector<Eigen::Vector2d>& points, double pitch) {
  const double row_height = 0.5 * std::numbers::sqrt3 * pitch;
  std::vector<int64_t> row(points.size());
  for (size_t i = 0; i < points.size(); ++i) row[i] = std::llround(points[i].y() / row_height);
  std::vector<int> order(points.size());
  std::iota(order.begin(), order.end(), 0);
  std::sort(order.begin(), order.end(), [&](int a, int b) {
    const size_t i = static_cast<size_t>(a), j = static_cast<size_t>(b);
    if (row[i] != row[j]) return row[i] < row[j];
    return points[i].x() != points[j].x() ? points[i].x() < points[j].x() : a < b;
  });
  return order;
}

}  // namespace

Result<std::vector<int>> AppendPanel(const PanelPattern& panel, GarmentKind kind, const OutlineSamples& outline,
                                     const MeshSize& size, const PixelMap& pixel_at, ClothMesh& mesh) {
  FR_ASSIGN_OR_RETURN(const PanelMesh flat, MeshPanel(outline.points, outline.sewn, size));
  const bool is_front = panel.side == GarmentSide::kFront;
  const int base = static_cast<int>(mesh.rest_positions.size());
  const std::vector<int> order = RowOrder(flat.points, size.pitch());
  std::vector<int> particle_of(flat.points.size());
  const SleeveWeight left_sleeve(panel, kind, /*left=*/true), right_sleeve(panel, kind, /*left=*/false);
  const Eigen::Array2d image_size(panel.image_width, panel.image_height);
  std::vector<Eigen::Vector2d> pixels;
  if (pixel_at) {
    pixels = outline.pixels;
    for (size_t v = pixels.size(); v < flat.points.size(); ++v) pixels.push_back(pixel_at(flat.points[v]));
  } else {
    pixels = ComputePanelPixels(panel, outline, flat, size.pitch());
  }
  for (size_t i = 0; i < order.size(); ++i) {
    const size_t v = static_cast<size_t>(order[i]);
    const Eigen::Vector2d& point = flat.points[v];
    particle_of[v] = base + static_cast<int>(i);
    mesh.rest_positions.emplace_back(point.x(), point.y(), 0.0);
    mesh.panel_of_particle.push_back(is_front ? 0 : 1);
    mesh.texture_coordinates.emplace_back((pixels[v].array() / image_size).matrix());
    mesh.left_sleeve_weights.push_back(left_sleeve.At(point));
    mesh.right_sleeve_weights.push_back(right_sleeve.At(point));
  }
  const size_t first_triangle = mesh.triangles.size();
  for (const Eigen::Vector3i& t : flat.triangles) {
    const int a = particle_of[static_cast<size_t>(t[0])];
    const int b = particle_of[static_cast<size_t>(t[1])];
    const int c = particle_of[static_cast<size_t>(t[2])];
    // The panels' outside: the front is seen from +z, the back from -z. The smallest particle comes first.
    const Eigen::Vector3i turned = is_front ? Eigen::Vector3i(a, b, c) : Eigen::Vector3i(a, c, b);
    int least = 0;
    turned.minCoeff(&least);
    mesh.triangles.emplace_back(turned[least], turned[(least + 1) % 3], turned[(least + 2) % 3]);
  }
  std::sort(mesh.triangles.begin() + static_cast<std::ptrdiff_t>(first_triangle), mesh.triangles.end(),
            [](const Eigen::Vector3i& s, const Eigen::Vector3i& t) {
              return std::lexicographical_compare(s.data(), s.data() + 3, t.data(), t.data() + 3);
            });
  for (const OutlineSamples::Named& named : outline.named) {
    const std::string name = std::string(is_front ? "front/" : "back/") + named.name;
    const auto same = [&](const NamedParticle& other) { return other.name == name; };
    // The pieces of one photograph share their points on the middle: the first keeps the name.
    if (std::any_of(mesh.named_particles.begin(), mesh.named_particles.end(), same)) continue;
    mesh.named_particles.push_back({name, particle_of[static_cast<size_t>(named.sample)]});
  }
  particle_of.resize(outline.points.size());
  return particle_of;
}

void SortSeams(ClothMesh& mesh) {
  std::sort(mesh.seams.begin(), mesh.seams.end(),
            [](const SeamPair& s, const SeamPair& t) { return s.a != t.a ? s.a < t.a : s.b < t.b; });
  mesh.seams.erase(std::unique(mesh.seams.begin(), mesh.seams.end(),
                               [](const SeamPair& s, const SeamPair& t) { return s.a == t.a && s.b == t.b; }),
                   mesh.seams.end());
}

Status CheckPitch(double pitch) {
  if (pitch >= kLeastPitch && pitch <= kLargestPitch) return {};
  return InvalidArgument("PITCH_OUT_OF_RANGE", "the mesh pitch must lie between 2 and 50 mm");
}

Status CheckSewn(const ClothMesh& mesh, GarmentKind kind) {
  const ClothTopology sewn = ComputeWeldedTopology(mesh);
  if (sewn.is_manifold && sewn.component_count == 1 && sewn.boundary_loop_count == OpeningCount(kind) &&
      sewn.euler_characteristic() == ExpectedEulerCharacteristic(kind)) {
    return {};
  }
  return InvalidArgument("PITCH_TOO_COARSE", "at this pitch the sewn panels have " +
                                                 std::to_string(sewn.boundary_loop_count) + " openings instead of " +
                                                 std::to_string(OpeningCount(kind)) + "; use a finer pitch");
}

}  // namespace fitroom::panels
