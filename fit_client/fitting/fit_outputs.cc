#include "fit_client/fitting/fit_outputs.h"

#include <string>
#include <system_error>
#include <utility>
#include <vector>

#include "common/base/file.h"
#include "common/scan_file/obj_writer.h"
#include "fit_client/render/glb_writer.h"
#include "fit_client/render/pictures.h"
#include "fit_client/render/scene.h"

namespace fitroom {
namespace {

Status MakeFolder(const std::filesystem::path& folder) {
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  if (!error) return Status();
  return FailedPrecondition("FOLDER_NOT_WRITABLE",
                            folder.string() + ": " + error.message() + "; name another folder with --out");
}

Status WriteListed(const std::filesystem::path& folder, const std::string& name, const std::string& description,
                   const std::string& bytes, FitReport& report) {
  FR_RETURN_IF_ERROR(WriteFileAtomically(folder / name, bytes));
  report.files.push_back({name, description, static_cast<int64_t>(bytes.size())});
  return Status();
}

// The garment as worn and at rest, the body, and the pairs of sewn vertices (0-based), for other programs to measure.
Status WriteMeshes(const std::filesystem::path& folder, const BodyInput& body, Fit& fit) {
  // Sewn partners a tenth of a millimetre apart: triangles that share a place would count as crossing.
  const std::vector<Eigen::Vector3d> worn = SeparateSeamPartners(fit.cloth, fit.stages.final, 1e-4);
  FR_RETURN_IF_ERROR(WriteListed(folder, "garment.obj", "garment as worn, metres, y up",
                                 FormatObj(TriangleMesh{worn, fit.cloth.triangles}), fit.report));
  FR_RETURN_IF_ERROR(WriteListed(folder, "garment_rest.obj", "panels at rest, same vertices",
                                 FormatObj(TriangleMesh{fit.cloth.rest_positions, fit.cloth.triangles}), fit.report));
  FR_RETURN_IF_ERROR(WriteListed(folder, "body.obj", "body in the same frame", FormatObj(body.body.mesh), fit.report));
  std::string pairs;
  for (const SeamPair& pair : fit.cloth.seams) pairs += std::to_string(pair.a) + " " + std::to_string(pair.b) + "\n";
  return WriteListed(folder, "seams.txt", "sewn pairs of vertices", pairs, fit.report);
}

}  // namespace

Status WriteFitOutputs(const std::filesystem::path& folder, const BodyInput& body, const GarmentInput& garment,
                       Fit& fit, const FitOutputOptions& options, Stopwatch& stopwatch, const ProgressSink& progress) {
  FR_RETURN_IF_ERROR(MakeFolder(folder));
  const Image* back_texture = garment.back_texture.width > 0 ? &garment.back_texture : nullptr;
  render::DisplayBody display;
  if (options.pictures || options.glb) display = render::PrepareBody(fit.body_surface);
  if (options.pictures) {
    if (progress) progress("drawing", 0.82);
    render::FitPictureRequest request;
    request.body = &display;
    request.cloth = &fit.cloth;
    request.front_texture = &garment.front_texture;
    request.back_texture = back_texture;
    request.stages = {{"start", "1 START", fit.stages.start, false},
                      {"merging", "2 MERGING", fit.stages.merging, true},
                      {"stitched", "3 STITCHED", fit.stages.stitched, false},
                      {"final", "4 FINAL", fit.stages.final, false}};
    request.thread_count = options.thread_count;
    FR_ASSIGN_OR_RETURN(const std::vector<render::NamedPicture> pictures, render::DrawFitPictures(request));
    for (const render::NamedPicture& picture : pictures) {
      FR_RETURN_IF_ERROR(WriteListed(folder, picture.file_name, picture.description, picture.png, fit.report));
    }
    stopwatch.Lap("pictures");
  }
  if (options.glb) {
    if (progress) progress("writing the model", 0.95);
    render::Scene scene;
    scene.body = &display;
    scene.garments.push_back({&fit.cloth, fit.stages.final, &garment.front_texture, back_texture, /*opacity=*/1.0F});
    FR_ASSIGN_OR_RETURN(const std::string glb, render::WriteGlb(scene, garment.garment.title));
    FR_RETURN_IF_ERROR(WriteListed(folder, "fitted.glb", "3D model", glb, fit.report));
    stopwatch.Lap("model");
  }
  if (options.meshes) {
    FR_RETURN_IF_ERROR(WriteMeshes(folder, body, fit));
    stopwatch.Lap("meshes");
  }
  fit.report.files.push_back({"report.json", "this report for programs", 0});
  fit.report.files.push_back({"report.txt", "this report for people", 0});
  fit.report.times = stopwatch.laps();
  fit.report.total_seconds = stopwatch.total_seconds();
  fit.report.peak_rss_bytes = PeakMemory();
  FR_RETURN_IF_ERROR(WriteFileAtomically(folder / "report.json", WriteJson(fit.report)));
  FR_RETURN_IF_ERROR(WriteFileAtomically(folder / "report.txt", WriteText(fit.report)));
  if (progress) progress("done", 1.0);
  return Status();
}

}  // namespace fitroom
