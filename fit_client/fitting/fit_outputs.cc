#include "fit_client/fitting/fit_outputs.h"

#include <cctype>
#include <cstdio>
#include <string>
#include <system_error>
#include <utility>
#include <vector>

#include "common/base/file.h"
#include "common/image/encode.h"
#include "common/scan_file/obj_writer.h"
#include "fit_client/fitting/judge_fit.h"
#include "fit_client/render/film.h"
#include "fit_client/render/fit_map.h"
#include "fit_client/render/glb_writer.h"
#include "fit_client/render/pictures.h"
#include "fit_client/render/scene.h"
#include "fit_client/render/size_sheet.h"
#include "fit_client/report/fit_page.h"
#include "fit_client/report/fit_words.h"

namespace fitroom {
namespace {

constexpr char kPageName[] = "index.html";

Status MakeFolder(const std::filesystem::path& folder) {
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  if (!error) return Status();
  return FailedPrecondition("FOLDER_NOT_WRITABLE",
                            folder.string() + ": " + error.message() + "; name another folder with --out");
}

// What pictures can write.
std::string Capitals(std::string text) {
  for (char& letter : text) letter = static_cast<char>(std::toupper(static_cast<unsigned char>(letter)));
  return text;
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

render::GarmentShape ShapeOf(const FittedGarment& worn) {
  return {&worn.cut.cloth, worn.stages.final, &worn.input->front_texture, BackTexture(worn), /*opacity=*/1.0F};
}

// What is worn below the outermost garment.
std::vector<render::GarmentShape> InnerShapes(const Outfit& outfit) {
  std::vector<render::GarmentShape> shapes;
  for (size_t i = 0; i + 1 < outfit.garments.size(); ++i) shapes.push_back(ShapeOf(outfit.garments[i]));
  return shapes;
}

// One moment of the dressing.
struct Moment {
  const char* name;
  const char* title;  // In capitals, which is what pictures write.
  const std::vector<Eigen::Vector3d>* positions;
  bool is_open;         // Its seams are not sewn yet.
  double film_seconds;  // When the film shows it.
};

// The moments that a garment went through; tops have fewer.
std::vector<Moment> MomentsOf(const DressingStages& stages) {
  const std::vector<Moment> all = {
      {"start", "START", &stages.start, false, 0.0},          {"merging", "MERGING", &stages.merging, true, 1.2},
      {"stitched", "STITCHED", &stages.stitched, false, 2.4}, {"pulled_up", "PULLED UP", &stages.pulled_up, false, 3.4},
      {"belted", "BELTED", &stages.belted, false, 4.0},       {"final", "FINAL", &stages.final, false, 5.0}};
  std::vector<Moment> moments;
  for (const Moment& moment : all) {
    if (!moment.positions->empty()) moments.push_back(moment);
  }
  return moments;
}

// The pictures of the outermost garment's fit, with what is worn below it.
Status WritePictures(const render::DisplayBody& display, const Outfit& outfit, int thread_count, FolderWriter& writer) {
  const FittedGarment& worn = outfit.garments.back();
  render::FitPictureRequest request;
  request.body = &display;
  request.cloth = &worn.cut.cloth;
  request.front_texture = &worn.input->front_texture;
  request.back_texture = BackTexture(worn);
  request.others = InnerShapes(outfit);
  for (const Moment& moment : MomentsOf(worn.stages)) {
    const std::string number = std::to_string(request.stages.size() + 1);
    request.stages.push_back({moment.name, number + " " + moment.title, *moment.positions, moment.is_open});
  }
  request.thread_count = thread_count;
  FR_ASSIGN_OR_RETURN(const std::vector<render::NamedPicture> pictures, render::DrawFitPictures(request));
  for (const render::NamedPicture& picture : pictures) {
    FR_RETURN_IF_ERROR(writer.Write(picture.file_name, picture.description, picture.png));
  }
  return Status();
}

Status WriteMaps(const render::DisplayBody& display, const Outfit& outfit, FolderWriter& writer) {
  const FittedGarment& worn = outfit.garments.back();
  const Fabric& fabric = FabricOf(worn.input->garment);
  render::FitMapRequest request;
  request.body = &display;
  request.cloth = &worn.cut.cloth;
  request.positions = worn.stages.final;
  request.others = InnerShapes(outfit);
  const auto write = [&](const std::string& name, const std::string& description, const std::vector<double>& values,
                         render::MapScale scale) -> Status {
    if (values.empty()) return Status();
    request.values = values;
    request.scale = std::move(scale);
    FR_ASSIGN_OR_RETURN(const Image picture, render::DrawFitMap(request));
    return writer.Write(name, description, EncodePng(picture));
  };
  FR_RETURN_IF_ERROR(write("map_strain.png", "how much the cloth is stretched", worn.maps.strain,
                           render::StrainScale(fabric.tight_strain(), fabric.limit_strain())));
  FR_RETURN_IF_ERROR(
      write("map_pressure.png", "how hard the cloth presses", worn.maps.pressure, render::PressureScale()));
  return write("map_gap.png", "how far the cloth stands off", worn.maps.gap, render::GapScale());
}

Status WriteFilm(const render::DisplayBody& display, const Outfit& outfit, int thread_count, FolderWriter& writer) {
  const FittedGarment& worn = outfit.garments.back();
  render::FilmRequest request;
  request.body = &display;
  request.cloth = &worn.cut.cloth;
  request.front_texture = &worn.input->front_texture;
  request.back_texture = BackTexture(worn);
  request.others = InnerShapes(outfit);
  for (const Moment& moment : MomentsOf(worn.stages)) {
    request.keys.push_back({moment.film_seconds, moment.title, *moment.positions, moment.is_open});
  }
  request.thread_count = thread_count;
  FR_ASSIGN_OR_RETURN(const std::string film, render::DrawDressingFilm(request));
  return writer.Write("dressing.webp", "film of the dressing", film);
}

Status WriteModel(const render::DisplayBody& display, const Outfit& outfit, FolderWriter& writer) {
  render::Scene scene;
  scene.body = &display;
  std::string title;
  for (const FittedGarment& worn : outfit.garments) {
    scene.garments.push_back(ShapeOf(worn));
    title += (title.empty() ? "" : ", ") + worn.input->garment.title;
  }
  FR_ASSIGN_OR_RETURN(const std::string glb, render::WriteGlb(scene, title));
  return writer.Write("fitted.glb", "3D model", glb);
}

}  // namespace

Result<OutputFile> WriteSizeSheet(const std::filesystem::path& folder, const std::vector<Outfit>& sizes,
                                  int thread_count) {
  FR_RETURN_IF_ERROR(MakeFolder(folder));
  if (sizes.empty()) return InvalidArgument("BAD_SIZE_SHEET", "there is no size to draw");
  const render::DisplayBody display = render::PrepareBody(sizes.front().body_surface);
  std::vector<render::SizeColumn> columns;
  for (const Outfit& outfit : sizes) {
    const FittedGarment& worn = outfit.garments.back();
    render::SizeColumn column;
    column.size = worn.cut.size;
    if (worn.report.verdict) {
      column.verdict = Capitals(VerdictSentence(*worn.report.verdict));
    }
    for (const ZoneFit& zone : worn.report.zones) {
      if (!zone.measured) continue;
      char line[64];
      std::snprintf(line, sizeof(line), "%s %+.0f CM", Capitals(std::string(FitZoneWords(zone.zone))).c_str(),
                    zone.ease() * 100.0);
      column.ease_lines.push_back(line);
    }
    const std::optional<SizeRecommendation>& recommended = worn.report.recommendation;
    column.is_recommended = recommended && recommended->found && recommended->size == worn.cut.size;
    column.shape = ShapeOf(worn);
    columns.push_back(std::move(column));
  }
  FR_ASSIGN_OR_RETURN(const Image sheet, render::DrawSizeSheet(display, columns, thread_count));
  const std::string bytes = EncodePng(sheet);
  FR_RETURN_IF_ERROR(WriteFileAtomically(folder / "sizes.png", bytes));
  return OutputFile{"sizes.png", "all sizes side by side", static_cast<int64_t>(bytes.size())};
}

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

namespace {

std::string OutfitPage(const Outfit& outfit) {
  std::vector<FitReport> reports;
  for (const FittedGarment& worn : outfit.garments) reports.push_back(worn.report);
  return WriteFitPage(reports);
}

}  // namespace

Status WriteFitOutputs(const std::filesystem::path& folder, const BodyInput& body, Outfit& outfit,
                       const FitOutputOptions& options, Stopwatch& stopwatch, const ProgressSink& progress) {
  FR_RETURN_IF_ERROR(MakeFolder(folder));
  FolderWriter writer(folder);
  render::DisplayBody display;
  if (options.pictures || options.glb || options.maps || options.film)
    display = render::PrepareBody(outfit.body_surface);
  if (options.pictures) {
    if (progress) progress("drawing", 0.82);
    FR_RETURN_IF_ERROR(WritePictures(display, outfit, options.thread_count, writer));
    stopwatch.Lap("pictures");
  }
  if (options.maps) {
    FR_RETURN_IF_ERROR(WriteMaps(display, outfit, writer));
    stopwatch.Lap("maps");
  }
  if (options.film) {
    FR_RETURN_IF_ERROR(WriteFilm(display, outfit, options.thread_count, writer));
    stopwatch.Lap("film");
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
    worn.report.files = options.written_before;
    worn.report.files.insert(worn.report.files.end(), writer.files().begin(), writer.files().end());
    worn.report.files.push_back({"report.json", "this report for programs", 0});
    worn.report.files.push_back({"report.txt", "this report for people", 0});
    worn.report.files.push_back({kPageName, "all of it on one page, for a browser", 0});
    worn.report.times = stopwatch.laps();
    worn.report.total_seconds = stopwatch.total_seconds();
    worn.report.peak_rss_bytes = PeakMemory();
  }
  FR_RETURN_IF_ERROR(WriteFileAtomically(folder / "report.json", OutfitJson(outfit)));
  FR_RETURN_IF_ERROR(WriteFileAtomically(folder / "report.txt", OutfitText(outfit)));
  FR_RETURN_IF_ERROR(WriteFileAtomically(folder / kPageName, OutfitPage(outfit)));
  if (progress) progress("done", 1.0);
  return Status();
}

}  // namespace fitroom
