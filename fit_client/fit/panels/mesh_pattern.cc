#include "fit_client/fit/panels/mesh_pattern.h"

#include <vector>

#include "fit_client/fit/panels/append_panel.h"
#include "fit_client/fit/panels/outline_samples.h"

namespace fitroom {

Result<ClothMesh> MeshPattern(const GarmentPattern& pattern, double pitch, double tight_pitch) {
  FR_RETURN_IF_ERROR(panels::CheckPitch(pitch));
  const panels::MeshSize front_size(pattern.front, pitch, tight_pitch);
  const panels::MeshSize back_size(pattern.back, pitch, tight_pitch);
  const panels::OutlineSamples front = panels::SampleOutline(pattern.front, front_size);
  const panels::OutlineSamples back = panels::SampleOutline(pattern.back, back_size);
  ClothMesh mesh;
  FR_ASSIGN_OR_RETURN(const std::vector<int> front_particles,
                      panels::AppendPanel(pattern.front, pattern.kind, front, front_size, /*pixel_at=*/nullptr, mesh));
  FR_ASSIGN_OR_RETURN(const std::vector<int> back_particles,
                      panels::AppendPanel(pattern.back, pattern.kind, back, back_size, /*pixel_at=*/nullptr, mesh));

  for (size_t s = 0; s < pattern.front.sections.size(); ++s) {
    if (pattern.front.sections[s].kind != SectionKind::kSeam) continue;
    const std::vector<int>& a = front.samples_of_section[s];
    const std::vector<int>& b = back.samples_of_section[s];
    FR_CHECK(a.size() == b.size());
    for (size_t i = 0; i < a.size(); ++i) {
      mesh.seams.push_back({front_particles[static_cast<size_t>(a[i])], back_particles[static_cast<size_t>(b[i])]});
    }
  }
  panels::SortSeams(mesh);
  FR_RETURN_IF_ERROR(panels::CheckSewn(mesh, pattern.kind));
  return mesh;
}

}  // namespace fitroom
