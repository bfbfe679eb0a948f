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

// Writes files and keeps the list of them, which goes into the reports.
class FolderWriter {
 public:
  explicit FolderWriter(std::filesystem::path folder) : folder_(std::move(folder)) {}

  Status Write(const std::string& name, const std::string& description, const std::string& bytes) {
    FR_RETURN_IF_ERROR(WriteFileAtomically(folder_ / name, bytes));
    files_.push_back({name, description, static_cast<int64_t>(bytes.size())});
    return Status();
  }
  const std::vector<OutputFile>& files() const { return files_; }

 private:
  std::filesystem::path folder_;
  std::vector<OutputFile> files_;
};

const Image* BackTexture(const FittedGarment& worn) {
  return worn.input->back_texture.width > 0 ? &worn.input->back_texture : nullptr;
}

// A garment as worn and at rest, and the pairs of sewn vertices (0-based), for other programs to measure. `suffix`
// tells the garments of an outfit apart.
Status WriteMeshes(const FittedGarment& worn, const std::string& suffix, FolderWriter& writer) {
  const ClothMesh& cloth = worn.cut.cloth;
  // Sewn partners a tenth of a millimetre apart: triangles that share a place would count as crossing.
  const std::vector<Eigen::Vector3d> places = SeparateSeamPartners(cloth, worn.stages.final, 1e-4);
  FR_RETURN_IF_ERROR(writer.Write("garment" + suffix + ".obj", "garment as worn, metres, y up",
                                  FormatObj(TriangleMesh{places, cloth.triangles})));
  FR_RETURN_IF_ERROR(writer.Write("garment_rest" + suffix + ".obj", "panels at rest, same vertices",
                                  FormatObj(TriangleMesh{cloth.rest_positions, cloth.triangles})));
  std::string pairs;
  for (const SeamPair& pair : cloth.seams) pairs += std::to_string(pair.a) + " " + std::to_string(pair.b) + "\n";
  return writer.Write("seams" + suffix + ".txt", "sewn pairs of vertices", pairs);
}

// The pictures of the outermost garment's fit, with what is worn below it.
Status WritePictures(const render::DisplayBody& display, const Outfit& outfit, int thread_count, FolderWriter& writer) {
  const FittedGarment& worn = outfit.garments.back();
  render::FitPictureRequest request;
  request.body = &display;
  request.cloth = &worn.cut.cloth;
  request.front_texture = &worn.input->front_texture;
  request.back_texture = BackTexture(worn);
  request.stages = {{"start", "1 START", worn.stages.start, false},
                    {"merging", "2 MERGING", worn.stages.merging, true},
                    {"stitched", "3 STITCHED", worn.stages.stitched, false},
                    {"final", "4 FINAL", worn.stages.final, false}};
  request.thread_count = thread_count;
  FR_ASSIGN_OR_RETURN(const std::vector<render::NamedPicture> pictures, render::DrawFitPictures(request));
  for (const render::NamedPicture& picture : pictures) {
    FR_RETURN_IF_ERROR(writer.Write(picture.file_name, picture.description, picture.png));
  }
  return Status();
}

Status WriteModel(const render::DisplayBody& display, const Outfit& outfit, FolderWriter& writer) {
  render::Scene scene;
  scene.body = &display;
  std::string title;
  for (const FittedGarment& worn : outfit.garments) {
    scene.garments.push_back(
        {&worn.cut.cloth, worn.stages.final, &worn.input->front_texture, BackTexture(worn), /*opacity=*/1.0F});
    title += (title.empty() ? "" : ", ") + worn.input->garment.title;
  }
  FR_ASSIGN_OR_RETURN(const std::string glb, render::WriteGlb(scene, title));
  return writer.Write("fitted.glb", "3D model", glb);
}

}  // namespace

std::string OutfitText(const Outfit& outfit) {
  std::string text;
  for (const FittedGarment& worn : outfit.garments) text += (text.empty() ? "" : "\n") + WriteText(worn.report);
  return text;
}

std::string OutfitJson(const Outfit& outfit) {
  if (outfit.garments.size() == 1) return WriteJson(outfit.garments.front().report);
  std::string json;
  for (const FittedGarment& worn : outfit.garments) json += (json.empty() ? "" : ",\n") + WriteJson(worn.report);
  return "{\"garments\": [\n" + json + "]}\n";
}

Status WriteFitOutputs(const std::filesystem::path& folder, const BodyInput& body, Outfit& outfit,
                       const FitOutputOptions& options, Stopwatch& stopwatch, const ProgressSink& progress) {
  FR_RETURN_IF_ERROR(MakeFolder(folder));
  FolderWriter writer(folder);
  render::DisplayBody display;
  if (options.pictures || options.glb) display = render::PrepareBody(outfit.body_surface);
  if (options.pictures) {
    if (progress) progress("drawing", 0.82);
    FR_RETURN_IF_ERROR(WritePictures(display, outfit, options.thread_count, writer));
    stopwatch.Lap("pictures");
  }
  if (options.glb) {
    if (progress) progress("writing the model", 0.95);
    FR_RETURN_IF_ERROR(WriteModel(display, outfit, writer));
    stopwatch.Lap("model");
  }
  if (options.meshes) {
    FR_RETURN_IF_ERROR(writer.Write("body.obj", "body in the same frame", FormatObj(body.body.mesh)));
    for (size_t i = 0; i < outfit.garments.size(); ++i) {
      const std::string suffix = outfit.garments.size() == 1 ? "" : "_" + std::to_string(i + 1);
      FR_RETURN_IF_ERROR(WriteMeshes(outfit.garments[i], suffix, writer));
    }
    stopwatch.Lap("meshes");
  }
  for (FittedGarment& worn : outfit.garments) {
    worn.report.files = writer.files();
    worn.report.files.push_back({"report.json", "this report for programs", 0});
    worn.report.files.push_back({"report.txt", "this report for people", 0});
    worn.report.times = stopwatch.laps();
    worn.report.total_seconds = stopwatch.total_seconds();
    worn.report.peak_rss_bytes = PeakMemory();
  }
  FR_RETURN_IF_ERROR(WriteFileAtomically(folder / "report.json", OutfitJson(outfit)));
  FR_RETURN_IF_ERROR(WriteFileAtomically(folder / "report.txt", OutfitText(outfit)));
  if (progress) progress("done", 1.0);
  return Status();
}

}  // namespace fitroom
